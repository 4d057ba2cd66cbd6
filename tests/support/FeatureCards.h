// SPDX-License-Identifier: MIT
// What the tests of the README's table of OpenSceneGraph's features share.
#pragma once

#include <SceneRenderer.h>

#include <osg/Geometry>
#include <osg/Material>
#include <osg/Texture2D>

#include <gtest/gtest.h>

#include <cmath>

namespace feature_cards
{

using osgEnvLight::LitScene;
using osgEnvLight::Settings;

inline const int size = 32;

inline double decoded(double c)
{
    return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

inline osg::ref_ptr<osg::Image> twoHalves(const osg::Vec4ub& left, const osg::Vec4ub& right, int rows = 8, int layers = 1)
{
    osg::ref_ptr<osg::Image> image = new osg::Image;
    image->allocateImage(8, rows, layers, GL_RGBA, GL_UNSIGNED_BYTE);
    for (int z = 0; z < layers; ++z)
        for (int y = 0; y < rows; ++y)
            for (int x = 0; x < 8; ++x)
                *reinterpret_cast<osg::Vec4ub*>(image->data(unsigned(x), unsigned(y), unsigned(z))) = x < 4 ? left : right;
    return image;
}

inline const osg::Vec4ub red(255, 0, 0, 255), blue(0, 0, 255, 255), grey(128, 128, 128, 255);

inline void sharp(osg::Texture& t)
{
    t.setFilter(osg::Texture::MIN_FILTER, osg::Texture::NEAREST);
    t.setFilter(osg::Texture::MAG_FILTER, osg::Texture::NEAREST);
}

inline osg::ref_ptr<osg::Texture2D> texture(osg::Image* image)
{
    osg::ref_ptr<osg::Texture2D> t = new osg::Texture2D(image);
    sharp(*t);
    return t;
}

// Before the camera at (0,-4,0), with coordinates from 0 at the left to 1 at the right; lit from the front without the node, too.
inline osg::ref_ptr<osg::Geode> card(double half = 3.0, const osg::Vec4& color = osg::Vec4(1, 1, 1, 1))
{
    osg::ref_ptr<osg::Geode> geode =
        makeQuad(osg::Vec3d(-half, 0, -half), osg::Vec3d(2 * half, 0, 0), osg::Vec3d(0, 0, 2 * half));
    osg::ref_ptr<osg::Vec2Array> st = new osg::Vec2Array;
    for (const osg::Vec2& p : {osg::Vec2(0, 0), osg::Vec2(1, 0), osg::Vec2(1, 1), osg::Vec2(0, 1)}) st->push_back(p);
    geode->getDrawable(0)->asGeometry()->setTexCoordArray(0, st.get());
    geode->getDrawable(0)->asGeometry()->setTexCoordArray(1, st.get());
    osg::ref_ptr<osg::Material> m = new osg::Material;
    m->setDiffuse(osg::Material::FRONT_AND_BACK, color);
    geode->getOrCreateStateSet()->setAttributeAndModes(m.get());
    return geode;
}

inline osg::ref_ptr<LitScene> furnace(osg::Node* model)
{
    osg::ref_ptr<LitScene> lit = makeLit(constantMap(1.0).get());
    lit->getSettings()->occlusion = false;
    lit->getSettings()->background = Settings::BACKGROUND_OFF;
    lit->addChild(model);
    return lit;
}

class Features : public testing::Test
{
  protected:
    // Lit by the furnace in which a white surface is 1.
    osg::Vec3d lit(osg::Node* model, int x = size / 2, int y = size / 2)
    {
        const osg::ref_ptr<LitScene> scene = furnace(model);
        const osg::Vec3d c = renderer.render(scene, 2).color(x, y);
        EXPECT_EQ(scene->plan().surfaces.forward, 0u);
        EXPECT_GT(scene->plan().surfaces.deferred, 0u);
        return c;
    }

    void expectAsWithout(osg::Node* model, const std::string& said)
    {
        const Picture plain = renderer.render(model, 2);
        const osg::ref_ptr<LitScene> scene = furnace(model);
        NotifyCatcher notify;
        const Picture found = renderer.render(scene, 3);
        EXPECT_EQ(plain.rgba, found.rgba) << said;
        const size_t first = notify.text().find(said);
        EXPECT_NE(first, std::string::npos) << notify.text();
        EXPECT_EQ(notify.text().find(said, first + 1), std::string::npos) << "once: " << notify.text();
    }

    SceneRenderer renderer{size, size};
    const double small = 0.003;  // as in Surfaces_test.cpp
};

}  // namespace feature_cards

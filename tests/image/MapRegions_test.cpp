// SPDX-License-Identifier: MIT
// Of a shadow map only the part where casters have changed is drawn again: nothing shows it.
#include <SceneRenderer.h>

#include <osgEnvLight/AreaLight>

#include <osg/AlphaFunc>
#include <osg/LightSource>
#include <osg/MatrixTransform>
#include <osg/Texture2D>

#include <gtest/gtest.h>

#include <cmath>

namespace MapRegions_test
{

using osgEnvLight::AreaLight;
using osgEnvLight::LitScene;
using osgEnvLight::Settings;

// Holes beside each other, whose edges lie in the texels' middles.
osg::ref_ptr<osg::Texture2D> grille()
{
    osg::ref_ptr<osg::Image> image = new osg::Image;
    image->allocateImage(8, 8, 1, GL_RGBA, GL_UNSIGNED_BYTE);
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 8; ++x) {
            unsigned char* p = image->data(unsigned(x), unsigned(y));
            std::fill_n(p, 3, static_cast<unsigned char>(200));
            p[3] = x % 2 && y % 2 ? 0 : 255;
        }
    return new osg::Texture2D(image);
}

/** Bodies on a floor under a sun, a sky and lamps; one of the bodies, and a grille, move. */
class MapRegions : public testing::TestWithParam<Settings::Regeneration>
{
  protected:
    MapRegions() : renderer(96, 96), lit(makeLit(makeMap(256, 128, radiance).get())), root(new osg::Group)
    {
        Settings& s = *lit->getSettings();
        s.regeneration = GetParam();
        s.atlasLights = 64;
        s.atlasUpdatesPerFrame = 16;
        s.sceneLights = Settings::SCENE_LIGHTS_ON;
        root->addChild(lit);
        lit->addChild(makeBox(osg::Vec3d(-4, -4, -0.2), osg::Vec3d(4, 4, 0)));
        for (int i = 0; i < 16; ++i) {
            const osg::Vec3d at(-3 + 2 * (i % 4), -3 + 2 * (i / 4), 0);
            lit->addChild(makeSphere(at + osg::Vec3d(0, 0, 0.4), 0.4, 24));
        }
        body->addChild(makeBox(osg::Vec3d(-0.3, -0.2, 0.9), osg::Vec3d(0.3, 0.2, 1.1)));
        sheet->addChild(makeQuad(osg::Vec3d(-0.5, 0, 0), osg::Vec3d(1, 0, 0), osg::Vec3d(0, 0.2, 1)));
        osg::StateSet& holes = *sheet->getOrCreateStateSet();
        holes.setTextureAttributeAndModes(0, grille());
        holes.setAttributeAndModes(new osg::AlphaFunc(osg::AlphaFunc::GREATER, 0.5f));
        lit->addChild(body);
        lit->addChild(sheet);
        // Its vertices change, and it says nothing of its bound.
        const osg::ref_ptr<osg::Geode> waving = makeQuad(osg::Vec3d(-1.5, 1, 1.5), osg::Vec3d(0.8, 0, 0), osg::Vec3d(0, 0.8, 0));
        wave = waving->getDrawable(0)->asGeometry();
        wave->setDataVariance(osg::Object::DYNAMIC);
        lit->addChild(waving);
        osg::ref_ptr<AreaLight> lamp = new AreaLight;
        lamp->setRectangle(osg::Vec3d(1, -1, 2.5), osg::Vec3d(0.25, 0, 0), osg::Vec3d(0, -0.25, 0));
        lamp->setRadiance(osg::Vec3f(6, 5, 4));
        lit->addChild(lamp);
        osg::ref_ptr<osg::LightSource> light = new osg::LightSource;
        light->getLight()->setLightNum(1);
        light->getLight()->setPosition(osg::Vec4(-1.5f, 0.5f, 2, 1));
        light->getLight()->setDiffuse(osg::Vec4(0.8f, 0.8f, 1, 1));
        root->addChild(light);
        root->getOrCreateStateSet()->setMode(GL_LIGHT1, osg::StateAttribute::ON);
        renderer.lookAt(osg::Vec3d(1, -8, 7), osg::Vec3d(0, 0, 0));
    }

    static osg::Vec3d radiance(const osg::Vec3d& d)
    {
        osg::Vec3d sun(0.5, -0.3, 0.8);
        sun.normalize();
        return d * sun > 0.999 ? osg::Vec3d(300, 280, 250) : osg::Vec3d(0.3, 0.4, 0.6) * (0.5 + 0.5 * d.z());
    }

    // One of them in each frame, so that parts of several frames come together in a map.
    void move(int frame)
    {
        if (frame % 3 == 0)
            body->setMatrix(osg::Matrixd::rotate(0.4 * frame, osg::Vec3d(1, 2, 3)) *
                            osg::Matrixd::translate(3.0 * std::sin(1.7 * frame), 3.0 * std::cos(2.3 * frame), 0.3));
        if (frame % 3 == 1)
            sheet->setMatrix(osg::Matrixd::rotate(0.9 * frame, osg::Vec3d(0, 0, 1)) *
                             osg::Matrixd::translate(2.5 * std::cos(0.7 * frame), 2.5 * std::sin(1.1 * frame), 0));
        if (frame % 3 == 2) {
            auto& corners = static_cast<osg::Vec3Array&>(*wave->getVertexArray());
            for (size_t i = 0; i < corners.size(); ++i) corners[i].z() = 1.5f + 0.4f * float(std::sin(double(i) + 1.3 * frame));
            corners.dirty();
        }
    }

    Picture settled()
    {
        Picture p = renderer.render(root);
        for (int i = 0; i < 6 && lit->regenerating(); ++i) p = renderer.render(root);
        EXPECT_FALSE(lit->regenerating());
        return renderer.render(root);
    }

    SceneRenderer renderer;
    osg::ref_ptr<LitScene> lit;
    osg::ref_ptr<osg::Group> root;
    osg::ref_ptr<osg::Geometry> wave;
    osg::ref_ptr<osg::MatrixTransform> body = new osg::MatrixTransform, sheet = new osg::MatrixTransform;
};

TEST_P(MapRegions, APartDrawnAnewIsThatOfTheWhole)
{
    move(0);
    for (int i = 0; i < 12; ++i) renderer.render(root);
    const Picture first = settled();
    for (const char* pass : {"atlas", "sunmap", "areamaps", "scenelightmaps"}) EXPECT_TRUE(lit->plan().runs(pass)) << pass;
    for (int frame = 1; frame < 10; ++frame) {
        move(frame);
        renderer.render(root);
    }
    const Picture parts = settled();
    EXPECT_GT(rootMeanSquare(first, parts), 0.02);
    lit->releaseGLObjects(&renderer.state());
    const Picture whole = settled();
    EXPECT_EQ(0.0, largestDifference(parts, whole));
    // Something comes, and goes; others are further on in the list then.
    osg::ref_ptr<osg::Geode> ball = makeSphere(osg::Vec3d(0, 0, 1.5), 0.3, 24);
    lit->insertChild(0, ball);
    EXPECT_GT(rootMeanSquare(whole, settled()), 0.01);
    lit->removeChild(ball);
    const Picture without = settled();
    lit->releaseGLObjects(&renderer.state());
    EXPECT_EQ(0.0, largestDifference(without, settled()));
}

INSTANTIATE_TEST_SUITE_P(Each, MapRegions, testing::Values(Settings::IMMEDIATE, Settings::BACKGROUND),
                         [](const auto& way) { return way.param == Settings::IMMEDIATE ? "Immediate" : "Background"; });

}  // namespace MapRegions_test

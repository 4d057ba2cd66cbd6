// SPDX-License-Identifier: MIT
#include "TestScenes.h"

#include <osgEnvLight/Material>

#include <osg/AlphaFunc>
#include <osg/BlendFunc>
#include <osg/Geometry>
#include <osg/Texture2D>

#include "Traced.h"

using osgEnvLight::Material;

namespace
{

osg::ref_ptr<osg::Geode> plane()
{
    osg::ref_ptr<osg::Geode> quad = makeQuad(osg::Vec3d(-3, -3, 0), osg::Vec3d(6, 0, 0), osg::Vec3d(0, 6, 0));
    lambert(quad, 0.6);
    return quad;
}

osg::ref_ptr<osg::Geode> ball()
{
    return makeSphere(osg::Vec3d(0, 0, 1), 1.0, 48);
}

osg::ref_ptr<osg::Node> metalBall(double roughness)
{
    osg::ref_ptr<osg::Geode> sphere = ball();
    Material::setCookTorrance(*sphere->getOrCreateStateSet(), osg::Vec3f(0.9f, 0.7f, 0.4f), 1.0f, float(roughness));
    return sphere;
}

osg::ref_ptr<osg::Geode> upright()
{
    osg::ref_ptr<osg::Geode> quad = makeQuad(osg::Vec3d(-1.5, 0, 0), osg::Vec3d(3, 0, 0), osg::Vec3d(0, 0, 2));
    lambert(quad, 0.5);
    return quad;
}

osg::ref_ptr<osg::Node> pane()
{
    osg::ref_ptr<osg::Geode> quad = upright();
    // Half transparent by its vertices' colour.
    osg::Geometry& geometry = *quad->getDrawable(0)->asGeometry();
    const osg::ref_ptr<osg::Vec4Array> colour = new osg::Vec4Array;
    colour->push_back(osg::Vec4(0.5f, 0.6f, 0.7f, 0.4f));
    geometry.setColorArray(colour, osg::Array::BIND_OVERALL);
    const osg::ref_ptr<osg::StateSet> state = new osg::StateSet;
    state->setMode(GL_BLEND, osg::StateAttribute::ON);
    state->setAttribute(new osg::BlendFunc);
    state->setRenderingHint(osg::StateSet::TRANSPARENT_BIN);
    quad->setStateSet(state);
    return quad;
}

osg::ref_ptr<osg::Node> fence()
{
    osg::ref_ptr<osg::Geode> quad = upright();
    const osg::ref_ptr<osg::Image> image = new osg::Image;
    image->allocateImage(8, 8, 1, GL_RGBA, GL_UNSIGNED_BYTE);
    for (unsigned i = 0; i < 64; ++i)
        image->setColor(osg::Vec4(0.7f, 0.7f, 0.7f, (i % 8) / 2 % 2 == 0 ? 1.0f : 0.0f), i % 8, i / 8);
    const osg::ref_ptr<osg::Texture2D> texture = new osg::Texture2D(image);
    texture->setFilter(osg::Texture::MIN_FILTER, osg::Texture::NEAREST);
    texture->setFilter(osg::Texture::MAG_FILTER, osg::Texture::NEAREST);
    const osg::ref_ptr<osg::Vec2Array> coordinates = new osg::Vec2Array;
    for (const auto& [s, t] : {std::pair(0.0f, 0.0f), {1.0f, 0.0f}, {1.0f, 1.0f}, {0.0f, 1.0f}})
        coordinates->push_back(osg::Vec2(s, t));
    quad->getDrawable(0)->asGeometry()->setTexCoordArray(0, coordinates);
    osg::StateSet& state = *quad->getOrCreateStateSet();
    state.setTextureAttributeAndModes(0, texture);
    state.setAttributeAndModes(new osg::AlphaFunc(osg::AlphaFunc::GREATER, 0.5f));
    return quad;
}

osg::ref_ptr<osg::Node> boxes()
{
    osg::ref_ptr<osg::Group> group = new osg::Group;
    for (int i = 0; i < 25; ++i) {
        const osg::Vec3d low(-2.0 + i % 5, -2.0 + i / 5, 0.0);
        group->addChild(lambert(makeBox(low, low + osg::Vec3d(0.5, 0.5, 0.3 + 0.2 * (i % 4))), 0.2 + 0.1 * (i % 7)));
    }
    return group;
}

osg::ref_ptr<osg::Node> bars()
{
    osg::ref_ptr<osg::Group> group = new osg::Group;
    for (int i = 0; i < 20; ++i) {
        const double x = -2.0 + 0.2 * i;
        group->addChild(lambert(makeBox(osg::Vec3d(x, -2, 0.5), osg::Vec3d(x + 0.02, 2, 0.52)), 0.8));
    }
    return group;
}

osg::ref_ptr<osg::Node> interior()
{
    const osg::ref_ptr<osg::Node> walls = emissive(makeBox(osg::Vec3d(-2, -2, 0), osg::Vec3d(2, 2, 2)), 0.0, 0.7);
    const osg::ref_ptr<osg::Node> lamp =
        emissive(makeQuad(osg::Vec3d(-0.5, -0.5, 1.9), osg::Vec3d(1, 0, 0), osg::Vec3d(0, 1, 0)), 4.0);
    return together({walls, lamp, lambert(makeSphere(osg::Vec3d(0.5, 0.5, 0.5), 0.5, 32), 0.5)});
}

osg::ref_ptr<osg::Node> corner()
{
    osg::ref_ptr<osg::Group> group = together({plane(), upright()});
    osg::ref_ptr<osg::Geode> sphere = makeSphere(osg::Vec3d(0, -0.7, 0.6), 0.6, 48);
    Material::setCookTorrance(*sphere->getOrCreateStateSet(), osg::Vec3f(0.6f, 0.2f, 0.2f), 0.0f, 0.4f);
    group->addChild(sphere);
    return group;
}

osg::ref_ptr<osg::Node> phongBall()
{
    osg::ref_ptr<osg::Geode> sphere = ball();
    Material::setPhong(*sphere->getOrCreateStateSet(), osg::Vec3f(0.4f, 0.3f, 0.2f), osg::Vec3f(0.4f, 0.4f, 0.4f), 40.0f);
    return sphere;
}

osg::ref_ptr<osg::Node> straussBall()
{
    osg::ref_ptr<osg::Geode> sphere = makeSphere(osg::Vec3d(-1.1, 0, 1), 1.0, 48);
    Material::setStrauss(*sphere->getOrCreateStateSet(), osg::Vec3f(0.5f, 0.3f, 0.2f), 0.7f, 0.4f);
    return sphere;
}

osg::ref_ptr<osg::Node> beckmannBall()
{
    osg::ref_ptr<osg::Geode> sphere = makeSphere(osg::Vec3d(1.1, 0, 1), 1.0, 48);
    Material::setCookTorrance(*sphere->getOrCreateStateSet(), osg::Vec3f(0.6f, 0.4f, 0.2f), 0.3f, 0.4f,
                              Material::BECKMANN_NORMALS);
    return sphere;
}

}  // namespace

std::vector<TestScene> testScenes()
{
    const osg::Vec3d eye(1, -6, 3), middle(0, 0, 0.7);
    return {{"sphere on a plane", together({plane(), lambert(ball(), 0.8)}), eye, middle},
            {"glossy metal", together({plane(), metalBall(0.4)}), eye, middle},
            {"mirror", together({plane(), metalBall(0.0)}), eye, middle},
            {"phong", together({plane(), phongBall()}), eye, middle},
            {"pane", together({plane(), pane()}), eye, middle},
            {"fence", together({plane(), fence()}), eye, middle},
            {"interior", interior(), osg::Vec3d(1.5, -1.8, 1.2), middle},
            {"boxes", together({plane(), boxes()}), eye, middle},
            {"bars", together({plane(), bars()}), eye, middle},
            {"corner", corner(), eye, middle},
            {"strauss and beckmann", together({plane(), straussBall(), beckmannBall()}), eye, middle}};
}

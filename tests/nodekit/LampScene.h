/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include <SceneRenderer.h>

#include <osgEnvLight/Material>

#include <osg/LightSource>

#include <cmath>
#include <string>

#include <gtest/gtest.h>

/** Lights of osg::LightSource nodes before a white screen, under a black map: they are all there is. */
namespace lampscene
{

using osgEnvLight::LitScene;
using osgEnvLight::Material;
using osgEnvLight::Settings;

const int size = 64;
const double exact = 2e-3;  // half floats, and normals of 16 bits

inline osg::ref_ptr<osg::LightSource> makeLight(int number, const osg::Vec4& position,
                                                const osg::Vec4& color = osg::Vec4(1, 1, 1, 1))
{
    osg::ref_ptr<osg::LightSource> source = new osg::LightSource;
    source->getLight()->setLightNum(number);
    source->getLight()->setPosition(position);
    source->getLight()->setDiffuse(color);
    source->getLight()->setAmbient(osg::Vec4(1, 1, 1, 1));  // which does not count
    return source;
}

// A quad at y = 0 that fills the view of a camera at (0, -4, 0), facing it.
inline osg::ref_ptr<osg::Geode> makeScreen()
{
    const osg::ref_ptr<osg::Geode> screen = makeQuad(osg::Vec3d(-3, 0, -3), osg::Vec3d(6, 0, 0), osg::Vec3d(0, 0, 6));
    Material::setLambert(*screen->getOrCreateStateSet(), osg::Vec3f(1, 1, 1));
    return screen;
}

inline std::string reasonOf(const LitScene& lit, const char* pass)
{
    for (const osgEnvLight::PassReport& r : lit.plan().passes)
        if (r.pass == pass) return (r.runs ? "" : "off, ") + r.reason;
    return std::string();
}

class LampScene : public testing::Test
{
  protected:
    /** @param side  of the picture [pixels] */
    explicit LampScene(int side = size) : renderer(side, side), lit(makeLit(constantMap(0.0).get())), root(new osg::Group)
    {
        root->addChild(lit);
        lit->addChild(makeScreen());
        lit->getSettings()->bounce = Settings::BOUNCE_OFF;
        renderer.lookAt(osg::Vec3d(0, -4, 0), osg::Vec3d(), osg::Vec3d(0, 0, 1), 60.0);
        for (int i = 1; i < 8; ++i) root->getOrCreateStateSet()->setMode(GLenum(GL_LIGHT0 + i), osg::StateAttribute::ON);
    }

    Picture render() { return renderer.render(root, 3); }

    // Where the ray of pixel (x, y) meets the screen.
    osg::Vec3d pointAt(int x, int y) const
    {
        const double scale = 4.0 * std::tan(osg::DegreesToRadians(30.0)) * 2.0 / size;
        return osg::Vec3d((x + 0.5 - size / 2) * scale, 0.0, (y + 0.5 - size / 2) * scale);
    }

    SceneRenderer renderer;
    osg::ref_ptr<LitScene> lit;
    osg::ref_ptr<osg::Group> root;
};

}  // namespace lampscene

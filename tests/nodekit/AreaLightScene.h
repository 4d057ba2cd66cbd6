// SPDX-License-Identifier: MIT
#pragma once

#include <SceneRenderer.h>

#include <osgEnvLight/AreaLight>
#include <osgEnvLight/Material>

#include <gtest/gtest.h>

/** A white floor under a black map, of which the middle pixel shows the origin; the eye is beside the lights above it. */
class AreaLightScene : public testing::Test
{
  protected:
    static constexpr int size = 65;        // odd: a pixel in the middle
    static constexpr double exact = 2e-3;  // half floats, and normals of 16 bits
    static constexpr double height = 1.5;  // of lights above the floor

    static osg::ref_ptr<osgEnvLight::AreaLight> makeRectangle(double radiance = 3.0)
    {
        osg::ref_ptr<osgEnvLight::AreaLight> light = new osgEnvLight::AreaLight;
        light->setRectangle(osg::Vec3d(0, 0, height), osg::Vec3d(1, 0, 0), osg::Vec3d(0, -0.5, 0));
        light->setRadiance(osg::Vec3f(1, 0.5f, 0.25f) * float(radiance));
        light->setVisible(false);
        light->setName("lamp");
        return light;
    }

    AreaLightScene() : lit(makeLit(constantMap(0.0).get()))
    {
        const osg::ref_ptr<osg::Geode> floor = makeQuad(osg::Vec3d(-4, -4, 0), osg::Vec3d(8, 0, 0), osg::Vec3d(0, 8, 0));
        osgEnvLight::Material::setLambert(*floor->getOrCreateStateSet(), osg::Vec3f(1, 1, 1));
        lit->addChild(floor);
        lit->getSettings()->bounce = osgEnvLight::Settings::BOUNCE_OFF;
        lit->getSettings()->regeneration = osgEnvLight::Settings::IMMEDIATE;  // all shadow maps in the frame of a change
        renderer.lookAt(osg::Vec3d(0, -6, 6), osg::Vec3d(), osg::Vec3d(0, 0, 1), 30.0);
    }

    osg::Vec3d middle(int frames = 2)
    {
        const Picture p = renderer.render(lit, frames);
        EXPECT_TRUE(p.finite());
        return p.color(size / 2, size / 2);
    }

    osg::Vec3d at(const Picture& p, const osg::Vec3d& point) const
    {
        const osg::Vec2d pixel = renderer.pixelOf(point);
        return p.color(int(pixel.x()), int(pixel.y()));
    }

    SceneRenderer renderer{size, size};
    osg::ref_ptr<osgEnvLight::LitScene> lit;
};

// SPDX-License-Identifier: MIT
// Cameras below the node draw what they draw without it, before or after the lit picture as their order says.
#include <SceneRenderer.h>
#include <WindowRenderer.h>

#include "gl/TargetTexture.h"
#include <osgEnvLight/Material>

#include <osg/Camera>
#include <osg/Geometry>
#include <osg/Material>
#include <osg/Texture2D>

#include <gtest/gtest.h>

namespace Cameras_test
{

using osgEnvLight::LitScene;
using osgEnvLight::Settings;

namespace
{

const int size = 32;

osg::ref_ptr<osg::Geode> colored(osg::ref_ptr<osg::Geode> geode, const osg::Vec4& color)
{
    osg::ref_ptr<osg::Material> m = new osg::Material;
    m->setDiffuse(osg::Material::FRONT_AND_BACK, color);
    geode->getOrCreateStateSet()->setAttributeAndModes(m);
    return geode;
}

osg::ref_ptr<osg::Geode> wall(const osg::Vec4& color)
{
    return colored(makeQuad(osg::Vec3d(-3, 0, -3), osg::Vec3d(6, 0, 0), osg::Vec3d(0, 0, 6)), color);
}

// A square of the overlay in the lower left corner.
osg::ref_ptr<osg::Camera> overlay(osg::Camera::RenderOrder order, const osg::Vec4& color, int number = 0)
{
    osg::ref_ptr<osg::Camera> camera = new osg::Camera;
    camera->setReferenceFrame(osg::Transform::ABSOLUTE_RF);
    camera->setProjectionMatrixAsOrtho2D(0, 1, 0, 1);
    camera->setViewMatrix(osg::Matrix());
    camera->setClearMask(GL_DEPTH_BUFFER_BIT);
    camera->setRenderOrder(order, number);
    osg::ref_ptr<osg::Geode> square = colored(makeQuad(osg::Vec3d(), osg::Vec3d(0.5, 0, 0), osg::Vec3d(0, 0.5, 0)), color);
    square->getOrCreateStateSet()->setMode(GL_LIGHTING, osg::StateAttribute::OFF);
    osg::ref_ptr<osg::Vec4Array> colors = new osg::Vec4Array;
    colors->push_back(color);
    square->getDrawable(0)->asGeometry()->setColorArray(colors, osg::Array::BIND_OVERALL);
    camera->addChild(square);
    return camera;
}

// Draws a model into a texture.
osg::ref_ptr<osg::Camera> intoTexture(osg::Texture2D* texture, osg::Node* model, int number = 0)
{
    osg::ref_ptr<osg::Camera> camera = new osg::Camera;
    camera->setReferenceFrame(osg::Transform::ABSOLUTE_RF);
    camera->setProjectionMatrixAsPerspective(40, 1, 1, 10);
    camera->setViewMatrixAsLookAt(osg::Vec3d(0, -4, 0), osg::Vec3d(), osg::Vec3d(0, 0, 1));
    camera->setViewport(0, 0, 16, 16);
    camera->setClearColor(osg::Vec4(0, 0, 0.25f, 1));
    camera->setClearMask(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    camera->setRenderOrder(osg::Camera::PRE_RENDER, number);
    camera->setRenderTargetImplementation(osg::Camera::FRAME_BUFFER_OBJECT);
    camera->attach(osg::Camera::COLOR_BUFFER, texture);
    camera->addChild(model);
    return camera;
}

osg::ref_ptr<osg::Texture2D> target()
{
    return osgEnvLight::targetTexture(16, 16, GL_RGBA8);
}

osg::ref_ptr<osg::Geode> screenOf(osg::Texture2D* texture)
{
    osg::ref_ptr<osg::Geode> screen = wall(osg::Vec4(1, 1, 1, 1));
    osg::ref_ptr<osg::Vec2Array> st = new osg::Vec2Array;
    for (const osg::Vec2& p : {osg::Vec2(0, 0), osg::Vec2(1, 0), osg::Vec2(1, 1), osg::Vec2(0, 1)}) st->push_back(p);
    screen->getDrawable(0)->asGeometry()->setTexCoordArray(0, st);
    screen->getOrCreateStateSet()->setTextureAttributeAndModes(0, texture);
    return screen;
}

std::vector<unsigned char> bytesOf(SceneRenderer& renderer, osg::Texture2D& texture)
{
    osg::State& state = renderer.state();
    std::vector<unsigned char> bytes(16 * 16 * 4);
    state.setActiveTextureUnit(0);
    texture.getTextureObject(state.getContextID())->bind();
    glGetTexImage(GL_TEXTURE_2D, 0, GL_RGBA, GL_UNSIGNED_BYTE, bytes.data());
    state.haveAppliedTextureAttribute(0, osg::StateAttribute::TEXTURE);
    return bytes;
}

osg::ref_ptr<LitScene> furnace()
{
    osg::ref_ptr<LitScene> lit = makeLit(constantMap(1.0).get());
    lit->getSettings()->occlusion = false;
    return lit;
}

}  // namespace

TEST(Cameras, AnOverlayBelowTheNodeIsDrawnAsWithoutUs)
{
    WindowRenderer renderer(size, size);
    for (osg::Camera::RenderOrder order : {osg::Camera::POST_RENDER, osg::Camera::NESTED_RENDER})
        for (bool wide : {false, true}) {
            const osg::ref_ptr<osg::Camera> hud = overlay(order, osg::Vec4(0.25f, 0.5f, 0.75f, 1));
            if (wide) hud->setViewport(8, 0, 24, 32);
            const osg::ref_ptr<osg::Group> plain = new osg::Group;
            plain->addChild(wall(osg::Vec4(1, 0, 0, 1)));
            plain->addChild(hud);
            const osg::ref_ptr<osg::Image> before = renderer.render(plain, 2);
            const osg::ref_ptr<LitScene> lit = furnace();
            lit->addChild(plain);
            const osg::ref_ptr<osg::Image> found = renderer.render(lit, 3);
            int seen = 0;
            for (int y = 0; y < size; ++y)
                for (int x = 0; x < size; ++x) {
                    if (pixelOf(*before, x, y)[2] < 0.5) continue;  // the wall, which we light
                    ++seen;
                    EXPECT_EQ(pixelOf(*before, x, y), pixelOf(*found, x, y)) << x << " " << y << " order " << order;
                }
            EXPECT_GE(seen, 12 * 16) << "order " << order;
            EXPECT_NEAR(pixelOf(*found, 30, 30)[0], 1.0, 0.01) << "the wall is lit";
        }
}

TEST(Cameras, ATextureRenderedBelowTheNodeIsByteForByteAsWithoutUsFromTheFirstFrame)
{
    for (int number : {0, 7, -3}) {
        SceneRenderer plainRenderer(size, size);
        const osg::ref_ptr<osg::Node> model = colored(makeSphere(osg::Vec3d(), 1.0, 48), osg::Vec4(0.9f, 0.6f, 0.2f, 1));
        const auto scene = [&](osg::Group& root, osg::Texture2D* texture) {
            root.addChild(screenOf(texture));
            root.addChild(intoTexture(texture, model, number));
        };
        const osg::ref_ptr<osg::Texture2D> expected = target();
        const osg::ref_ptr<osg::Group> plain = new osg::Group;
        scene(*plain, expected);
        plainRenderer.render(plain, 1);
        const auto bytes = bytesOf(plainRenderer, *expected);

        SceneRenderer renderer(size, size);
        const osg::ref_ptr<osg::Texture2D> texture = target();
        const osg::ref_ptr<LitScene> lit = furnace();
        scene(*lit, texture);
        const Picture first = renderer.render(lit, 1);
        EXPECT_EQ(bytes, bytesOf(renderer, *texture)) << "order " << number;
        EXPECT_GT(first.color(16, 16)[0], 0.05) << "it is there before the screen that shows it; order " << number;
    }
}

TEST(Cameras, ATextureRenderedBesideTheNodeIsThereInTheFirstFrame)
{
    for (int number : {0, 5}) {
        SceneRenderer renderer(size, size);
        const osg::ref_ptr<osg::Texture2D> texture = target();
        const osg::ref_ptr<osg::Group> root = new osg::Group;
        const osg::ref_ptr<LitScene> lit = furnace();
        lit->addChild(screenOf(texture));
        root->addChild(lit);
        root->addChild(intoTexture(texture, wall(osg::Vec4(0, 1, 0, 1)), number));  // after the node
        EXPECT_GT(renderer.render(root, 1).color(16, 16)[1], 0.1) << "order " << number;
    }
}

TEST(Cameras, AMirrorShowsTheSceneLit)
{
    // The mirror's camera shows the node itself, beside it; or has a LitScene of its own below the node.
    for (bool below : {false, true}) {
        SceneRenderer renderer(size, size);
        const osg::ref_ptr<osg::Texture2D> texture = target();
        const osg::ref_ptr<osg::Geode> white = colored(makeSphere(osg::Vec3d(), 1.0, 48), osg::Vec4(1, 1, 1, 1));
        const osg::ref_ptr<osg::Group> root = new osg::Group;
        const osg::ref_ptr<LitScene> lit = furnace();
        lit->addChild(white);
        root->addChild(lit);
        const osg::ref_ptr<LitScene> inner = furnace();
        inner->addChild(white);
        (below ? lit.get() : root.get())->addChild(intoTexture(texture, below ? inner.get() : lit.get()));
        NotifyCatcher notify;
        const Picture p = renderer.render(root, 3);
        EXPECT_NEAR(p.color(16, 16)[0], 1.0, 0.01) << "below " << below;
        const auto bytes = bytesOf(renderer, *texture);
        // White in the white furnace to its very edge, where a headlight would leave it dark.
        EXPECT_GE(int(bytes[4 * (16 * 8 + 8)]), 253) << "below " << below;
        EXPECT_GE(int(bytes[4 * (16 * 8 + 12)]), 253) << "below " << below;
        EXPECT_EQ("", notify.text());
    }
}

TEST(Cameras, AStillViewThatConvergesKeepsItsOverlay)
{
    WindowRenderer renderer(size, size);
    const osg::ref_ptr<LitScene> lit = makeLit(lopsidedMap().get());
    lit->getSettings()->accumulate = true;
    lit->getSettings()->accumulateFrames = 4;
    lit->getSettings()->atlasLights = 16;
    lit->addChild(makeBox(osg::Vec3d(-1, -1, -1), osg::Vec3d(1, 1, 1)));
    lit->addChild(overlay(osg::Camera::POST_RENDER, osg::Vec4(0.25f, 0.5f, 0.75f, 1)));
    for (int frame = 0; frame < 12; ++frame)
        EXPECT_NEAR(pixelOf(*renderer.render(lit, 1), 4, 4)[2], 0.75, 0.5 / 255.0) << "frame " << frame;
    EXPECT_EQ(lit->average().frames, 4u);
}

}  // namespace Cameras_test

// SPDX-License-Identifier: MIT
// The application's fog before what the environment lights.
#include <osgEnvLight/Material>

#include <osg/BlendFunc>
#include <osg/Fog>

#include <gtest/gtest.h>

#include <cmath>

#include "FeatureCards.h"

namespace Fog_test
{

using namespace feature_cards;

namespace
{

osg::ref_ptr<osg::Fog> blueFog(osg::Fog::Mode mode, float density = 0.2f)
{
    const osg::ref_ptr<osg::Fog> fog = new osg::Fog;
    fog->setMode(mode);
    fog->setColor(osg::Vec4(0, 0, 1, 1));
    fog->setDensity(density);
    fog->setStart(2.0f);
    fog->setEnd(8.0f);
    return fog;
}

// The red and blue of a white surface in the furnace at that distance.
void expectFogged(const osg::Vec3d& c, double leaves)
{
    EXPECT_NEAR(leaves, c[0], 0.003);
    EXPECT_NEAR(1.0, c[2], 0.003);
}

// By few and coarse maps.
void converges(LitScene& scene)
{
    scene.getSettings()->accumulate = true;
    scene.getSettings()->accumulateFrames = 24;
    scene.getSettings()->accumulateLights = 16;
    scene.getSettings()->accumulateSize = 32;
}

osg::ref_ptr<osg::Geode> half(bool left)
{
    return makeQuad(osg::Vec3d(left ? -3 : 0, 0, -3), osg::Vec3d(3, 0, 0), osg::Vec3d(0, 0, 6));
}

}  // namespace

TEST_F(Features, FogTakesItsShareOfTheLight)
{
    const osg::ref_ptr<osg::Geode> model = card();  // at distance 4
    const auto with = [&](osg::Fog* fog) {
        model->getOrCreateStateSet()->setAttributeAndModes(fog);
        return lit(model);
    };
    expectFogged(with(blueFog(osg::Fog::LINEAR)), 4.0 / 6.0);
    expectFogged(with(blueFog(osg::Fog::EXP)), std::exp(-0.8));
    expectFogged(with(blueFog(osg::Fog::EXP2)), std::exp(-0.64));
    model->getOrCreateStateSet()->setMode(GL_LIGHTING, osg::StateAttribute::OFF);
    expectFogged(with(blueFog(osg::Fog::EXP)), std::exp(-0.8));
}

// The corner of the picture, 20 degrees up and aside, is further from the eye than from its plane.
TEST_F(Features, FogIsByThePlaneOfTheEyeOrByTheDistance)
{
    const osg::ref_ptr<osg::Geode> model = card();
    const osg::ref_ptr<osg::Fog> fog = blueFog(osg::Fog::EXP);
    model->getOrCreateStateSet()->setAttributeAndModes(fog);
    expectFogged(lit(model, 0, 0), std::exp(-0.8));
    fog->setUseRadialFog(true);
    const double t = std::tan(osg::DegreesToRadians(20.0)) * (size - 1.0) / size;
    expectFogged(lit(model, 0, 0), std::exp(-0.8 * std::sqrt(1.0 + 2.0 * t * t)));
}

TEST_F(Features, FogIsBeforeThatWhoseStateHasIt)
{
    const osg::ref_ptr<osg::Group> model = new osg::Group;
    model->addChild(half(true));
    model->addChild(half(false));
    const double white = lit(model, 4)[0];
    model->getChild(0)->getOrCreateStateSet()->setAttributeAndModes(blueFog(osg::Fog::EXP));
    EXPECT_NEAR(white * std::exp(-0.8), lit(model, 4)[0], 0.003);
    EXPECT_NEAR(white, lit(model, size - 4)[0], 0.003);
    EXPECT_NEAR(white, lit(model, size - 4)[2], 0.003);
}

TEST_F(Features, FogOfTheRootIsBeforeAll)
{
    const osg::ref_ptr<osg::Group> root = new osg::Group;
    root->addChild(furnace(card()));
    root->getOrCreateStateSet()->setAttributeAndModes(blueFog(osg::Fog::EXP));
    expectFogged(renderer.render(root, 2).color(size / 2, size / 2), std::exp(-0.8));
}

TEST_F(Features, FogIsBeforeWhatIsBlended)
{
    const osg::ref_ptr<osg::Geode> model = card(3.0, osg::Vec4(1, 1, 1, 0.5f));
    osg::StateSet& state = *model->getOrCreateStateSet();
    state.setAttributeAndModes(new osg::BlendFunc);
    state.setAttributeAndModes(blueFog(osg::Fog::EXP));
    const osg::ref_ptr<LitScene> scene = furnace(model);
    const Picture p = renderer.render(scene, 2);
    EXPECT_EQ(1u, scene->plan().surfaces.litForward);
    EXPECT_NEAR(0.5 * std::exp(-0.8), p.color(size / 2, size / 2)[0], 0.005);
    EXPECT_NEAR(0.5, p.color(size / 2, size / 2)[2], 0.005);
}

// No term of a frame, nor of a still view, comes past it.
TEST_F(Features, ThickFogHidesEveryTerm)
{
    const osg::ref_ptr<LitScene> scene = makeLit(makeMap(64, 32, sixDirectionColor).get());
    scene->getSettings()->background = Settings::BACKGROUND_OFF;
    scene->getSettings()->bounce = Settings::BOUNCE_PROBES;
    scene->getSettings()->bounceProbes = fewestProbes;
    converges(*scene);
    const osg::ref_ptr<osg::Geode> ball = makeSphere(osg::Vec3d(), 0.8, 24);
    osgEnvLight::Material::setCookTorrance(*ball->getOrCreateStateSet(), osg::Vec3(0.9f, 0.8f, 0.7f), 1.0f, 0.2f);
    scene->addChild(ball);
    scene->addChild(makeQuad(osg::Vec3d(-9, -9, -1), osg::Vec3d(18, 0, 0), osg::Vec3d(0, 18, 0)));
    scene->getOrCreateStateSet()->setAttributeAndModes(blueFog(osg::Fog::EXP, 100.0f));
    renderer.lookAt(osg::Vec3d(0, -4, 2), osg::Vec3d());
    Picture p = renderer.render(scene, 2);
    for (const unsigned frames : {0u, 24u}) {
        // A still view begins when its probes are there.
        for (int i = 0; i < 500 && scene->average().frames < frames; ++i) p = renderer.render(scene, 4);
        EXPECT_EQ(frames, scene->average().frames);
        for (const osg::Vec2i& q : {osg::Vec2i(size / 2, size / 2), osg::Vec2i(size / 2, 1), osg::Vec2i(4, 4)}) {
            const osg::Vec3d c = p.color(q.x(), q.y());
            EXPECT_NEAR(0.0, c[0], 1e-4) << frames << " at " << q.x() << ", " << q.y();
            EXPECT_NEAR(1.0, c[2], 1e-3) << frames << " at " << q.x() << ", " << q.y();
        }
    }
}

TEST_F(Features, AStillViewStartsAnewWhenItsFogChanges)
{
    const osg::ref_ptr<osg::Geode> model = card();
    const osg::ref_ptr<osg::Fog> fog = blueFog(osg::Fog::EXP);
    model->getOrCreateStateSet()->setAttributeAndModes(fog);
    const osg::ref_ptr<LitScene> scene = furnace(model);
    scene->getSettings()->occlusion = true;
    converges(*scene);
    renderer.render(scene, 30);
    EXPECT_GT(scene->average().frames, 8u);
    fog->setDensity(0.1f);
    expectFogged(renderer.render(scene, 2).color(size / 2, size / 2), std::exp(-0.4));
}

TEST_F(Features, OfSeveralFogsTheFirstIsDrawnAndThatIsSaidOnce)
{
    const osg::ref_ptr<osg::Group> model = new osg::Group;
    model->addChild(half(true));
    model->addChild(half(false));
    model->getChild(0)->getOrCreateStateSet()->setAttributeAndModes(blueFog(osg::Fog::EXP));
    model->getChild(1)->getOrCreateStateSet()->setAttributeAndModes(blueFog(osg::Fog::EXP, 0.4f));
    NotifyCatcher notify;
    lit(model);
    const size_t first = notify.text().find("a second fog");
    EXPECT_NE(std::string::npos, first) << notify.text();
    EXPECT_EQ(std::string::npos, notify.text().find("fog", first + 12));
}

}  // namespace Fog_test

// SPDX-License-Identifier: MIT
// Shadow maps of what a view shows of a scene that is far larger.
#include "AtlasScenes.h"

#include <osgEnvLight/Plan>

#include "TracedView.h"

namespace NearCascade_test
{

using namespace atlasscenes;
using osgEnvLight::Layer;

namespace
{

// Boxes in the corners of a square of that half side, out of all views here.
void enlarge(LitScene& lit, double half)
{
    for (double x : {-half, half})
        for (double y : {-half, half})
            lit.addChild(makeBox(osg::Vec3d(x - 4, y - 4, -half / 20), osg::Vec3d(x + 4, y + 4, -half / 40)));
}

// Until what the view shows is known, and drawn.
const int settled = 5;

}  // namespace

// A texel of maps of all of it would be four walls high.
TEST(NearCascade, WallWithinThreePercentInALargeScene)
{
    SceneRenderer renderer(384, 384);
    const osg::ref_ptr<LitScene> lit = atlasScene();
    enlarge(*lit, 200.0);
    expectWallWithinThreePercent(renderer, *lit, settled);
}

// Towers about the eye, which looks from among them.
class Streets : public testing::Test
{
  protected:
    Streets()
    {
        lit->getSettings()->regeneration = Settings::BACKGROUND;
        lit->getSettings()->atlasLights = 64;
        lit->addChild(makeBox(osg::Vec3d(-400, -400, -1), osg::Vec3d(400, 400, 0)));
        for (int x = -5; x < 5; ++x)
            for (int y = -5; y < 5; ++y)
                lit->addChild(
                    makeBox(osg::Vec3d(12 * x + 2, 12 * y + 2, 0), osg::Vec3d(12 * x + 10, 12 * y + 10, 8 + (x * y) % 5)));
    }
    void look(double degrees, const osg::Vec3d& eye = osg::Vec3d(0, 0, 1.7))
    {
        const double a = osg::DegreesToRadians(degrees);
        renderer.lookAt(eye, eye + osg::Vec3d(std::sin(a), std::cos(a), -0.1), osg::Vec3d(0, 0, 1), 60.0);
    }
    void settle(int least = settled)
    {
        renderer.render(lit, least);
        for (int i = 0; i < 64 && lit->regenerating(); ++i) renderer.render(lit);
        ASSERT_FALSE(lit->regenerating());
    }

    // As the traced picture shows it.
    Settings& showDirectLight(int atlasLights)
    {
        Settings& s = *lit->getSettings();
        s.view = Settings::BEAUTY;
        s.bounce = Settings::BOUNCE_OFF;
        s.reflections = Settings::REFLECTIONS_MAP;
        s.atlasLights = atlasLights;
        return s;
    }
    double errorOf(const Picture& p, unsigned samples, bool antialias)
    {
        return rootMeanSquare(p, tracedView(*lit, renderer, samples, {Layer::BEAUTY}, antialias).mean(Layer::BEAUTY));
    }

    SceneRenderer renderer{96, 64};
    osg::ref_ptr<LitScene> lit = atlasScene();
};

TEST_F(Streets, ThePlanSaysSo)
{
    look(0.0);
    settle();
    EXPECT_NE(std::string::npos, lit->plan().explain().find("neighbourhood")) << lit->plan().explain();
    renderer.lookAt(osg::Vec3d(0, -900, 900), osg::Vec3d());
    settle();
    EXPECT_EQ(std::string::npos, lit->plan().explain().find("neighbourhood")) << lit->plan().explain();
}

TEST_F(Streets, TurningDrawsNoMap)
{
    look(0.0);
    settle();
    const Picture first = renderer.render(lit);
    for (double degrees : {30.0, 90.0, 180.0, 270.0}) {
        look(degrees);
        renderer.render(lit, settled);
        EXPECT_FALSE(lit->regenerating()) << degrees;
    }
    look(0.0);
    EXPECT_EQ(0.0, largestDifference(first, renderer.render(lit)));
}

// Maps follow the view a few a frame: what comes nearer goes over to them light by light, in smaller steps than at once.
TEST_F(Streets, WalkingRefinesMapByMap)
{
    unsigned frames = 0;
    const auto largestStep = [&](int maps) {
        lit->getSettings()->atlasUpdatesPerFrame = maps;
        look(0.0);
        settle();
        double most = 0.0;
        for (int step = 1; step <= 12; ++step) {
            look(0.0, osg::Vec3d(0, 2.0 * step, 1.7));
            Picture last = renderer.render(lit);
            for (; lit->regenerating(); ++frames) {
                const Picture next = renderer.render(lit);
                most = std::max(most, rootMeanSquare(last, next));
                last = next;
            }
        }
        return most;
    };
    const double some = largestStep(8);
    EXPECT_GT(frames, 12u + 64 / 8);          // at least one whole refresh
    EXPECT_LT(some, 0.02);                    // measured .016
    EXPECT_LT(some, 0.75 * largestStep(64));  // measured .63: the brightest lights' maps come first, and carry most of it
}

// Against the traced picture, whose own noise is .018. With maps of the whole scene alone .16 (measured).
TEST_F(Streets, AreShadedAsInASmallScene)
{
    Settings& s = showDirectLight(256);
    s.visibility = Settings::VISIBILITY_AUTO;
    s.regeneration = Settings::IMMEDIATE;
    double error = 0.0;
    for (int i = 0; i < 4; ++i) {
        look(25.0 * i, osg::Vec3d(0.5 * i, 7.0 * i, 1.7 + 2 * i));
        const Picture p = renderer.render(lit, settled);
        error += 0.25 * errorOf(p, 64, false);
    }
    EXPECT_LT(error, 0.032);  // measured .0278
}

// From afar the neighbourhood is about what is seen.
TEST_F(Streets, AnOrthographicViewFromAfar)
{
    Settings& s = showDirectLight(256);
    s.regeneration = Settings::IMMEDIATE;
    renderer.lookAt(osg::Vec3d(0, -300, 300), osg::Vec3d());
    renderer.viewer().getCamera()->setProjectionMatrixAsOrtho(-30, 30, -20, 20, 1, 1000);
    const Picture p = renderer.render(lit, settled);
    EXPECT_NE(std::string::npos, lit->plan().explain().find("neighbourhood"));
    const double error = errorOf(p, 64, false);
    EXPECT_LT(error, 0.045);  // measured .039
}

TEST_F(Streets, AStillViewConvergesToTheTruth)
{
    Settings& s = showDirectLight(64);
    s.accumulate = true;
    s.accumulateSize = 256;
    look(25.0, osg::Vec3d(0.5, 7, 3.7));
    settle();
    const Picture p = renderer.render(lit, 36);
    // Measured .025; with maps of up to 1024 texels .013, of which .009 are the reference's noise.
    EXPECT_LT(errorOf(p, 256, true), 0.03);
}

}  // namespace NearCascade_test

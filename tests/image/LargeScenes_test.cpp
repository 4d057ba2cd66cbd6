// SPDX-License-Identifier: MIT
// Light between the surfaces of a scene that is far larger than what a view shows.
#include "AtlasScenes.h"
#include "SunScenes.h"

#include <osgEnvLight/Material>
#include <osgEnvLight/Plan>

#include "TracedView.h"

namespace LargeScenes_test
{

using osgEnvLight::Layer;
using osgEnvLight::LitScene;
using osgEnvLight::Material;
using osgEnvLight::Settings;

namespace
{

const int settled = 5;  // frames until what the view shows is known, and drawn

// Blocks of four colours at streets 4 wide on a ground 600 wide.
osg::ref_ptr<LitScene> makeTown(osg::Image* map)
{
    osg::ref_ptr<LitScene> lit = makeLit(map);
    Settings& s = *lit->getSettings();
    s.bounce = Settings::BOUNCE_PROBES;
    s.bounceProbes = 8;
    s.atlasLights = 64;
    s.regeneration = Settings::IMMEDIATE;
    const auto add = [&](const osg::Vec3d& low, const osg::Vec3d& high, const osg::Vec3f& albedo) {
        const osg::ref_ptr<osg::Geode> box = makeBox(low, high);
        Material::setLambert(*box->getOrCreateStateSet(), albedo);
        lit->addChild(box);
    };
    add(osg::Vec3d(-300, -300, -1), osg::Vec3d(300, 300, 0), osg::Vec3f(0.3f, 0.3f, 0.3f));
    const osg::Vec3f colors[] = {{0.7f, 0.7f, 0.7f}, {0.65f, 0.25f, 0.2f}, {0.7f, 0.65f, 0.4f}, {0.4f, 0.5f, 0.55f}};
    for (int x = -5; x < 5; ++x)
        for (int y = -5; y < 5; ++y)
            add(osg::Vec3d(12 * x + 2, 12 * y + 2, 0), osg::Vec3d(12 * x + 10, 12 * y + 10, 7 + (x * y) % 4),
                colors[(x + 2 * y + 15) % 4]);
    return lit;
}

class Town : public testing::Test
{
  protected:
    void look(double degrees, const osg::Vec3d& eye)
    {
        const double a = osg::DegreesToRadians(degrees);
        renderer.lookAt(eye, eye + osg::Vec3d(std::sin(a), std::cos(a), 0.1), osg::Vec3d(0, 0, 1), 60.0);
    }

    SceneRenderer renderer{96, 64};
};

}  // namespace

// Probes all over the scene are 80 apart. With the mean radiance, and where points ask the suns' maps as far off their surfaces
// as the texels of the whole scene's maps are wide, the error is .023; of direct light alone .006.
TEST_F(Town, StreetsAreLitAsThoseOfSmallScenes)
{
    const osg::ref_ptr<LitScene> lit = makeTown(sunscenes::sunMap(osg::Vec3d(1, 0.2, 1.5), 3.0, 0.2, 200.0).get());
    lit->getSettings()->suns = Settings::SUNS_AUTO;
    look(10.0, osg::Vec3d(0, 3, 1.7));
    const Picture p = renderer.render(lit, settled);
    const auto full = osgEnvLight::ReferenceOptions::FULL;
    const Picture truth = tracedView(*lit, renderer, 256, {Layer::BEAUTY}, false, full).mean(Layer::BEAUTY);
    EXPECT_LT(rootMeanSquare(p, truth), 0.013);  // measured .0101
    const std::string why = lit->plan().reason("links");
    EXPECT_NE(std::string::npos, why.find("8 x 8 x 4 probes, and as many in each of 2 grids about the view")) << why;
}

// Finer grids follow the view, in steps that pictures hardly show.
TEST_F(Town, AStepOfTheGridsIsHardlySeen)
{
    const osg::ref_ptr<LitScene> lit = makeTown(constantMap(1.0).get());
    lit->getSettings()->regeneration = Settings::BACKGROUND;
    double most = 0.0;
    const auto at = [&](double y) {
        look(0.0, osg::Vec3d(0, y, 1.7));
        Picture last = renderer.render(lit, settled);
        for (int i = 0; i < 1000 && lit->regenerating(); ++i) {
            const Picture next = renderer.render(lit);
            most = std::max(most, rootMeanSquare(last, next));
            last = next;
        }
        EXPECT_FALSE(lit->regenerating());
        return last;
    };
    at(0.0);
    const Picture about0 = at(2.0);
    most = 0.0;
    at(4.0);
    const Picture about4 = at(2.0);
    // Measured .0038 and .040; with grids about the eye itself .0081 and .145.
    EXPECT_LT(rootMeanSquare(about0, about4), 0.005);
    EXPECT_LT(largestDifference(about0, about4), 0.06);
    EXPECT_LT(most, 0.0065);  // .0050, and .0089
    EXPECT_GT(rootMeanSquare(about0, about4), 1e-4) << "the grids did not step";
}

}  // namespace LargeScenes_test

// SPDX-License-Identifier: MIT
// The application's lights, their shadows and what surfaces send on of them, beside full light transport.
#include <Maps.h>
#include <SceneRenderer.h>
#include <TracedView.h>

#include <metrics/Mask>
#include <metrics/Metrics>
#include <osgEnvLight/Material>

#include <osg/LightSource>

#include <gtest/gtest.h>

#include "ClosedRoom.h"

namespace SceneLightTruth_test
{

using namespace osgEnvLight;

namespace
{

osg::ref_ptr<LitScene> makeDark()
{
    osg::ref_ptr<LitScene> lit = makeLit(constantMap(0.0).get());
    lit->getSettings()->regeneration = Settings::IMMEDIATE;
    lit->getSettings()->bounce = Settings::BOUNCE_PROBES;
    return lit;
}

osg::ref_ptr<osg::LightSource> addSpot(LitScene& lit, const osg::Vec3& direction, double cutoff)
{
    const osg::ref_ptr<osg::LightSource> lamp = new osg::LightSource;
    osg::Light& light = *lamp->getLight();
    light.setLightNum(1);
    light.setDiffuse(osg::Vec4(1, 1, 1, 1));
    light.setDirection(direction);
    light.setSpotCutoff(float(osg::RadiansToDegrees(cutoff)));
    lit.addChild(lamp);
    lit.getOrCreateStateSet()->setMode(GL_LIGHT1, osg::StateAttribute::ON);
    return lamp;
}

// A room of white walls, one of them red, with a box in it, which only a spot lights.
osg::ref_ptr<LitScene> makeRoom(double cutoff)
{
    const osg::ref_ptr<LitScene> room = makeDark();
    addClosedRoom(*room, 1.0, 1.2);
    Material::setLambert(*room->getOrCreateStateSet(), osg::Vec3f(0.7f, 0.7f, 0.7f));
    Material::setLambert(*room->getChild(0)->getOrCreateStateSet(), osg::Vec3f(0.7f, 0.1f, 0.1f));
    room->addChild(makeBox(osg::Vec3d(0.1, -0.1, -1), osg::Vec3d(0.6, 0.4, -0.3)));
    osg::Light& light = *addSpot(*room, osg::Vec3(0.1f, 0.05f, -1), osg::DegreesToRadians(cutoff))->getLight();
    light.setPosition(osg::Vec4(-0.2f, 0.1f, 0.9f, 1));
    light.setDiffuse(osg::Vec4(4, 4, 4, 1));
    return room;
}

// Of the pixels that show a surface.
double meanOf(const Picture& p)
{
    double sum = 0.0;
    int count = 0;
    for (int y = 0; y < p.height; ++y)
        for (int x = 0; x < p.width; ++x)
            if (p.alpha(x, y) > 0.5f) {
                sum += p.color(x, y)[1];
                ++count;
            }
    EXPECT_GT(count, 0);
    return sum / std::max(count, 1);
}

}  // namespace

// tRMSE, measured, of a spot that lights half of the floor and of one that lights a tenth of it: direct light .022, .0001 (the
// edges of shadows); with what goes on, probes .019, .043, the mean .12, .29, none .30, .27.
TEST(SceneLights, ASpotsLightInARoomIsThatOfFullTransport)
{
    struct Bounds {
        double cutoff, direct, full;
    };
    for (const Bounds& most : {Bounds{35.0, 0.03, 0.03}, Bounds{12.0, 0.001, 0.06}}) {
        const osg::ref_ptr<LitScene> room = makeRoom(most.cutoff);
        SceneRenderer view(96, 72);
        view.lookAt(osg::Vec3d(-0.1, -0.95, 0.3), osg::Vec3d(0.05, 0.6, -0.35));
        view.viewer().getCamera()->setProjectionMatrixAsPerspective(75.0, 4.0 / 3.0, 0.02, 100.0);
        const auto traced = [&](ReferenceOptions::Paths paths, unsigned samples) {
            return tracedView(*room, view, samples, {Layer::BEAUTY}, false, paths).mean(Layer::BEAUTY);
        };
        const Picture direct = traced(ReferenceOptions::DIRECT, 1), full = traced(ReferenceOptions::FULL, 512);
        const Mask mask = Mask::geometry(full);
        room->getSettings()->bounce = Settings::BOUNCE_OFF;
        EXPECT_LT(compare(view.render(room, 2), direct, mask).tRmse, most.direct) << most.cutoff;
        EXPECT_GT(compare(view.render(room, 2), full, mask).tRmse, 0.2) << "most of the picture is lit by walls";
        room->getSettings()->bounce = Settings::BOUNCE_PROBES;
        EXPECT_LT(compare(view.render(room, 4), full, mask).tRmse, most.full) << most.cutoff;
    }
}

// A spot on the floor of a room is as large as what six surface points stand for. All that it sends comes back from the walls,
// wherever it falls: rho^2 / (1 - rho) of its flux over pi and their area. The mean over the room, which a cube's faces show
// evenly. The probes leave .96 of it (8 x 8 x 4 of them .88).
TEST(SceneLights, ASmallSpotSendsOnItsFlux)
{
    const double albedo = 0.5, height = 1.5, radius = 0.2;
    osg::ref_ptr<LitScene> lit = makeDark();
    addClosedRoom(*lit, 1.0, 1.2);
    Material::setLambert(*lit->getOrCreateStateSet(), osg::Vec3f(1, 1, 1) * float(albedo));
    lit->getSettings()->view = Settings::BOUNCED;
    const osg::ref_ptr<osg::LightSource> lamp = addSpot(*lit, osg::Vec3(0, 0, -1), std::atan(radius / height));

    SceneRenderer renderer(24, 24);
    osg::Camera& camera = *renderer.viewer().getCamera();
    camera.setProjectionMatrixAsPerspective(90.0, 1.0, 0.05, 100.0);
    const double flux = 2.0 * M_PI * M_PI * height * (std::hypot(radius, height) - height);  // of radiance cos on white
    const double expected = albedo * albedo / (1.0 - albedo) * flux / (M_PI * 24.0);
    const std::vector<osg::Vec2d> places = {{0, 0}, {0.31, -0.17}, {-0.23, 0.41}, {0.07, 0.29}, {-0.36, -0.33}, {0.45, 0.13}};
    double mean = 0.0, squares = 0.0;
    for (const osg::Vec2d& at : places) {
        lamp->getLight()->setPosition(osg::Vec4(float(at[0]), float(at[1]), float(height - 1.0), 1));
        double sum = 0.0;
        for (int face = 0; face < 6; ++face) {
            osg::Vec3d to, up;
            to[face / 2] = face % 2 ? 1.0 : -1.0;
            up[(face / 2 + 1) % 3] = 1.0;
            camera.setViewMatrixAsLookAt(osg::Vec3d(), to, up);
            sum += meanOf(renderer.render(lit)) / 6.0;
        }
        mean += sum / expected / double(places.size());
        squares += std::pow(sum / expected, 2) / double(places.size());
    }
    EXPECT_NEAR(0.96, mean, 0.05);
    EXPECT_LT(std::sqrt(squares - mean * mean), 0.12 * mean);
}

// Under a black map only lamps send light. A lamp that shines away from all surfaces leaves the bounce dark, however much of the
// sky the surfaces see.
TEST(SceneLights, ABlackSkySendsNothing)
{
    SceneRenderer renderer(48, 48);
    renderer.lookAt(osg::Vec3d(0, -6, 3), osg::Vec3d(0, 0, 0.4));
    osg::ref_ptr<LitScene> lit = makeDark();
    lit->addChild(makeQuad(osg::Vec3d(-2, -2, 0), osg::Vec3d(4, 0, 0), osg::Vec3d(0, 4, 0)));
    lit->addChild(makeBox(osg::Vec3d(-0.5, 0, 0), osg::Vec3d(0.5, 0.5, 1)));
    Material::setLambert(*lit->getOrCreateStateSet(), osg::Vec3f(0.5f, 0.5f, 0.5f));
    const osg::ref_ptr<osg::LightSource> lamp = addSpot(*lit, osg::Vec3(0, 0, 1), 0.5);
    lamp->getLight()->setPosition(osg::Vec4(0, 0, 2, 1));
    lit->getSettings()->view = Settings::BOUNCED;
    EXPECT_EQ(0.0, meanOf(renderer.render(lit, 2)));
    EXPECT_TRUE(lit->plan().runs("points"));
    lamp->getLight()->setDirection(osg::Vec3(0, 0, -1));
    EXPECT_GT(meanOf(renderer.render(lit, 2)), 1e-3);
}

}  // namespace SceneLightTruth_test

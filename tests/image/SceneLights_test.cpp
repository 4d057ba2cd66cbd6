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

// A room of white walls, one of them red, with a box in it, which only a spot lights.
osg::ref_ptr<LitScene> makeRoom(double cutoff)
{
    const osg::ref_ptr<LitScene> room = makeLit(constantMap(0.0).get());
    room->getSettings()->materialColors = Settings::COLORS_LINEAR;
    room->getSettings()->regeneration = Settings::IMMEDIATE;
    addClosedRoom(*room, 1.0, 1.2);
    Material::setLambert(*room->getOrCreateStateSet(), osg::Vec3f(0.7f, 0.7f, 0.7f));
    Material::setLambert(*room->getChild(0)->getOrCreateStateSet(), osg::Vec3f(0.7f, 0.1f, 0.1f));
    room->addChild(makeBox(osg::Vec3d(0.1, -0.1, -1), osg::Vec3d(0.6, 0.4, -0.3)));
    const osg::ref_ptr<osg::LightSource> source = new osg::LightSource;
    osg::Light& light = *source->getLight();
    light.setLightNum(1);
    light.setPosition(osg::Vec4(-0.2f, 0.1f, 0.9f, 1));
    light.setDirection(osg::Vec3(0.1f, 0.05f, -1));
    light.setDiffuse(osg::Vec4(4, 4, 4, 1));
    light.setSpotCutoff(float(cutoff));
    room->addChild(source);
    room->getOrCreateStateSet()->setMode(GL_LIGHT1, osg::StateAttribute::ON);
    return room;
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

}  // namespace SceneLightTruth_test

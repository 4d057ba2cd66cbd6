// SPDX-License-Identifier: MIT
// What glows in a model lights it as it should.
#include <Maps.h>
#include <SceneRenderer.h>
#include <TracedView.h>

#include <metrics/Mask>
#include <metrics/Metrics>
#include <osgEnvLight/Material>

#include <gtest/gtest.h>

namespace MeshLightTruth_test
{

using namespace osgEnvLight;

// A glowing ceiling lights a room. Beside full light transport nothing is counted twice. tRMSE, measured: .036 with the mean
// bounce, .034 with probes, and .30 if the ceiling is no light.
TEST(MeshLights, LightARoomOnce)
{
    const osg::ref_ptr<LitScene> room = makeLit(constantMap(0.0).get());
    room->getSettings()->materialColors = Settings::COLORS_LINEAR;
    room->getSettings()->regeneration = Settings::IMMEDIATE;
    const osg::ref_ptr<osg::Geode> floor = makeQuad(osg::Vec3d(-2, -2, 0), osg::Vec3d(4, 0, 0), osg::Vec3d(0, 4, 0));
    const osg::ref_ptr<osg::Geode> wall = makeQuad(osg::Vec3d(-2, 2, 0), osg::Vec3d(4, 0, 0), osg::Vec3d(0, 0, 3));
    for (osg::Geode* g : {floor.get(), wall.get()}) {
        Material::setLambert(*g->getOrCreateStateSet(), osg::Vec3f(0.7f, 0.7f, 0.7f));
        room->addChild(g);
    }
    const osg::ref_ptr<osg::Geode> box = makeBox(osg::Vec3d(-0.7, 0, 0), osg::Vec3d(0.1, 0.8, 1.2));
    Material::setLambert(*box->getOrCreateStateSet(), osg::Vec3f(0.7f, 0.3f, 0.2f));
    room->addChild(box);
    const osg::ref_ptr<osg::Geode> ceiling = makeQuad(osg::Vec3d(-1.5, 1.5, 2.8), osg::Vec3d(3, 0, 0), osg::Vec3d(0, -3, 0));
    Material::setLambert(*ceiling->getOrCreateStateSet(), osg::Vec3f());
    Material::setEmission(*ceiling->getStateSet(), osg::Vec3f(2, 2, 2));
    room->addChild(ceiling);
    SceneRenderer view(96, 72);
    view.lookAt(osg::Vec3d(0.5, -6, 1.6), osg::Vec3d(0, 0, 1), osg::Vec3d(0, 0, 1), 40.0);
    const Picture truth = tracedView(*room, view, 1024, {Layer::BEAUTY}, false, ReferenceOptions::FULL).mean(Layer::BEAUTY);
    const Mask mask = Mask::geometry(truth);
    for (const int bounce : {Settings::BOUNCE_MEAN, Settings::BOUNCE_PROBES}) {
        room->getSettings()->bounce = bounce;
        const double lamp = compare(view.render(room, 4), truth, mask).tRmse;
        room->getSettings()->emissiveMeshes = false;
        const double none = compare(view.render(room, 4), truth, mask).tRmse;
        room->getSettings()->emissiveMeshes = true;
        EXPECT_LT(lamp, 0.04) << bounce;
        EXPECT_LT(lamp, 0.6 * none) << bounce;
    }
}

}  // namespace MeshLightTruth_test

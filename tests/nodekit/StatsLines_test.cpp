// SPDX-License-Identifier: MIT
// What a viewer's stats show of the node.
#include <SceneRenderer.h>

#include <osgViewer/ViewerEventHandlers>

#include <gtest/gtest.h>

namespace StatsLines_test
{

using osgEnvLight::LitScene;
using osgEnvLight::Settings;

namespace
{

class Handler : public osgViewer::StatsHandler
{
  public:
    std::vector<std::string> labels() const
    {
        std::vector<std::string> result;
        for (const UserStatsLine& line : _userStatsLines) result.push_back(line.label);
        return result;
    }
    bool has(const std::string& label) const
    {
        const std::vector<std::string> all = labels();
        return std::count(all.begin(), all.end(), label) == 1;
    }
};

osg::ref_ptr<LitScene> litSphere()
{
    osg::ref_ptr<LitScene> lit = makeLit(constantMap(1.0).get());
    lit->getSettings()->regeneration = Settings::IMMEDIATE;
    lit->addChild(makeSphere(osg::Vec3d(), 1.0, 16));
    lit->addChild(makeBox(osg::Vec3d(-2, -2, -1.2), osg::Vec3d(2, 2, -1)));
    return lit;
}

}  // namespace

TEST(StatsLines, ComeWhenTheViewerShowsItsTimesAndGoWithTheNode)
{
    SceneRenderer renderer(64, 64);
    osg::ref_ptr<Handler> handler = new Handler;
    osgViewer::Viewer& viewer = renderer.viewer();
    viewer.addEventHandler(handler);
    osg::ref_ptr<LitScene> lit = litSphere();
    lit->getSettings()->atlasLights = 16;
    lit->getSettings()->atlasSize = 64;
    lit->getSettings()->accumulate = true;
    renderer.lookAt(osg::Vec3d(0, -6, 2), osg::Vec3d());
    renderer.render(lit, 4);
    EXPECT_TRUE(handler->labels().empty());  // nobody has asked
    EXPECT_FALSE(lit->isTimed());
    for (const auto& r : lit->plan().passes) EXPECT_LT(std::max(r.cpu, r.gpu), 0.0) << r.pass;

    viewer.getViewerStats()->collectStats("event", true);  // as the handler does at the second s
    renderer.render(lit, 24);
    const double before = lit->average().standardError;
    renderer.render(lit);  // whose events come before its draw
    EXPECT_TRUE(lit->isTimed());
    for (const char* label : {"env gbuffer", "env diffuse", "env composite", "env still view, error %"})
        EXPECT_TRUE(handler->has(label)) << label;
    EXPECT_FALSE(handler->has("env specular"));  // nothing glossy is in view
    double seconds = -1.0, error = -1.0;
    const unsigned frame = viewer.getFrameStamp()->getFrameNumber();
    EXPECT_TRUE(viewer.getViewerStats()->getAttribute(frame, "osgEnvLight composite time taken", seconds));
    EXPECT_GT(seconds, 0.0);
    EXPECT_LT(seconds, 10.0);
    EXPECT_TRUE(viewer.getViewerStats()->getAttribute(frame, "osgEnvLight standard error", error));
    EXPECT_EQ(error, before);

    viewer.getViewerStats()->collectStats("event", false);
    renderer.render(lit, 2);
    EXPECT_FALSE(lit->isTimed());

    osg::ref_ptr<osg::Group> nothing = new osg::Group;
    renderer.render(nothing, 2);
    lit = nullptr;
    EXPECT_TRUE(handler->labels().empty());
}

// A handler that the application takes away before us is no longer asked.
TEST(StatsLines, OutliveTheirHandler)
{
    SceneRenderer renderer(32, 32);
    osg::ref_ptr<LitScene> lit = litSphere();
    lit->getSettings()->visibility = Settings::VISIBILITY_SCREEN;
    osgViewer::Viewer& viewer = renderer.viewer();
    for (int i = 0; i < 2; ++i) {
        osg::ref_ptr<Handler> handler = new Handler;
        viewer.addEventHandler(handler);
        viewer.getViewerStats()->collectStats("event", true);
        renderer.render(lit, 4);
        EXPECT_TRUE(handler->has("env composite"));
        viewer.removeEventHandler(handler);
    }
    renderer.render(lit, 2);
    EXPECT_FALSE(lit->isTimed());
}

}  // namespace StatsLines_test

// SPDX-License-Identifier: MIT
// background = auto: the map is behind the scene unless the application has drawn something there.
#include <SceneRenderer.h>

#include <osg/ClearNode>
#include <osg/Depth>
#include <osg/Fog>
#include <osg/MatrixTransform>

#include <gtest/gtest.h>

namespace Background_test
{

using osgEnvLight::LitScene;
using osgEnvLight::Settings;

namespace
{

// A sphere about the eye, yellow and unlit, as engines draw a sky.
osg::ref_ptr<osg::Geode> makeDome(const osg::Vec3d& center, double radius)
{
    const osg::ref_ptr<osg::Geode> dome = makeSphere(center, radius, 32);
    dome->getDrawable(0)->setName("dome");
    osg::ref_ptr<osg::Vec4Array> yellow = new osg::Vec4Array;
    yellow->push_back(osg::Vec4(1, 1, 0, 1));
    dome->getDrawable(0)->asGeometry()->setColorArray(yellow.get(), osg::Array::BIND_OVERALL);
    osg::StateSet& s = *dome->getOrCreateStateSet();
    s.setMode(GL_LIGHTING, osg::StateAttribute::OFF);
    s.setMode(GL_CULL_FACE, osg::StateAttribute::OFF);
    return dome;
}

void drawFirst(osg::StateSet& s)
{
    s.setRenderBinDetails(-1, "RenderBin");
    s.setAttributeAndModes(new osg::Depth(osg::Depth::ALWAYS, 0, 1, false));
}

bool isYellow(const osg::Vec3d& c)
{
    return c[0] > 0.9 && c[1] > 0.9 && c[2] < 0.1;
}

bool isMap(const osg::Vec3d& c)
{
    return c[0] < 0.1 && c[1] < 0.1 && c[2] > 0.4;
}

std::string compositeReason(const LitScene& lit)
{
    for (const osgEnvLight::PassReport& r : lit.plan().passes)
        if (r.pass == "composite") return r.reason;
    return std::string();
}

}  // namespace

class Background : public testing::Test
{
  protected:
    Background() : lit(makeLit(makeMap(32, 16, [](const osg::Vec3d&) { return osg::Vec3d(0, 0, 0.5); }).get()))
    {
        renderer.lookAt(eye, osg::Vec3d());
        lit->addChild(makeSphere(osg::Vec3d(), 0.3));
    }

    osg::Vec3d corner(osg::Node* scene) { return renderer.render(scene, 3).color(3, 44); }

    const osg::Vec3d eye = osg::Vec3d(0, -4, 0);
    SceneRenderer renderer{48, 48};
    osg::ref_ptr<LitScene> lit;
};

TEST_F(Background, IsTheMapWhereNothingIsBehindTheScene)
{
    EXPECT_EQ(Settings::BACKGROUND_AUTO, lit->getSettings()->background);
    EXPECT_TRUE(isMap(corner(lit)));
    EXPECT_NE(std::string::npos, compositeReason(*lit).find("the map behind")) << compositeReason(*lit);
}

TEST_F(Background, IsTheDomeBelowTheNode)
{
    for (const bool negativeBin : {true, false}) {
        const osg::ref_ptr<osg::Geode> dome = makeDome(eye, 50.0);
        if (negativeBin)
            drawFirst(*dome->getOrCreateStateSet());
        else
            dome->getOrCreateStateSet()->setAttributeAndModes(new osg::Depth(osg::Depth::LEQUAL, 0, 1, false));
        lit->addChild(dome);
        EXPECT_TRUE(isYellow(corner(lit))) << negativeBin;
        EXPECT_NE(std::string::npos, compositeReason(*lit).find("'dome' below")) << compositeReason(*lit);
        // What was asked for by name stays.
        lit->getSettings()->background = Settings::BACKGROUND_ON;
        EXPECT_EQ(negativeBin, isMap(corner(lit)));
        lit->getSettings()->background = Settings::BACKGROUND_AUTO;
        lit->removeChild(dome);
        EXPECT_TRUE(isMap(corner(lit)));
    }
}

TEST_F(Background, IsTheDomeBesideTheNode)
{
    const osg::ref_ptr<osg::Group> root = new osg::Group;
    const osg::ref_ptr<osg::Geode> dome = makeDome(eye, 50.0);
    drawFirst(*dome->getOrCreateStateSet());
    root->addChild(dome);
    root->addChild(lit);
    EXPECT_TRUE(isYellow(corner(root)));
    EXPECT_NE(std::string::npos, compositeReason(*lit).find("'dome' drawn before")) << compositeReason(*lit);
    // One that the eye is not in is no backdrop.
    root->replaceChild(dome, makeDome(osg::Vec3d(0, 9, 0), 0.5));
    drawFirst(*root->getChild(0)->getOrCreateStateSet());
    EXPECT_TRUE(isMap(corner(root)));
}

// As all do whose scene ends in fog.
TEST_F(Background, IsTheFogToWhichTheHostClears)
{
    const osg::ref_ptr<osg::Fog> fog = new osg::Fog;
    fog->setColor(osg::Vec4(1, 1, 0, 1));
    lit->getOrCreateStateSet()->setAttributeAndModes(fog);
    EXPECT_TRUE(isMap(corner(lit)));
    renderer.viewer().getCamera()->setClearColor(osg::Vec4(1, 1, 0, 1));
    EXPECT_TRUE(isYellow(corner(lit)));
    EXPECT_NE(std::string::npos, compositeReason(*lit).find("fog's colour")) << compositeReason(*lit);
    lit->getSettings()->background = Settings::BACKGROUND_ON;
    EXPECT_TRUE(isMap(corner(lit)));
}

// The idiom of OSG's own examples: the sky, at the far plane, clears colour and depth.
TEST_F(Background, IsTheSkyOfAClearNode)
{
    for (const bool below : {true, false}) {
        const osg::ref_ptr<osg::ClearNode> sky = new osg::ClearNode;
        sky->setRequiresClear(false);
        const osg::ref_ptr<osg::Geode> dome = makeDome(eye, 50.0);
        dome->getOrCreateStateSet()->setRenderBinDetails(-2, "RenderBin");
        dome->getOrCreateStateSet()->setAttributeAndModes(new osg::Depth(osg::Depth::ALWAYS, 1, 1));
        sky->addChild(dome);
        const osg::ref_ptr<osg::Group> root = new osg::Group;
        if (below)
            lit->insertChild(0, sky);
        else
            root->addChild(sky);
        root->addChild(lit);
        EXPECT_TRUE(isYellow(corner(root))) << below;
        lit->removeChild(sky);
    }
}

TEST_F(Background, IsAFullScreenPictureInANegativeBin)
{
    const osg::ref_ptr<osg::Camera> camera = new osg::Camera;
    camera->setReferenceFrame(osg::Transform::ABSOLUTE_RF);
    camera->setRenderOrder(osg::Camera::NESTED_RENDER);
    camera->setClearMask(0);
    camera->setProjectionMatrixAsOrtho2D(0, 1, 0, 1);
    const osg::ref_ptr<osg::Geode> picture = makeQuad(osg::Vec3d(), osg::Vec3d(1, 0, 0), osg::Vec3d(0, 1, 0));
    osg::ref_ptr<osg::Vec4Array> yellow = new osg::Vec4Array;
    yellow->push_back(osg::Vec4(1, 1, 0, 1));
    picture->getDrawable(0)->asGeometry()->setColorArray(yellow.get(), osg::Array::BIND_OVERALL);
    picture->getOrCreateStateSet()->setMode(GL_LIGHTING, osg::StateAttribute::OFF);
    drawFirst(*picture->getOrCreateStateSet());
    camera->addChild(picture);
    const osg::ref_ptr<osg::Group> root = new osg::Group;
    root->addChild(camera);
    root->addChild(lit);
    EXPECT_TRUE(isYellow(corner(root)));
    // Half of the screen leaves the rest to the map.
    camera->setProjectionMatrixAsOrtho2D(0, 2, 0, 1);
    EXPECT_NE(std::string::npos, (corner(root), compositeReason(*lit)).find("the map behind")) << compositeReason(*lit);
}

}  // namespace Background_test

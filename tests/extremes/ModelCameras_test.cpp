// SPDX-License-Identifier: MIT
// The cameras that a model has: where they are, and how a scene is seen from them.
#include <Process.h>

#include <osgEnvLight/ModelCameras>
#include <osgEnvLight/SceneDescription>

#include <osg/CameraView>
#include <osg/MatrixTransform>
#include <osg/ShapeDrawable>
#include <osg/Switch>
#include <osgDB/WriteFile>

#include <gtest/gtest.h>

#include <limits>
#include <sstream>

using osgEnvLight::HomeView;
using osgEnvLight::LitScene;

namespace
{

/** Looks along -Z of its parent from there. */
osg::ref_ptr<osg::CameraView> camera(const std::string& name, const osg::Vec3d& position, double angle = 40.0)
{
    osg::ref_ptr<osg::CameraView> view = new osg::CameraView;
    view->setName(name);
    view->setPosition(position);
    view->setFieldOfView(angle);
    view->setFieldOfViewMode(osg::CameraView::VERTICAL);
    return view;
}

/** A ball of radius 1 at the origin, which two cameras see: "top" from 5 above, and "side" from 8 before it. */
osg::ref_ptr<osg::Group> model()
{
    osg::ref_ptr<osg::Group> root = new osg::Group;
    root->addChild(new osg::ShapeDrawable(new osg::Sphere));
    root->addChild(camera("top", osg::Vec3d(0, 0, 5)));
    osg::ref_ptr<osg::MatrixTransform> turned = new osg::MatrixTransform(osg::Matrix::rotate(osg::PI_2, osg::X_AXIS));
    turned->preMult(osg::Matrix::scale(2, 2, 2));
    turned->addChild(camera("side", osg::Vec3d(0, 0, 4), 25.0));
    root->addChild(turned);
    return root;
}

void expectPoint(const osg::Vec3d& a, const osg::Vec3d& b)
{
    // Bounds are floats.
    EXPECT_NEAR((a - b).length(), 0.0, 1e-5) << a.x() << " " << a.y() << " " << a.z();
}

class ModelCameras : public testing::Test
{
  protected:
    ModelCameras() { osgDB::writeNodeFile(*model(), folder.file("model.osgt")); }

    /** The home view of a scene, read as osgDB reads it. */
    std::optional<HomeView> homeOf(const std::string& file)
    {
        auto result = osgDB::Registry::instance()->readNode(folder.file(file), nullptr);
        const auto* lit = dynamic_cast<const LitScene*>(result.getNode());
        EXPECT_TRUE(lit) << result.message();
        return lit ? lit->getHomeView() : std::nullopt;
    }

    const TemporaryFolder folder;
};

}  // namespace

TEST_F(ModelCameras, StandWhereTheirTransformsPutThem)
{
    const auto cameras = osgEnvLight::findModelCameras(*model());
    ASSERT_EQ(2u, cameras.size());
    EXPECT_EQ("top", cameras[0].name);
    expectPoint(cameras[0].view.eye, osg::Vec3d(0, 0, 5));
    expectPoint(cameras[0].view.target, osg::Vec3d(0, 0, 0));
    expectPoint(cameras[0].view.up, osg::Vec3d(0, 1, 0));
    EXPECT_DOUBLE_EQ(40.0, cameras[0].view.fovy);
    EXPECT_EQ("side", cameras[1].name);
    expectPoint(cameras[1].view.eye, osg::Vec3d(0, -8, 0));
    expectPoint(cameras[1].view.target, osg::Vec3d(0, 0, 0));
    expectPoint(cameras[1].view.up, osg::Vec3d(0, 0, 1));
    EXPECT_DOUBLE_EQ(25.0, cameras[1].view.fovy);
}

TEST_F(ModelCameras, AreFoundInWhatIsSwitchedOff)
{
    osg::ref_ptr<osg::Switch> off = new osg::Switch;
    off->addChild(model(), false);
    off->setNodeMask(0);
    EXPECT_EQ(2u, osgEnvLight::findModelCameras(*off).size());
}

TEST_F(ModelCameras, WithoutANameHaveANumber)
{
    osg::ref_ptr<osg::Group> root = model();
    root->addChild(camera("", osg::Vec3d(0, 0, 9)));
    EXPECT_EQ("camera 3", osgEnvLight::findModelCameras(*root).back().name);
}

TEST_F(ModelCameras, LookIntoTheDistanceWhereNothingLies)
{
    osg::ref_ptr<osg::Group> root = model();
    root->addChild(camera("away", osg::Vec3d(0, 0, -5)));
    expectPoint(osgEnvLight::modelCamera(*root, "away").target, osg::Vec3d(0, 0, -5 - double(root->getBound().radius())));
    osg::ref_ptr<osg::Group> empty = new osg::Group;
    empty->addChild(camera("alone", osg::Vec3d(0, 0, 2)));
    expectPoint(osgEnvLight::modelCamera(*empty, "alone").target, osg::Vec3d(0, 0, 1));
}

TEST_F(ModelCameras, HaveAHorizontalAngleOfAPictureOfFourToThree)
{
    osg::ref_ptr<osg::CameraView> wide = camera("wide", osg::Vec3d(), 90.0);
    wide->setFieldOfViewMode(osg::CameraView::HORIZONTAL);
    EXPECT_NEAR(osg::RadiansToDegrees(2.0 * std::atan(0.75)), osgEnvLight::modelCamera(*wide, "wide").fovy, 1e-9);
}

TEST_F(ModelCameras, WithoutADirectionAreLeftOut)
{
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (const osg::Matrixd& m : {osg::Matrixd::scale(0, 0, 0), osg::Matrixd::scale(1, 0, 1), osg::Matrixd::translate(nan, 0, 0),
                                  osg::Matrixd::scale(1, 1, nan)}) {
        osg::ref_ptr<osg::MatrixTransform> flat = new osg::MatrixTransform(m);
        flat->addChild(camera("flat", osg::Vec3d(0, 0, 1)));
        EXPECT_TRUE(osgEnvLight::findModelCameras(*flat).empty());
    }
    EXPECT_DOUBLE_EQ(HomeView().fovy, osgEnvLight::modelCamera(*camera("bad", osg::Vec3d(), nan), "bad").fovy);
    EXPECT_DOUBLE_EQ(179.0, osgEnvLight::modelCamera(*camera("bad", osg::Vec3d(), 400.0), "bad").fovy);
}

TEST_F(ModelCameras, TheFirstIsTheHomeOfALitModel)
{
    const auto home = homeOf("model.osgt.envlight");
    ASSERT_TRUE(home);
    expectPoint(home->eye, osg::Vec3d(0, 0, 5));
    osgDB::writeNodeFile(*new osg::ShapeDrawable(new osg::Sphere), folder.file("ball.osgt"));
    EXPECT_FALSE(homeOf("ball.osgt.envlight"));
}

TEST_F(ModelCameras, ASceneDescriptionNamesOne)
{
    folder.write("first.envlight", R"({"model": "model.osgt"})");
    folder.write("side.envlight", R"({"model": "model.osgt", "camera": "side"})");
    folder.write("own.envlight", R"({"model": "model.osgt", "camera": {"eye": [3, 0, 0], "target": [0, 0, 0]}})");
    EXPECT_EQ(5.0, homeOf("first.envlight").value_or(HomeView()).eye.z());
    expectPoint(homeOf("side.envlight").value_or(HomeView()).eye, osg::Vec3d(0, -8, 0));
    EXPECT_EQ(3.0, homeOf("own.envlight").value_or(HomeView()).eye.x());

    const std::string wrong = folder.write("wrong.envlight", R"({"model": "model.osgt", "camera": "bottom"})");
    auto result = osgDB::Registry::instance()->readNode(wrong, nullptr);
    EXPECT_EQ(wrong + ": key 'camera': 'bottom', expected a camera of the model, which has 'top', 'side'", result.message());
    const std::string unnamed = folder.write("unnamed.envlight", R"({"model": "model.osgt", "camera": ""})");
    result = osgDB::Registry::instance()->readNode(unnamed, nullptr);
    EXPECT_EQ(unnamed + ": key 'camera': expected an object with eye and target, or the name of a camera, found \"\"",
              result.message());
}

TEST_F(ModelCameras, ArePicturedByName)
{
    const auto render = [&](const std::string& output, std::vector<std::string> arguments) {
        arguments.insert(arguments.begin(),
                         {std::string(ENVLIGHT_BINARY_DIR) + "/bin/envlight-render", folder.file("model.osgt")});
        arguments.insert(arguments.end(), {"--size", "24x24", "-o", folder.file(output)});
        return runProgram(arguments);
    };
    ASSERT_EQ(0, render("side.png", {"--camera", "side"}).status);
    ASSERT_EQ(0, render("same.png", {"--eye", "0,-8,0", "--target", "0,0,0", "--fovy", "25"}).status);
    ASSERT_EQ(0, render("first.png", {}).status);
    EXPECT_EQ(readFile(folder.file("same.png")), readFile(folder.file("side.png")));
    EXPECT_NE(readFile(folder.file("first.png")), readFile(folder.file("side.png")));

    const Outcome wrong = render("wrong.png", {"--camera", "bottom"});
    EXPECT_EQ(1, wrong.status);
    EXPECT_NE(std::string::npos,
              wrong.err.find("--camera is 'bottom', expected a camera of the model, which has 'top', 'side', or a JSON file"))
        << wrong.err;
}

// SPDX-License-Identifier: MIT
// Rays from pixels to surfaces close by (bounceNear), against closed forms.
#include "ClosedRoom.h"
#include "ProbeScenes.h"

#include <BenchModel.h>

#include <osg/MatrixTransform>

namespace NearLight_test
{

using namespace probescenes;

namespace
{

const double boardHalf = 0.4, gap = 0.06;
const float floorAlbedo = 0.2f;

// Form factor of a rectangle with a corner straight above a small horizontal surface: sides x and y in units of its height.
double cornerFactor(double x, double y)
{
    const double a = std::sqrt(1.0 + x * x), b = std::sqrt(1.0 + y * y);
    return (x / a * std::atan(y / a) + y / b * std::atan(x / b)) / (2.0 * M_PI);
}

// That of the board for the middle of its front edge, moved by `under` below it.
double boardFactor(double under)
{
    const double x = boardHalf / gap, back = (2.0 * boardHalf - under) / gap, front = under / gap;
    return 2.0 * (cornerFactor(x, back) + (front < 0.0 ? -1.0 : 1.0) * cornerFactor(x, std::abs(front)));
}

// Walls that glow and reflect nothing; a floor; and close above it a black board.
osg::ref_ptr<LitScene> makeBoardInRoom(int bounceNear)
{
    const osg::ref_ptr<LitScene> lit = makeProbed(0.01);
    lit->getSettings()->bounceNear = bounceNear;
    addClosedRoom(*lit, 1.0, 1.2);
    const unsigned floor = 4;  // low along z
    for (unsigned i = 0; i < lit->getNumChildren(); ++i) {
        osg::StateSet& s = *lit->getChild(i)->getOrCreateStateSet();
        setAlbedo(*lit->getChild(i), i == floor ? floorAlbedo : 0.0f);
        if (i != floor) Material::setEmission(s, osg::Vec3f(1, 1, 1));
        Material::setLight(s, Material::LIGHT_OFF);
    }
    const osg::ref_ptr<osg::Geode> board =
        makeBox(osg::Vec3d(-boardHalf, -boardHalf, -1.0 + gap), osg::Vec3d(boardHalf, boardHalf, -0.98 + gap));
    setAlbedo(*board, 0.0f);
    lit->addChild(board);
    return lit;
}

// The light on the floor at the middle of the board's front edge, moved by `under` below it, over that without the board.
double lightUnder(SceneRenderer& renderer, const Picture& picture, double under)
{
    const osg::Camera& camera = *renderer.viewer().getCamera();
    const osg::Vec3d place = osg::Vec3d(0, -boardHalf + under, -1) * camera.getViewMatrix() * camera.getProjectionMatrix();
    const int row = int((0.5 * place.y() + 0.5) * picture.height);
    double sum = 0.0;
    for (int x = picture.width / 2 - 4; x < picture.width / 2 + 4; ++x) sum += double(picture.color(x, row)[1]);
    return sum / 8.0 / double(floorAlbedo);
}

// Glowing hemispheres, smaller than what lies between probes, that light the ceiling of a black room. Their points light each
// other.
osg::ref_ptr<LitScene> makeBowlsInRoom(float albedo)
{
    const osg::ref_ptr<LitScene> lit = makeProbed(0.01);
    addClosedRoom(*lit, 1.0, 1.2);
    const unsigned ceiling = 5;
    for (unsigned i = 0; i < lit->getNumChildren(); ++i) setAlbedo(*lit->getChild(i), i == ceiling ? floorAlbedo : 0.0f);
    for (const double x : {-0.7, -0.23, 0.23, 0.7})
        for (const double y : {-0.6, -0.2, 0.2, 0.6}) {
            const osg::ref_ptr<osg::MatrixTransform> bowl =
                new osg::MatrixTransform(osg::Matrix::scale(0.12, 0.12, 0.12) * osg::Matrix::translate(x, y, 0));
            bowl->addChild(makeBowl(8));
            setAlbedo(*bowl, albedo);
            Material::setEmission(*bowl->getOrCreateStateSet(), osg::Vec3f(1, 1, 1));
            Material::setLight(*bowl->getOrCreateStateSet(), Material::LIGHT_OFF);
            lit->addChild(bowl);
        }
    return lit;
}

}  // namespace

// The light in a sphere that glows evenly is even. A share f of the sphere makes it 1 / (1 - f albedo) times as strong as the
// glow. Measured: 3 % too little, with six points in each bowl; without links from point to point 24 %.
TEST(NearLight, WhatLiesBetweenProbesLightsItself)
{
    SceneRenderer renderer(32, 32);
    renderer.lookAt(osg::Vec3d(0, -0.9, 0), osg::Vec3d(0, 0, 1), osg::Vec3d(0, 0, 1), 10.0);
    const auto light = [&](float albedo) { return figuresOf(renderer.render(makeBowlsInRoom(albedo))).mean; };
    const double glow = light(0.0f);
    for (const float albedo : {0.4f, 0.8f}) EXPECT_NEAR(1.0, (1.0 - 0.5 * double(albedo)) * light(albedo) / glow, 0.05) << albedo;
}

TEST(NearLight, AGapBelowABoardIsDark)
{
    SceneRenderer renderer(96, 96);
    renderer.lookAt(osg::Vec3d(0, -0.95, -0.85), osg::Vec3d(0, -boardHalf, -1), osg::Vec3d(0, 0, 1), 50.0);
    renderer.viewer().getCamera()->setProjectionMatrixAsPerspective(50.0, 1.0, 0.05, 100.0);
    for (const int near : {int(Settings::NEAR_OFF), int(Settings::NEAR_AUTO)}) {
        const osg::ref_ptr<LitScene> lit = makeBoardInRoom(near);
        const Picture picture = renderer.render(lit);
        EXPECT_EQ(near != Settings::NEAR_OFF, lit->plan().runs("nearlight")) << lit->plan().reason("nearlight");
        if (near == Settings::NEAR_OFF) {
            EXPECT_GT(lightUnder(renderer, picture, 0.0), 0.9) << "probes know gaps as narrow as this one";
            continue;
        }
        // One of 16 directions more or fewer is .06. Measured: .05 before the edge, .14 below the board.
        for (const double under : {-0.3, -0.2, -0.12, -0.06, -0.03, 0.0, 0.03, 0.06, 0.1})
            EXPECT_NEAR(1.0 - boardFactor(under), lightUnder(renderer, picture, under), under <= 0.0 ? 0.06 : 0.15) << under;
        // Finer grids of probes follow a view of a small part.
        renderer.viewer().getCamera()->setProjectionMatrixAsPerspective(2.0, 1.0, 0.05, 100.0);
        const Picture close = renderer.render(lit, 16);
        EXPECT_NE(std::string::npos, lit->plan().reason("links").find("grids about the view")) << lit->plan().reason("links");
        EXPECT_NEAR(1.0 - boardFactor(0.0), lightUnder(renderer, close, 0.0), 0.06);
    }
}

// Where the probes see much of the map, the rays are not worth their time.
TEST(NearLight, RunsInRoomsUnlessAskedFor)
{
    SceneRenderer renderer(16, 16);
    lookAtBenchModel(renderer);
    const osg::ref_ptr<LitScene> lit = makeProbed();
    lit->addChild(makeBenchModel(4096));  // balls that all but touch, on a floor
    renderer.render(lit);
    EXPECT_FALSE(lit->plan().runs("nearlight"));
    EXPECT_EQ("surfaces hide too little of the map", lit->plan().reason("nearlight"));
    lit->getSettings()->bounceNear = Settings::NEAR_ON;
    renderer.render(lit);
    EXPECT_TRUE(lit->plan().runs("nearlight")) << lit->plan().reason("nearlight");
    EXPECT_TRUE(lit->plan().runs("nearlightfilter"));
    lit->getSettings()->bounceNear = Settings::NEAR_OFF;
    renderer.render(lit);
    EXPECT_EQ("switched off", lit->plan().reason("nearlight"));
}

}  // namespace NearLight_test

// SPDX-License-Identifier: MIT
// What the suns' shadow maps say is seen of a sun, against closed forms.
#include "ClosedRoom.h"
#include "SunScenes.h"

#include <osg/MatrixTransform>

#include <gtest/gtest.h>

namespace SunShadows_test
{

using osgEnvLight::LitScene;
using osgEnvLight::Settings;

using namespace sunscenes;

// The visible share of a disc that a straight edge crosses: 10 to 90 % of it lie within 1.373 radii (circular segments).
TEST(SunShadows, PenumbraOfAWallIsAsWideAsTheSunsDisc)
{
    SceneRenderer renderer(256, 256);
    for (double height : {0.25, 1.0, 3.0})
        for (double zoom : {8.0, 3.0}) {
            osg::ref_ptr<LitScene> lit = sunny(osg::Vec3d(1, 0, 1));
            lit->addChild(makeBox(osg::Vec3d(-6, -4, -0.5), osg::Vec3d(6, 4, 0)));
            lit->addChild(makeBox(osg::Vec3d(0, -4, 0), osg::Vec3d(0.3, 4, height)));
            const osgEnvLight::DominantLight sun = sunOf(*lit);
            // Across the floor, whose distance to the edge is height / cos 45 degrees.
            const double elevation = std::asin(sun.direction.z());
            const double edge = height / std::tan(elevation);
            const auto at = [&](double angle) { return height / std::tan(elevation + angle); };
            const double u = 0.6870;  // of the segment that holds a tenth: acos(u) - u sqrt(1 - u^2) = pi / 10
            const double width = at(-u * sun.radius) - at(u * sun.radius);
            lookDown(renderer, osg::Vec3d(-edge, 0, 0), zoom * width);
            const Picture p = renderer.render(lit);
            const double measured = std::abs(crossing(p, 0.9) - crossing(p, 0.1)) * zoom * width / 256.0;
            const double middle = (crossing(p, 0.5) / 256.0 - 0.5) * zoom * width;
            EXPECT_NEAR(measured / width, 1.0, 0.1) << "height " << height << ", zoom " << zoom;
            EXPECT_NEAR(middle / width, 0.0, 0.1) << "height " << height << ", zoom " << zoom;
        }
}

// A flat floor whose normals were smoothed over its edges, as of models that bring none: its shadows stay where they are.
TEST(SunShadows, NormalsThatLeanMoveNoEdge)
{
    SceneRenderer renderer(256, 256);
    const osg::ref_ptr<LitScene> lit = sunny(osg::Vec3d(1, 0, 1));
    const osg::ref_ptr<osg::Geode> floor = makeQuad(osg::Vec3d(-6, -4, 0), osg::Vec3d(12, 0, 0), osg::Vec3d(0, 8, 0));
    const auto normals = osg::ref_ptr(new osg::Vec3Array(osg::Array::BIND_PER_VERTEX));
    for (const osg::Vec3& corner : static_cast<osg::Vec3Array&>(*floor->getDrawable(0)->asGeometry()->getVertexArray())) {
        osg::Vec3 normal = corner * (0.1f / corner.length()) + osg::Vec3(0, 0, 1);
        normal.normalize();
        normals->push_back(normal);
    }
    floor->getDrawable(0)->asGeometry()->setNormalArray(normals);
    lit->addChild(floor);
    lit->addChild(makeBox(osg::Vec3d(0, -4, 0), osg::Vec3d(0.3, 4, 1.0)));
    const double edge = 1.0 / std::tan(std::asin(sunOf(*lit).direction.z()));
    lookDown(renderer, osg::Vec3d(-edge, 0, 0), 1.0);
    const double middle = crossing(renderer.render(lit), 0.5) / 256.0 - 0.5;
    EXPECT_NEAR(middle, 0.0, 0.02);  // a tenth of the penumbra's width; .36 from where a round floor would be
}

// A plane of any thickness that nothing shades, from facing the sun to 85 degrees off.
TEST(SunShadows, PlanesDontShadeThemselves)
{
    SceneRenderer renderer(96, 96);
    for (double scale : {1e-3, 1.0, 1e6})
        for (double thickness : {0.0, 1e-3, 0.2})
            for (double tilt : {0.0, 20.0, 45.0, 70.0, 85.0}) {
                osg::ref_ptr<LitScene> lit =
                    sunny(osg::Vec3d(std::sin(tilt * degree) * 0.8, std::sin(tilt * degree) * 0.6, std::cos(tilt * degree)), 0.7);
                if (thickness > 0.0)
                    lit->addChild(makeBox(osg::Vec3d(-1, -1, -thickness) * scale, osg::Vec3d(1, 1, 0) * scale));
                else
                    lit->addChild(
                        makeQuad(osg::Vec3d(-1, -1, 0) * scale, osg::Vec3d(2, 0, 0) * scale, osg::Vec3d(0, 2, 0) * scale));
                renderer.lookAt(osg::Vec3d(0.3, -1.0, 1.2) * scale, osg::Vec3d(), osg::Vec3d(0, 0, 1));
                const Statistics s = ofGeometry(renderer.render(lit));
                EXPECT_EQ(s.least, 1.0) << "scale " << scale << ", thickness " << thickness << ", tilt " << tilt << ", mean "
                                        << s.mean;
            }
}

// Of a facetted sphere too, up to where its facets' own horizon differs from that of its smooth normals: half a facet.
TEST(SunShadows, CurvedBodiesDontShadeTheirLitSide)
{
    SceneRenderer renderer(128, 128);
    for (int segments : {16, 64}) {
        osg::ref_ptr<LitScene> lit = sunny(osg::Vec3d(1, 0, 0.5), 0.7);
        lit->addChild(makeSphere(osg::Vec3d(), 1.0, segments));
        renderer.lookAt(osg::Vec3d(3, -3, 2), osg::Vec3d());
        lit->getSettings()->view = Settings::DIFFUSE;
        const Picture open = renderer.render(lit);
        lit->getSettings()->view = Settings::OCCLUSION;
        const Picture taken = renderer.render(lit);
        double level = 0.0, most = 0.0;
        for (int y = 0; y < 128; ++y)
            for (int x = 0; x < 128; ++x) level = std::max(level, double(open.color(x, y)[0]));
        for (int y = 0; y < 128; ++y)
            for (int x = 0; x < 128; ++x)
                if (open.color(x, y)[0] > level * std::sin(osg::PI / segments))
                    most = std::max(most, double(taken.color(x, y)[0]));
        EXPECT_LT(most, 0.002 * level) << segments;  // half floats
    }
}

// Where the sun grazes it, a ball beside those pixels does not face the sun: they have not asked whether it is hidden.
TEST(SunShadows, AWallsShadowHasNoBrightLineWhereTheSunGrazes)
{
    SceneRenderer renderer(192, 192);
    const osg::ref_ptr<LitScene> lit = sunny(osg::Vec3d(1, 0, 0.5), 0.7);
    lit->addChild(makeSphere(osg::Vec3d(), 1.0));
    lit->addChild(makeBox(osg::Vec3d(2.5, -4, -4), osg::Vec3d(3, 4, 6)));
    lit->getSettings()->bounce = Settings::BOUNCE_OFF;
    lit->getSettings()->view = Settings::BEAUTY;
    for (double side : {-1.0, 1.0}) {
        renderer.lookAt(osg::Vec3d(0, -6, 2 * side), osg::Vec3d());
        const Picture p = renderer.render(lit);
        double most = 0.0;
        for (int y = 60; y < 132; ++y)
            for (int x = 60; x < 132; ++x) most = std::max(most, double(p.color(x, y)[0]));
        EXPECT_EQ(0.0, most) << side;
    }
}

// The shadow of a box begins at its foot, of which this sees a stretch of 14 texels.
TEST(SunShadows, ShadowsBeginWhereBodiesStand)
{
    SceneRenderer renderer(256, 256);
    for (double scale : {1e-3, 1.0, 1e6})
        for (int size : {256, 1024}) {
            osg::ref_ptr<LitScene> lit = sunny(osg::Vec3d(1, 0, 1), 0.7);
            lit->getSettings()->sunShadowSize = size;
            lit->addChild(makeBox(osg::Vec3d(-2, -2, -0.5) * scale, osg::Vec3d(2, 2, 0) * scale));
            lit->addChild(makeBox(osg::Vec3d(0, -1, 0) * scale, osg::Vec3d(0.5, 1, 1) * scale));
            lookDown(renderer, osg::Vec3d(), 0.2 * scale, 5.0 * scale);
            const Picture p = renderer.render(lit);
            double left = 0.0, right = 0.0;
            for (int x = 0; x < 256; ++x) (x < 128 ? left : right) += p.color(x, 128)[0] / 128.0;
            EXPECT_EQ(0.0, left) << "scale " << scale << ", size " << size;   // the floor behind the box
            EXPECT_EQ(1.0, right) << "scale " << scale << ", size " << size;  // its top
        }
}

// Without thickness, its back to the sun, on a floor that ends at it. Widths of the light at its foot, in texels of the map.
TEST(SunShadows, AtTheFootOfASheetThereIsLittleLight)
{
    SceneRenderer renderer(256, 64);
    double widest = 0.0;
    for (const osg::Vec3d& direction :
         {osg::Vec3d(-1, 0, 1), osg::Vec3d(-1, 0.3, 1), osg::Vec3d(-1, 1, 0.5), osg::Vec3d(-0.4, 0.2, 1)}) {
        const osg::ref_ptr<LitScene> lit = sunny(direction, 0.3);
        lit->addChild(makeQuad(osg::Vec3d(0, -4, 0), osg::Vec3d(8, 0, 0), osg::Vec3d(0, 8, 0)));
        lit->addChild(makeQuad(osg::Vec3d(0, -4, 0), osg::Vec3d(0, 8, 0), osg::Vec3d(0, 0, 6)));
        const double texel = 2.0 * lit->getBound().radius() / 1024.0, width = 8.0 * texel;
        lookDown(renderer, osg::Vec3d(0.5 * width, 0, 0), width);
        const Picture p = renderer.render(lit);
        double light = 0.0;
        for (int x = 0; x < p.width; ++x)
            for (int y = 0; y < p.height; ++y) light += p.color(x, y)[0] / p.height;
        widest = std::max(widest, light * width / texel / p.width);
    }
    EXPECT_LT(widest, 0.15);  // .13; where the first texel counted, and sheets were let down, .30
}

TEST(SunShadows, AClosedRoomIsBlackInside)
{
    SceneRenderer renderer(96, 96);
    for (double wall : {0.2, 0.02}) {
        osg::ref_ptr<LitScene> lit = sunny(osg::Vec3d(0.3, 0.4, 1), 2.0);
        lit->getSettings()->view = Settings::BEAUTY;
        lit->getSettings()->background = Settings::BACKGROUND_OFF;
        addClosedRoom(*lit, 1.0, 1.0 + wall);
        for (double turn : {0.0, 120.0, 240.0}) {
            const osg::Quat q(turn * degree, osg::Vec3d(0, 0, 1));
            renderer.lookAt(q * osg::Vec3d(0.7, -0.8, 0.6), q * osg::Vec3d(-0.3, 0.4, -0.2), osg::Vec3d(0, 0, 1), 90.0);
            const Statistics s = ofGeometry(renderer.render(lit));
            EXPECT_EQ(0.0, s.most) << "wall " << wall << ", turn " << turn << ", mean " << s.mean;
        }
    }
}

namespace
{

double meanRadiance(const Picture& p)
{
    return ofGeometry(p).mean;
}

}  // namespace

// What was cut from the map comes back through the suns.
TEST(SunShadows, AnOpenFloorIsAsBrightWithTheSunCutAsWithout)
{
    SceneRenderer renderer(64, 64);
    osg::Vec3d towards(0.5, 0.3, 0.8);
    osg::ref_ptr<LitScene> lit = makeLit(sunMap(towards, 1.5, 1.0).get());
    lit->addChild(makeQuad(osg::Vec3d(-1, -1, 0), osg::Vec3d(2, 0, 0), osg::Vec3d(0, 2, 0)));
    lit->getSettings()->diffuseCarrier = Settings::LIGHTS;
    lit->getSettings()->diffuseLights = 1024;
    lit->getSettings()->background = Settings::BACKGROUND_OFF;
    renderer.lookAt(osg::Vec3d(0, -1, 2), osg::Vec3d(), osg::Vec3d(0, 0, 1), 30.0);
    lit->getSettings()->suns = Settings::SUNS_OFF;
    const double whole = meanRadiance(renderer.render(lit));
    lit->getSettings()->suns = Settings::SUNS_AUTO;
    const double split = meanRadiance(renderer.render(lit));
    EXPECT_TRUE(lit->plan().runs("sunshadow")) << lit->plan().explain();
    EXPECT_NEAR(split / whole, 1.0, 0.005);
}

// 21 stops above the sky, of a texel: 25 times as bright a floor. Nothing stands out by 50 times the median of what is around it.
TEST(SunShadows, ABrightSunMakesNoFireflies)
{
    SceneRenderer renderer(128, 128);
    osg::ref_ptr<LitScene> lit = makeLit(sunMap(osg::Vec3d(0.5, 0.3, 0.6), 0.25, 1.0, std::exp2(21.0)).get());
    lit->addChild(makeBox(osg::Vec3d(-3, -3, -0.2), osg::Vec3d(3, 3, 0)));
    lit->addChild(makeSphere(osg::Vec3d(0, 0, 0.6), 0.6));
    lit->addChild(makeBox(osg::Vec3d(0.8, -1, 0), osg::Vec3d(1.0, 1, 1.5)));
    lit->getSettings()->suns = Settings::SUNS_AUTO;
    renderer.lookAt(osg::Vec3d(-2, -5, 3), osg::Vec3d(0, 0, 0.4));
    const Picture p = renderer.render(lit);
    ASSERT_EQ(1u, lit->plan().suns);
    for (int y = 2; y < 126; ++y)
        for (int x = 2; x < 126; ++x) {
            std::vector<double> around;
            for (int j = -2; j <= 2; ++j)
                for (int i = -2; i <= 2; ++i) around.push_back(p.color(x + i, y + j)[1]);
            std::sort(around.begin(), around.end());
            EXPECT_LE(p.color(x, y)[1], 50.0 * around[12]) << x << ", " << y;
        }
}

TEST(SunShadows, MapsAreDrawnWhenSomethingMoves)
{
    SceneRenderer renderer(64, 64);
    osg::ref_ptr<LitScene> lit = sunny(osg::Vec3d(0.3, 0.2, 1));
    lit->addChild(makeBox(osg::Vec3d(-3, -3, -0.2), osg::Vec3d(3, 3, 0)));
    osg::ref_ptr<osg::MatrixTransform> mover = new osg::MatrixTransform;
    mover->addChild(makeBox(osg::Vec3d(-0.5, -0.5, 0.5), osg::Vec3d(0.5, 0.5, 1)));
    lit->addChild(mover);
    renderer.lookAt(osg::Vec3d(0, -6, 6), osg::Vec3d());
    const Picture first = renderer.render(lit);
    EXPECT_EQ(1u, lit->drawnSunMaps());
    EXPECT_EQ(0.0, largestDifference(first, renderer.render(lit)));
    EXPECT_EQ(0u, lit->drawnSunMaps());
    renderer.lookAt(osg::Vec3d(1, -6, 5), osg::Vec3d());
    renderer.render(lit);
    EXPECT_EQ(0u, lit->drawnSunMaps());
    // A caster that moves is seen in the same frame.
    renderer.lookAt(osg::Vec3d(0, -6, 6), osg::Vec3d());
    mover->setMatrix(osg::Matrixd::translate(0.5, 0, 0));
    const Picture moved = renderer.render(lit);
    EXPECT_EQ(1u, lit->drawnSunMaps());
    EXPECT_GT(rootMeanSquare(first, moved), 0.02);
    mover->setMatrix(osg::Matrixd());
    EXPECT_EQ(0.0, largestDifference(first, renderer.render(lit)));
    // A view that shows nothing of the scene for a while finds its maps again.
    const osg::ref_ptr<osg::Geode> far = makeBox(osg::Vec3d(60, -1, -1), osg::Vec3d(62, 1, 1));
    lit->addChild(far);
    renderer.render(lit);
    renderer.lookAt(osg::Vec3d(30, -20, 0), osg::Vec3d(30, 0, 0));
    const size_t bytes = lit->textureBytes();
    renderer.render(lit);
    EXPECT_EQ(0u, lit->plan().surfaces.deferred);
    EXPECT_GE(lit->textureBytes(), bytes - 1000000);  // but for the picture's own targets
    renderer.lookAt(osg::Vec3d(0, -6, 6), osg::Vec3d());
    renderer.render(lit);
    EXPECT_EQ(0u, lit->drawnSunMaps());
    lit->removeChild(far);
    // So is a sun.
    renderer.render(lit);
    renderer.render(lit);
    EXPECT_EQ(0u, lit->drawnSunMaps());
    lit->getEnvironmentMap()->setRotation(30.0);
    renderer.render(lit);
    EXPECT_EQ(1u, lit->drawnSunMaps());
}

TEST(SunShadows, OnlyWhereTheyAreAskedFor)
{
    SceneRenderer renderer(64, 64);
    osg::ref_ptr<LitScene> lit = makeLit(sunMap(osg::Vec3d(0.3, 0.2, 1), 1.5, 1.0).get());
    lit->getSettings()->suns = Settings::SUNS_AUTO;
    lit->getSettings()->regeneration = Settings::IMMEDIATE;
    lit->addChild(makeBox(osg::Vec3d(-3, -3, -0.2), osg::Vec3d(3, 3, 0)));
    lit->addChild(makeBox(osg::Vec3d(-0.5, -0.5, 0.5), osg::Vec3d(0.5, 0.5, 1)));
    renderer.lookAt(osg::Vec3d(0, -6, 6), osg::Vec3d());
    for (Settings::Visibility v :
         {Settings::VISIBILITY_AUTO, Settings::VISIBILITY_SCREEN, Settings::VISIBILITY_ATLAS, Settings::VISIBILITY_BOTH}) {
        lit->getSettings()->visibility = v;
        renderer.render(lit);
        EXPECT_TRUE(lit->plan().runs("sunshadow")) << v;
    }
    lit->getSettings()->visibility = Settings::VISIBILITY_NONE;
    renderer.render(lit);
    EXPECT_FALSE(lit->plan().runs("sunshadow"));
    EXPECT_NE(lit->plan().explain().find("sunmap: off, visibility is none"), std::string::npos) << lit->plan().explain();
    // Without a sun, or with it among the lists' lights, there is neither pass nor texture.
    lit->getSettings()->visibility = Settings::VISIBILITY_AUTO;
    lit->getSettings()->suns = Settings::SUNS_OFF;
    renderer.render(lit);
    const size_t without = lit->textureBytes();
    EXPECT_NE(lit->plan().explain().find("sunmap: off, switched off"), std::string::npos) << lit->plan().explain();
    lit->getSettings()->suns = Settings::SUNS_AUTO;
    renderer.render(lit);
    EXPECT_GT(lit->textureBytes(), without + 8 * 1024 * 1024);
    lit->getEnvironmentMap()->setImage(constantMap(1.0).get());
    renderer.render(lit);
    EXPECT_NE(lit->plan().explain().find("sunmap: off, the map has none"), std::string::npos) << lit->plan().explain();
}

}  // namespace SunShadows_test

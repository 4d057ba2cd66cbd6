// SPDX-License-Identifier: MIT
// Light that goes on between surfaces by points and probes (bounce=probes), against closed forms. How near it comes to full light
// transport is the image suite's to say.
#include <SceneRenderer.h>

#include <osgEnvLight/Material>

#include <osg/LightSource>
#include <osg/MatrixTransform>

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <thread>

#include "ClosedRoom.h"

namespace Probes_test
{

using osgEnvLight::LitScene;
using osgEnvLight::Material;
using osgEnvLight::Settings;

namespace
{

osg::ref_ptr<LitScene> makeProbed(double radiance = 1.0)
{
    osg::ref_ptr<LitScene> lit = makeLit(constantMap(radiance).get());
    Settings& s = *lit->getSettings();
    s.regeneration = Settings::IMMEDIATE;
    s.background = Settings::BACKGROUND_OFF;
    s.bounce = Settings::BOUNCE_PROBES;
    return lit;
}

void setAlbedo(osg::Node& node, float albedo)
{
    Material::setLambert(*node.getOrCreateStateSet(), osg::Vec3f(albedo, albedo, albedo));
}

struct Figures {
    double mean = 0.0;
    double deviation = 0.0;
};

Figures figuresOf(const Picture& p, int channel = 1)
{
    double sum = 0.0, squares = 0.0;
    int count = 0;
    for (int y = 0; y < p.height; ++y)
        for (int x = 0; x < p.width; ++x) {
            if (!(p.alpha(x, y) > 0.5f)) continue;
            const double v = double(p.color(x, y)[channel]);
            sum += v;
            squares += v * v;
            ++count;
        }
    EXPECT_GT(count, p.width * p.height / 8);
    const double mean = sum / std::max(count, 1);
    return {mean, std::sqrt(std::max(squares / std::max(count, 1) - mean * mean, 0.0))};
}

// The inside of a sphere, open above down to the polar angle.
osg::ref_ptr<osg::Geode> makeBowl(int rings, double opening = M_PI_2)
{
    osg::ref_ptr<osg::Vec3Array> vertices = new osg::Vec3Array, normals = new osg::Vec3Array;
    osg::ref_ptr<osg::DrawElementsUInt> indices = new osg::DrawElementsUInt(GL_TRIANGLES);
    const int sides = 4 * rings;
    for (int i = 0; i <= rings; ++i)
        for (int j = 0; j <= sides; ++j) {
            const double polar = opening + (M_PI - opening) * i / rings, azimuth = 2.0 * M_PI * j / sides;
            const osg::Vec3 p(float(std::sin(polar) * std::cos(azimuth)), float(std::sin(polar) * std::sin(azimuth)),
                              float(std::cos(polar)));
            vertices->push_back(p);
            normals->push_back(-p);
        }
    for (int i = 0; i < rings; ++i)
        for (int j = 0; j < sides; ++j) {
            const auto a = unsigned(i * (sides + 1) + j), b = a + unsigned(sides) + 1;
            for (unsigned v : {a, a + 1, b, b, a + 1, b + 1}) indices->push_back(v);
        }
    osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
    geometry->setVertexArray(vertices);
    geometry->setNormalArray(normals, osg::Array::BIND_PER_VERTEX);
    geometry->addPrimitiveSet(indices);
    osg::ref_ptr<osg::Geode> geode = new osg::Geode;
    geode->addDrawable(geometry);
    return geode;
}

// Two cubes of half-side 2 with walls between them and about them; the left one has no ceiling, and the door is optional.
osg::ref_ptr<LitScene> makeTwoRooms(bool door)
{
    osg::ref_ptr<LitScene> lit = makeProbed();
    const auto add = [&](double x0, double y0, double z0, double x1, double y1, double z1) {
        lit->addChild(makeBox(osg::Vec3d(x0, y0, z0), osg::Vec3d(x1, y1, z1)));
    };
    add(-4.2, -2.2, -2.2, 4.2, 2.2, -2);  // floor
    add(-4.2, -2.2, -2, 4.2, -2, 2.2);    // walls
    add(-4.2, 2, -2, 4.2, 2.2, 2.2);
    add(-4.2, -2, -2, -4, 2, 2.2);
    add(4, -2, -2, 4.2, 2, 2.2);
    add(0, -2.2, 2, 4.2, 2.2, 2.2);  // the right ceiling
    if (door) {
        add(-0.1, -2, -2, 0.1, -0.6, 2);
        add(-0.1, 0.6, -2, 0.1, 2, 2);
        add(-0.1, -0.6, 0.4, 0.1, 0.6, 2);
    } else {
        add(-0.1, -2, -2, 0.1, 2, 2);
    }
    setAlbedo(*lit, 0.6f);
    return lit;
}

}  // namespace

// Each surface shows e / (1 - rho): the sum of what it emits and of all that comes back.
TEST(Probes, AClosedRoomIsTheGeometricSeries)
{
    SceneRenderer renderer(64, 64);
    renderer.lookAt(osg::Vec3d(-0.5, -0.6, 0.4), osg::Vec3d(0.9, 0.8, -0.3), osg::Vec3d(0, 0, 1), 70.0);
    renderer.viewer().getCamera()->setProjectionMatrixAsPerspective(70.0, 1.0, 0.05, 100.0);
    for (const float albedo : {0.0f, 0.5f, 0.9f}) {
        osg::ref_ptr<LitScene> lit = makeProbed();
        addClosedRoom(*lit, 1.0, 1.2);
        setAlbedo(*lit, albedo);
        Material::setEmission(*lit->getOrCreateStateSet(), osg::Vec3f(1, 1, 1));
        const Figures all = figuresOf(renderer.render(lit));
        lit->getSettings()->bounce = Settings::BOUNCE_OFF;
        const double emitted = figuresOf(renderer.render(lit)).mean;
        ASSERT_GT(emitted, 0.0);
        // The albedo has 8 bits. A fifth of a percent of each bounce is lost to probes in the walls' corners.
        EXPECT_NEAR(1.0, all.mean / emitted * (1.0 - double(albedo)), albedo < 0.8f ? 0.01 : 0.025) << albedo;
        EXPECT_LT(all.deviation, 0.01 * all.mean) << albedo;
    }
}

// A bowl that is half of a sphere shows the same everywhere under an even sky: rho / 2 / (1 - rho / 2).
TEST(Probes, ABowlIsItsClosedForm)
{
    SceneRenderer renderer(96, 96);
    renderer.lookAt(osg::Vec3d(0, -1, 6), osg::Vec3d(0, 0, -0.4), osg::Vec3d(0, 1, 0), 18.0);
    for (const float albedo : {0.5f, 0.8f, 0.95f}) {
        osg::ref_ptr<LitScene> lit = makeProbed();
        lit->addChild(makeBowl(24));
        setAlbedo(*lit, albedo);
        const Figures f = figuresOf(renderer.render(lit));
        const double expected = 0.5 * double(albedo) / (1.0 - 0.5 * double(albedo));
        EXPECT_NEAR(1.0, f.mean / expected, 0.02) << albedo;  // indirect2.md 2: .4 %; the rim and its own facets
        EXPECT_LT(f.deviation / f.mean, 0.05) << albedo;
    }
}

// A lamp of the application in the middle of a hollow ball, under a black map: rho L / (1 - rho) everywhere. It may be dimmed,
// and be put out.
TEST(Probes, AHollowBallAboutALampIsItsClosedForm)
{
    SceneRenderer renderer(64, 64);
    renderer.lookAt(osg::Vec3d(0.2, -0.5, 0.1), osg::Vec3d(0.1, 1, -0.3), osg::Vec3d(0, 0, 1), 70.0);
    renderer.viewer().getCamera()->setProjectionMatrixAsPerspective(70.0, 1.0, 0.05, 100.0);
    for (const float albedo : {0.3f, 0.5f}) {
        osg::ref_ptr<LitScene> lit = makeProbed(0.0);
        lit->addChild(makeBowl(24, 0.0));
        setAlbedo(*lit, albedo);
        const osg::ref_ptr<osg::LightSource> lamp = new osg::LightSource;
        lamp->getLight()->setLightNum(1);
        lamp->getLight()->setPosition(osg::Vec4(0, 0, 0, 1));
        lit->addChild(lamp);
        lit->getOrCreateStateSet()->setMode(GL_LIGHT1, osg::StateAttribute::ON);
        for (const float attenuation : {1.0f, 4.0f}) {
            lamp->getLight()->setDiffuse(osg::Vec4(1, 1, 1, 1));
            lamp->getLight()->setConstantAttenuation(attenuation);
            const Figures f = figuresOf(renderer.render(lit));
            EXPECT_TRUE(lit->plan().runs("points"));
            const double expected = double(albedo) / double(attenuation) / (1.0 - double(albedo));
            EXPECT_NEAR(1.0, f.mean / expected, 0.02) << albedo << " " << attenuation;  // as of a bowl
            EXPECT_LT(f.deviation / f.mean, 0.025) << albedo;                           // measured: .022
        }
        lamp->getLight()->setDiffuse(osg::Vec4(0, 0, 0, 1));
        EXPECT_EQ(0.0, figuresOf(renderer.render(lit)).mean);
    }
}

// A wall stands at the end of a floor of polished metal, under an even sky. The floor mirrors the sky before the wall onto it:
// half of the light that the floor receives, and all of that meets the wall. A matt floor would send the wall half as much.
TEST(Probes, APolishedFloorShowsTheSkyToAWall)
{
    SceneRenderer renderer(64, 64);
    renderer.lookAt(osg::Vec3d(0, -6, 1.5), osg::Vec3d(0, 0, 1.5), osg::Vec3d(0, 0, 1), 14.0);
    const osg::ref_ptr<LitScene> lit = makeProbed();
    lit->getSettings()->view = Settings::BOUNCED;
    lit->addChild(makeQuad(osg::Vec3d(-8, -8, 0), osg::Vec3d(16, 0, 0), osg::Vec3d(0, 8, 0)));
    lit->addChild(makeBox(osg::Vec3d(-8, 0, -0.1), osg::Vec3d(8, 0.2, 6)));
    Material::setCookTorrance(*lit->getChild(0)->getOrCreateStateSet(), osg::Vec3f(0.5f, 0.5f, 0.5f), 1.0f, 0.1f);
    setAlbedo(*lit->getChild(1), 0.5f);
    const Figures f = figuresOf(renderer.render(lit));
    double seen = 0.0;
    const int count = 200;
    for (int i = 0; i < count; ++i)
        for (int j = 0; j < count; ++j) {
            const osg::Vec3d to(16.0 * (i + 0.5) / count - 8.0, -8.0 * (j + 0.5) / count, -1.5);
            const double square = to.length2(), cosine = 1.5 / std::sqrt(square);
            const double fresnel = 0.5 + 0.5 * std::pow(1.0 - cosine, 5.0);
            seen += fresnel * -to.y() / std::sqrt(square) * cosine / (M_PI * square) * (16.0 * 8.0 / (count * count));
        }
    EXPECT_NEAR(1.0, f.mean / (0.5 * seen), 0.08);  // measured: .946; the wall has an end
}

// A dark room beside a lit one.
TEST(Probes, LittleLightComesThroughWalls)
{
    SceneRenderer renderer(64, 64);
    renderer.viewer().getCamera()->setProjectionMatrixAsPerspective(80.0, 1.0, 0.05, 100.0);
    const auto look = [&](double x) {
        renderer.viewer().getCamera()->setViewMatrixAsLookAt(osg::Vec3d(x, -1.8, 0.5), osg::Vec3d(x - 0.3, 1, -0.3),
                                                             osg::Vec3d(0, 0, 1));
    };
    for (const bool door : {false, true}) {
        osg::ref_ptr<LitScene> lit = makeTwoRooms(door);
        lit->getSettings()->view = Settings::BOUNCED;
        look(-2.0);
        const double bright = figuresOf(renderer.render(lit)).mean;
        look(2.0);
        const double dark = figuresOf(renderer.render(lit)).mean;
        EXPECT_GT(bright, 0.05);
        if (door)
            EXPECT_GT(dark, 0.005 * bright) << "some comes through the door";
        else
            EXPECT_LT(dark, 0.0005 * bright);  // measured: 6e-5
        EXPECT_LT(dark, 0.2 * bright);
    }
}

TEST(Probes, BlackSurfacesSendNothingToTheBit)
{
    SceneRenderer renderer(64, 64);
    renderer.lookAt(osg::Vec3d(0, -9, 4), osg::Vec3d(0, -0.5, 0.8));
    osg::ref_ptr<LitScene> lit = makeProbed();
    lit->addChild(makeQuad(osg::Vec3d(-2, -4, 0), osg::Vec3d(4, 0, 0), osg::Vec3d(0, 4, 0)));
    lit->addChild(makeBox(osg::Vec3d(-2, 0, -0.1), osg::Vec3d(2, 0.2, 4)));
    setAlbedo(*lit->getChild(0), 0.0f);
    setAlbedo(*lit->getChild(1), 0.0f);
    const Picture with = renderer.render(lit);
    lit->getSettings()->bounce = Settings::BOUNCE_OFF;
    EXPECT_EQ(0.0, largestDifference(with, renderer.render(lit)));
}

// Other counts of lights are another atlas, whose casters are counted from the beginning.
TEST(Probes, FollowAnAtlasThatIsReplaced)
{
    SceneRenderer renderer(64, 64);
    renderer.lookAt(osg::Vec3d(0, -9, 4), osg::Vec3d(0, -0.5, 0.8));
    osg::ref_ptr<LitScene> lit = makeProbed();
    lit->addChild(makeQuad(osg::Vec3d(-3, -4, 0), osg::Vec3d(6, 0, 0), osg::Vec3d(0, 4, 0)));
    setAlbedo(*lit, 0.8f);
    renderer.render(lit);
    lit->getSettings()->atlasLights = 128;
    lit->addChild(makeBox(osg::Vec3d(-1, -1, 0.01), osg::Vec3d(1, 0.2, 2)));
    const Picture replaced = renderer.render(lit);
    osg::ref_ptr<LitScene> fresh = makeProbed();
    fresh->getSettings()->atlasLights = 128;
    for (unsigned i = 0; i < 2; ++i) fresh->addChild(lit->getChild(i));
    setAlbedo(*fresh, 0.8f);
    EXPECT_LT(largestDifference(renderer.render(fresh), replaced), 0.005);
}

// A wall colours the floor, and another colour of it does at once.
TEST(Probes, FollowAColourThatChanges)
{
    SceneRenderer renderer(64, 64);
    renderer.lookAt(osg::Vec3d(0, -9, 4), osg::Vec3d(0, -0.5, 0.3));
    osg::ref_ptr<LitScene> lit = makeProbed();
    lit->getSettings()->view = Settings::BOUNCED;
    lit->addChild(makeQuad(osg::Vec3d(-2, -4, 0), osg::Vec3d(4, 0, 0), osg::Vec3d(0, 4, 0)));
    lit->addChild(makeBox(osg::Vec3d(-2, 0, -0.1), osg::Vec3d(2, 0.2, 4)));
    setAlbedo(*lit->getChild(0), 0.8f);
    osg::StateSet& wall = *lit->getChild(1)->getOrCreateStateSet();
    Material::setLambert(wall, osg::Vec3f(0.8f, 0, 0));
    const Picture red = renderer.render(lit);
    Material::setLambert(wall, osg::Vec3f(0, 0.8f, 0));
    const Picture green = renderer.render(lit);
    const double sent = figuresOf(red, 0).mean;
    EXPECT_GT(sent, 0.01);
    // The wall receives the floor's light, which is white; measured: .23.
    EXPECT_LT(figuresOf(red, 1).mean, 0.25 * sent);
    EXPECT_NEAR(sent, figuresOf(green, 1).mean, 0.1 * sent);
    EXPECT_LT(figuresOf(green, 0).mean, 0.25 * sent);
}

// A floor is polished, and made matt again.
TEST(Probes, FollowAPolishThatChanges)
{
    SceneRenderer renderer(64, 64);
    renderer.lookAt(osg::Vec3d(0, -9, 4), osg::Vec3d(0, -0.5, 0.8));
    const osg::ref_ptr<LitScene> lit = makeProbed();
    lit->getSettings()->regeneration = Settings::BACKGROUND;
    lit->getSettings()->view = Settings::BOUNCED;
    lit->addChild(makeQuad(osg::Vec3d(-3, -4, 0), osg::Vec3d(6, 0, 0), osg::Vec3d(0, 4, 0)));
    lit->addChild(makeBox(osg::Vec3d(-2, 0, -0.1), osg::Vec3d(2, 0.2, 3)));
    setAlbedo(*lit->getChild(1), 0.8f);
    osg::StateSet& floor = *lit->getChild(0)->getOrCreateStateSet();
    const auto settled = [&] {
        for (int i = 0; i < 500 && (renderer.render(lit, 4), lit->regenerating()); ++i)
            std::this_thread::sleep_for(std::chrono::milliseconds(2));
        return renderer.render(lit);
    };
    setAlbedo(*lit->getChild(0), 0.8f);
    const Picture matt = settled();
    const size_t mattBytes = lit->textureBytes();
    Material::setPhong(floor, osg::Vec3f(), osg::Vec3f(0.8f, 0.8f, 0.8f), 1000);
    const Picture polished = settled();
    const size_t polishedBytes = lit->textureBytes();
    EXPECT_GT(polishedBytes, mattBytes);
    EXPECT_GT(largestDifference(matt, polished), 0.02);
    const osg::ref_ptr<LitScene> fresh = makeProbed();
    fresh->getSettings()->view = Settings::BOUNCED;
    for (unsigned i = 0; i < 2; ++i) fresh->addChild(lit->getChild(i));
    EXPECT_LT(largestDifference(renderer.render(fresh), polished), 0.005);
    setAlbedo(*lit->getChild(0), 0.8f);
    EXPECT_LT(largestDifference(matt, settled()), 0.005);
    EXPECT_LT(lit->textureBytes(), polishedBytes);
}

// The map is turned, a body moved: after some frames the picture is that of a scene that never was another.
TEST(Probes, ForgetWhatWas)
{
    SceneRenderer renderer(64, 64);
    renderer.lookAt(osg::Vec3d(0, -9, 4), osg::Vec3d(0, -0.5, 0.8));
    const auto make = [](double x) {
        osg::ref_ptr<LitScene> lit = makeProbed();
        lit->addChild(makeQuad(osg::Vec3d(-3, -4, 0), osg::Vec3d(6, 0, 0), osg::Vec3d(0, 4, 0)));
        const osg::ref_ptr<osg::MatrixTransform> moved = new osg::MatrixTransform(osg::Matrix::translate(x, 0, 0));
        moved->addChild(makeBox(osg::Vec3d(-1, -1, 0.01), osg::Vec3d(1, 0.2, 2)));
        lit->addChild(moved);
        setAlbedo(*lit, 0.8f);
        return lit;
    };
    const Picture expected = renderer.render(make(1.0));
    osg::ref_ptr<LitScene> lit = make(-1.0);
    renderer.render(lit);
    static_cast<osg::MatrixTransform*>(lit->getChild(1))->setMatrix(osg::Matrix::translate(1, 0, 0));
    const Picture after = renderer.render(lit, 40);
    EXPECT_LT(largestDifference(expected, after), 0.02);
}

// Without waiting for them the picture begins with the mean, and ends with what it would have been at once.
TEST(Probes, ComeWhenTheyAreMade)
{
    SceneRenderer renderer(64, 64);
    renderer.lookAt(osg::Vec3d(0, -9, 4), osg::Vec3d(0, -0.5, 0.8));
    const auto make = [](int regeneration) {
        osg::ref_ptr<LitScene> lit = makeProbed();
        lit->getSettings()->regeneration = regeneration;
        lit->addChild(makeQuad(osg::Vec3d(-3, -4, 0), osg::Vec3d(6, 0, 0), osg::Vec3d(0, 4, 0)));
        lit->addChild(makeBox(osg::Vec3d(-1, -1, 0.01), osg::Vec3d(1, 0.2, 2)));
        setAlbedo(*lit, 0.8f);
        return lit;
    };
    const Picture expected = renderer.render(make(Settings::IMMEDIATE));
    osg::ref_ptr<LitScene> lit = make(Settings::BACKGROUND);
    renderer.render(lit);
    for (int i = 0; i < 500 && lit->regenerating(); ++i) {
        renderer.render(lit);
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    EXPECT_FALSE(lit->regenerating());
    EXPECT_LT(largestDifference(expected, renderer.render(lit)), 0.005);
    const Picture still = renderer.render(lit);
    EXPECT_EQ(0.0, largestDifference(still, renderer.render(lit))) << "then nothing changes";
}

TEST(Probes, ThePlanSaysWhyNot)
{
    SceneRenderer renderer(32, 32);
    renderer.lookAt(osg::Vec3d(0, -9, 4), osg::Vec3d(0, -0.5, 0.8));
    osg::ref_ptr<LitScene> lit = makeProbed();
    lit->addChild(makeBox(osg::Vec3d(-1, -1, 0), osg::Vec3d(1, 0.2, 2)));
    renderer.render(lit);
    EXPECT_TRUE(lit->plan().runs("indirect"));
    EXPECT_EQ("probes know it", lit->plan().reason("bounce"));
    EXPECT_NE(std::string::npos, lit->plan().reason("links").find("4096 points, 12 x ")) << lit->plan().reason("links");
    lit->getSettings()->bounceProbes = 4;
    renderer.render(lit);
    EXPECT_NE(std::string::npos, lit->plan().reason("links").find("points, 4 x ")) << lit->plan().reason("links");
    const size_t with = lit->textureBytes();
    lit->getSettings()->bounce = Settings::BOUNCE_MEAN;
    renderer.render(lit);
    EXPECT_FALSE(lit->plan().runs("indirect"));
    EXPECT_EQ("bounce is mean", lit->plan().reason("links"));
    EXPECT_LT(lit->textureBytes(), with);
    lit->getSettings()->bounce = Settings::BOUNCE_PROBES;
    lit->getSettings()->visibility = Settings::VISIBILITY_SCREEN;
    renderer.render(lit);
    EXPECT_EQ("without the atlas nobody knows how much of the map a surface sees", lit->plan().reason("links"));
}

}  // namespace Probes_test

// SPDX-License-Identifier: MIT
// What hides light from transparent surfaces, which are drawn after the composite.
#include "AtlasScenes.h"
#include "ClosedRoom.h"
#include "SunScenes.h"

#include <osg/Material>

namespace Transparent_test
{

using namespace atlasscenes;

namespace
{

osg::ref_ptr<osg::Geode> white(const osg::ref_ptr<osg::Geode>& geode, float opacity)
{
    osg::ref_ptr<osg::Material> material = new osg::Material;
    material->setDiffuse(osg::Material::FRONT_AND_BACK, osg::Vec4(1, 1, 1, opacity));
    geode->getOrCreateStateSet()->setAttributeAndModes(material);
    return geode;
}

osg::ref_ptr<osg::Geode> opaque(const osg::ref_ptr<osg::Geode>& geode)
{
    return white(geode, 1.0f);
}

// All but opaque: what is behind it adds no more than .002.
osg::ref_ptr<osg::Geode> transparent(const osg::ref_ptr<osg::Geode>& geode)
{
    osg::StateSet& s = *white(geode, 0.998f)->getStateSet();
    s.setMode(GL_BLEND, osg::StateAttribute::ON);
    s.setRenderingHint(osg::StateSet::TRANSPARENT_BIN);
    return geode;
}

osg::ref_ptr<LitScene> beauty(const osg::ref_ptr<osg::Image>& map)
{
    osg::ref_ptr<LitScene> lit = makeLit(map.get());
    lit->getSettings()->visibility = Settings::VISIBILITY_ATLAS;
    lit->getSettings()->regeneration = Settings::IMMEDIATE;
    lit->getSettings()->bounce = Settings::BOUNCE_OFF;
    lit->getSettings()->reflections = Settings::REFLECTIONS_MAP;
    return lit;
}

// A floor with a post on it, transparent or not.
Picture floorUnder(const osg::ref_ptr<LitScene>& lit, SceneRenderer& renderer, bool isTransparent)
{
    lit->removeChildren(0, lit->getNumChildren());
    const osg::ref_ptr<osg::Geode> floor = makeQuad(osg::Vec3d(-3, -3, 0), osg::Vec3d(6, 0, 0), osg::Vec3d(0, 6, 0));
    lit->addChild(isTransparent ? transparent(floor) : opaque(floor));
    lit->addChild(opaque(makeBox(osg::Vec3d(-0.4, -0.4, 0.01), osg::Vec3d(0.4, 0.4, 2))));
    renderer.lookAt(osg::Vec3d(1, -6, 6), osg::Vec3d());
    return renderer.render(lit);
}

}  // namespace

TEST(Transparent, BlackInAClosedRoom)
{
    SceneRenderer renderer(64, 64);
    const osg::ref_ptr<LitScene> lit = beauty(constantMap(1.0));
    addClosedRoom(*lit, 1.0, 1.2);
    lit->addChild(transparent(makeQuad(osg::Vec3d(-0.5, 0, -0.5), osg::Vec3d(1, 0, 0), osg::Vec3d(0, 0, 1))));
    renderer.lookAt(osg::Vec3d(0, -0.95, 0.1), osg::Vec3d());
    const Picture p = renderer.render(lit);
    EXPECT_EQ(1u, lit->plan().surfaces.litForward);
    EXPECT_LT(ofGeometry(p).most, 1e-3);
}

// The same maps, averaged over 2x2 pixels in place of the filter (measured: .017, .005 in a picture four times as wide).
TEST(Transparent, ShadedByTheSkyAsAnOpaqueOne)
{
    SceneRenderer renderer(96, 64);
    const osg::ref_ptr<LitScene> lit = beauty(constantMap(1.0));
    const Picture expected = floorUnder(lit, renderer, false), p = floorUnder(lit, renderer, true);
    EXPECT_GT(ofGeometry(expected).most - ofGeometry(expected).least, 0.3);  // there is a shadow
    EXPECT_LT(rootMeanSquare(p, expected), 0.02);
    EXPECT_NEAR(ofGeometry(p).mean, ofGeometry(expected).mean, 0.005);
}

TEST(Transparent, InTheSunsShadowAsAnOpaqueOne)
{
    SceneRenderer renderer(96, 64);
    const osg::ref_ptr<LitScene> lit = beauty(sunscenes::sunMap(osg::Vec3d(0.6, 0.3, 1), 1.5));
    lit->getSettings()->suns = Settings::SUNS_AUTO;
    const Picture expected = floorUnder(lit, renderer, false), p = floorUnder(lit, renderer, true);
    EXPECT_LT(rootMeanSquare(p, expected), 0.015 * ofGeometry(expected).mean);  // measured .010
    EXPECT_NEAR(ofGeometry(p).mean / ofGeometry(expected).mean, 1.0, 0.005);
}

TEST(Transparent, AloneInViewTheyStillAskTheMaps)
{
    SceneRenderer renderer(64, 64);
    const osg::ref_ptr<LitScene> lit = beauty(sunscenes::sunMap(osg::Vec3d(0.01, 0, 1), 1.5, 1.0));
    lit->getSettings()->suns = Settings::SUNS_AUTO;
    lit->addChild(transparent(makeQuad(osg::Vec3d(-0.3, -0.3, 0), osg::Vec3d(0.6, 0, 0), osg::Vec3d(0, 0.6, 0))));
    renderer.lookAt(osg::Vec3d(0, -1, 1), osg::Vec3d(), osg::Vec3d(0, 0, 1), 30.0);
    const double open = ofGeometry(renderer.render(lit)).mean;
    lit->addChild(makeBox(osg::Vec3d(-4, -4, 3), osg::Vec3d(4, 4, 3.2)));
    const double shaded = ofGeometry(renderer.render(lit, 2)).mean;
    const osgEnvLight::Plan plan = lit->plan();
    EXPECT_EQ(0u, plan.surfaces.deferred);
    EXPECT_TRUE(plan.runs("atlas") && plan.runs("sunmap")) << plan.explain();
    EXPECT_FALSE(plan.runs("occlusion") || plan.runs("diffuse") || plan.runs("sunshadow")) << plan.explain();
    EXPECT_LT(shaded, 0.3 * open);
    EXPECT_GT(shaded, 0.0);
}

// Between a red and a green wall: each half of the floor has the colour of the wall beside it. The mean of the picture knows no
// place.
TEST(Transparent, LitByTheWallsBesideThemAsOpaqueOnes)
{
    SceneRenderer renderer(96, 64);
    Picture pictures[2];
    for (const bool isTransparent : {false, true}) {
        const osg::ref_ptr<LitScene> lit = beauty(constantMap(1.0));
        lit->getSettings()->bounce = Settings::BOUNCE_PROBES;
        const osg::ref_ptr<osg::Geode> floor = makeQuad(osg::Vec3d(-1.8, -1.5, 0.2), osg::Vec3d(3.6, 0, 0), osg::Vec3d(0, 3, 0));
        lit->addChild(isTransparent ? transparent(floor) : opaque(floor));
        for (const bool right : {false, true}) {
            const osg::ref_ptr<osg::Geode> wall =
                makeBox(osg::Vec3d(right ? 2 : -2.2, -3, 0), osg::Vec3d(right ? 2.2 : -2, 3, 3));
            osgEnvLight::Material::setLambert(*wall->getOrCreateStateSet(),
                                              right ? osg::Vec3f(0, 0.9f, 0) : osg::Vec3f(0.9f, 0, 0));
            lit->addChild(wall);
        }
        renderer.lookAt(osg::Vec3d(0, 0, 9), osg::Vec3d(), osg::Vec3d(0, 1, 0), 24.0);
        pictures[isTransparent] = renderer.render(lit);
    }
    for (const double x : {-1.6, -1.0, 1.0, 1.6}) {
        const osg::Vec2d at = renderer.pixelOf(osg::Vec3d(x, 0, 0.2));
        const auto tint = [&](const Picture& p) {
            const osg::Vec3d c = p.color(int(at.x()), int(at.y()));
            return (c[0] - c[1]) / (c[0] + c[1]);
        };
        EXPECT_GT(tint(pictures[0]) * (x < 0 ? 1 : -1), 0.02) << x;
        EXPECT_NEAR(tint(pictures[0]), tint(pictures[1]), 0.01) << x;  // measured .003; of .1 to .17
    }
}

}  // namespace Transparent_test

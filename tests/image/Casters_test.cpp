// SPDX-License-Identifier: MIT
// What casts shadows into the sky shadow atlas, and when.
#include <SceneRenderer.h>

#include <osg/Depth>
#include <osg/LOD>
#include <osg/Material>
#include <osg/MatrixTransform>
#include <osg/PagedLOD>
#include <osg/Switch>

#include <gtest/gtest.h>

namespace Casters_test
{

using osgEnvLight::LitScene;
using osgEnvLight::Settings;

namespace
{

// A floor seen from above from below a plate that is out of the picture.
class Casters : public testing::Test
{
  protected:
    Casters() : renderer(64, 64), lit(makeLit(constantMap(1.0).get())), plate(makePlate())
    {
        Settings& s = *lit->getSettings();
        s.view = Settings::VISIBILITY;
        s.visibility = Settings::VISIBILITY_ATLAS;
        s.atlasLights = 128;
        s.regeneration = Settings::IMMEDIATE;
        s.bounce = Settings::BOUNCE_MEAN;  // shadows alone
        lit->addChild(makeBox(osg::Vec3d(-3, -3, -0.2), osg::Vec3d(3, 3, 0)));
        renderer.lookAt(osg::Vec3d(0, -1, 1), osg::Vec3d(), osg::Vec3d(0, 0, 1), 60.0);
    }

    static osg::ref_ptr<osg::Geode> makePlate() { return makeBox(osg::Vec3d(-3, -3, 1.5), osg::Vec3d(3, 3, 1.7)); }

    // Mean occlusion of the picture.
    double occluded(int frames = 1)
    {
        const Picture p = renderer.render(lit, frames);
        double sum = 0.0;
        for (int y = 0; y < p.height; ++y)
            for (int x = 0; x < p.width; ++x) sum += 1.0 - double(p.color(x, y)[0]);
        return sum / double(p.pixels());
    }

    SceneRenderer renderer;
    osg::ref_ptr<LitScene> lit;
    osg::ref_ptr<osg::Geode> plate;
};

}  // namespace

TEST_F(Casters, OnlyWhatIsSwitchedOnAndKeepsDepth)
{
    const double open = occluded();
    EXPECT_NEAR(0.0, open, 1e-3);
    osg::ref_ptr<osg::Switch> choice = new osg::Switch;
    choice->addChild(plate, true);
    lit->addChild(choice);
    const double shaded = occluded();
    EXPECT_GT(shaded, 0.7);
    choice->setAllChildrenOff();
    EXPECT_NEAR(open, occluded(), 1e-3);
    choice->setAllChildrenOn();
    EXPECT_NEAR(shaded, occluded(), 1e-3);
    // A dome that writes no depth has nothing behind it.
    plate->getOrCreateStateSet()->setAttributeAndModes(new osg::Depth(osg::Depth::LESS, 0, 1, false));
    EXPECT_NEAR(open, occluded(), 1e-3);
}

TEST_F(Casters, BlendedOnesByTheirOpacity)
{
    lit->addChild(plate);
    const double shaded = occluded();
    for (float opacity : {0.25f, 0.5f, 0.75f}) {
        osg::ref_ptr<osg::Material> m = new osg::Material;
        m->setDiffuse(osg::Material::FRONT_AND_BACK, osg::Vec4(1, 1, 1, opacity));
        plate->getOrCreateStateSet()->setAttributeAndModes(m);
        plate->getOrCreateStateSet()->setMode(GL_BLEND, osg::StateAttribute::ON);
        // The plate's two sides each let 1 - opacity through, and share their texels: what one lets through, the other does.
        EXPECT_NEAR(opacity * shaded, occluded(), 0.1 * shaded) << "opacity " << opacity;
    }
}

TEST_F(Casters, MovingOnesAreShownWithinTheTurnOfTheBudget)
{
    lit->getSettings()->regeneration = Settings::BACKGROUND;
    lit->getSettings()->atlasUpdatesPerFrame = 8;
    osg::ref_ptr<osg::MatrixTransform> mover = new osg::MatrixTransform;
    mover->addChild(plate);
    lit->addChild(mover);
    const double first = occluded();
    EXPECT_TRUE(lit->regenerating());  // a quarter of the maps stands for all
    const double shaded = occluded(1 + 96 / 8);
    EXPECT_FALSE(lit->regenerating());
    EXPECT_NEAR(shaded, first, 0.1 * shaded);
    EXPECT_EQ(shaded, occluded(4));
    mover->setMatrix(osg::Matrixd::translate(0, 0, 0.7));
    const double former = occluded();
    EXPECT_TRUE(lit->regenerating());
    EXPECT_NEAR(shaded, former, 0.2 * shaded);  // 8 of 128 lights know of it
    occluded(128 / 8);
    EXPECT_FALSE(lit->regenerating());
    const double settled = occluded();
    EXPECT_EQ(settled, occluded());
    lit->getSettings()->regeneration = Settings::IMMEDIATE;
    mover->setMatrix(osg::Matrixd::translate(0, 0, 0.71));
    EXPECT_NEAR(occluded(), settled, 0.02);
}

// What the view shows throws the shadow: the level that is chosen by the view's distance.
TEST_F(Casters, TheLevelOfDetailThatTheViewShows)
{
    const double open = occluded();
    lit->addChild(plate);
    const double shaded = occluded();
    lit->removeChild(plate);
    osg::ref_ptr<osg::LOD> lod = new osg::LOD;
    lod->setCenter(osg::Vec3(0, 0, 1.6f));
    lod->setRadius(5.0f);
    lod->addChild(plate, 0.0f, 5.0f);
    lod->addChild(makeBox(osg::Vec3d(20, 20, 1.5), osg::Vec3d(20.1, 20.1, 1.7)), 5.0f, 1e6f);
    lit->addChild(lod);
    EXPECT_NEAR(shaded, occluded(), 0.02);
    // Far away the fine level is not drawn, nor does it cast; the picture shows as much of the floor as before.
    renderer.lookAt(osg::Vec3d(0, -10, 10), osg::Vec3d(), osg::Vec3d(0, 0, 1), 2.0);
    EXPECT_NEAR(open, occluded(), 0.02);
    renderer.lookAt(osg::Vec3d(0, -1, 1), osg::Vec3d(), osg::Vec3d(0, 0, 1), 20.0);
    EXPECT_NEAR(shaded, occluded(), 0.02);
}

// As a pager does: a level that is asked for comes later and is taken away again.
TEST_F(Casters, PagedOnesWhileTheyAreThere)
{
    const double open = occluded();
    osg::ref_ptr<osg::PagedLOD> paged = new osg::PagedLOD;
    paged->setCenter(osg::Vec3(0, 0, 1.6f));
    paged->setRadius(5.0f);
    paged->setRange(0, 0.0f, 1e6f);
    lit->addChild(paged);
    EXPECT_NEAR(open, occluded(), 1e-3);
    paged->addChild(plate, 0.0f, 1e6f);
    const double shaded = occluded();
    EXPECT_GT(shaded, 0.7);
    for (int i = 0; i < 3; ++i) {
        paged->removeChildren(0, paged->getNumChildren());
        EXPECT_NEAR(open, occluded(), 1e-3);
        paged->addChild(plate, 0.0f, 1e6f);
        EXPECT_NEAR(shaded, occluded(), 1e-3);
    }
}

// Skinned or morphed on the CPU: the vertices change in place, and are marked as changed.
TEST_F(Casters, ShapesThatChange)
{
    const double open = occluded();
    plate = makePlate();
    lit->addChild(plate);
    const double shaded = occluded();
    osg::Geometry& geometry = *plate->getDrawable(0)->asGeometry();
    auto& vertices = static_cast<osg::Vec3Array&>(*geometry.getVertexArray());
    const osg::ref_ptr<osg::Vec3Array> before = new osg::Vec3Array(vertices);
    for (osg::Vec3& v : vertices) v = osg::Vec3(v.x() * 0.01f + 20.0f, v.y() * 0.01f, v.z());
    vertices.dirty();
    geometry.dirtyBound();
    geometry.dirtyGLObjects();
    EXPECT_NEAR(open, occluded(), 0.02);
    vertices = *before;
    vertices.dirty();
    geometry.dirtyBound();
    geometry.dirtyGLObjects();
    EXPECT_NEAR(shaded, occluded(), 0.02);
}

}  // namespace Casters_test

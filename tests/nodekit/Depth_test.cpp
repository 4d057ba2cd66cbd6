// SPDX-License-Identifier: MIT
// Hosts whose depth buffers or colour buffers are not OpenSceneGraph's default: the same picture as under that.
#include <SceneRenderer.h>
#include <WindowRenderer.h>

#include <osg/ClipControl>
#include <osg/Depth>
#include <osg/Material>

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace Depth_test
{

using osgEnvLight::LitScene;
using osgEnvLight::Settings;

namespace
{

const int size = 64;

// Shadows of the sky and of a sun, glossy and forward surfaces.
osg::ref_ptr<LitScene> scene(osg::Image* map)
{
    osg::ref_ptr<LitScene> lit = new LitScene(map);
    lit->getSettings()->bounceProbes = fewestProbes;
    lit->getSettings()->atlasLights = 64;
    lit->getSettings()->regeneration = Settings::IMMEDIATE;
    lit->addChild(makeQuad(osg::Vec3d(-4, -4, -1), osg::Vec3d(8, 0, 0), osg::Vec3d(0, 12, 0)));
    lit->addChild(makeBox(osg::Vec3d(-0.5, 0, -1), osg::Vec3d(0.5, 1, 0.4)));
    const auto material = [](const osg::Vec4& diffuse) {
        osg::ref_ptr<osg::Material> m = new osg::Material;
        m->setDiffuse(osg::Material::FRONT_AND_BACK, diffuse);
        m->setSpecular(osg::Material::FRONT_AND_BACK, osg::Vec4(0.4f, 0.4f, 0.4f, 1));
        m->setShininess(osg::Material::FRONT_AND_BACK, 30.0f);
        return m;
    };
    const osg::ref_ptr<osg::Geode> glossy = makeSphere(osg::Vec3d(1.2, 0.5, -0.4), 0.6, 48);
    glossy->getOrCreateStateSet()->setAttributeAndModes(material(osg::Vec4(0.7f, 0.3f, 0.2f, 1)));
    lit->addChild(glossy);
    const osg::ref_ptr<osg::Geode> pane = makeBox(osg::Vec3d(-1.6, -0.4, -0.9), osg::Vec3d(-0.6, -0.3, 0.3));
    pane->getOrCreateStateSet()->setAttributeAndModes(material(osg::Vec4(0.2f, 0.6f, 0.3f, 0.5f)));
    pane->getOrCreateStateSet()->setMode(GL_BLEND, osg::StateAttribute::ON);
    pane->getOrCreateStateSet()->setRenderingHint(osg::StateSet::TRANSPARENT_BIN);
    lit->addChild(pane);
    return lit;
}

osg::ref_ptr<osg::Image> map()
{
    return makeMap(64, 32, [](const osg::Vec3d& d) {
        const double sun = d * osg::Vec3d(0.48, -0.6, 0.64) > 0.995 ? 60.0 : 0.0;
        return osg::Vec3d(0.3, 0.4, 0.6) + osg::Vec3d(sun, sun, sun);
    });
}

// Near plane at 1; a far plane at infinity where far is 0.
osg::Matrixd perspective(double near, double far, bool zeroToOne, bool reversed)
{
    const double f = 1.0 / std::tan(osg::DegreesToRadians(20.0));
    // z = a (-depth) + b over w = depth: at the near plane and at the far one.
    const double first = reversed ? 1.0 : zeroToOne ? 0.0 : -1.0, last = reversed ? (zeroToOne ? 0.0 : -1.0) : 1.0;
    const double b = far > 0.0 ? (first - last) * near * far / (far - near) : (first - last) * near;
    const double a = b / near - first;
    return osg::Matrixd(f, 0, 0, 0, 0, f, 0, 0, 0, 0, a, -1, 0, 0, b, 0);
}

// Share of the pixels in which they differ by more than that.
double difference(const osg::Image& a, const osg::Image& b, double more = 1.5 / 255.0)
{
    int pixels = 0;
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x) {
            const osg::Vec4d d = pixelOf(a, x, y) - pixelOf(b, x, y);
            pixels += std::max({std::abs(d[0]), std::abs(d[1]), std::abs(d[2])}) > more;
        }
    return double(pixels) / (size * size);
}

double range(const osg::Image& a)
{
    double low = 1.0, high = 0.0;
    for (int i = 0; i < size * size; ++i) {
        const osg::Vec4d c = pixelOf(a, i % size, i / size);
        low = std::min(low, c[0] + c[1] + c[2]);
        high = std::max(high, c[0] + c[1] + c[2]);
    }
    return high - low;
}

// An edge's pixels may fall on either side under another rasterisation of depth.
const double edges = 0.01;

}  // namespace

TEST(Depth, ReversedAndInfiniteProjectionsGiveTheSamePicture)
{
    struct Row {
        bool zeroToOne, reversed, flippedRange;
        double far;
    };
    const osg::ref_ptr<osg::Image> environment = map();
    osg::ref_ptr<osg::Image> expected;
    for (const Row& row : {Row{false, false, false, 40.0}, Row{false, false, false, 0.0}, Row{true, false, false, 40.0},
                           Row{true, true, false, 40.0}, Row{true, true, false, 0.0}, Row{false, true, false, 40.0},
                           Row{false, false, true, 40.0}}) {
        WindowRenderer renderer(size, size);
        osg::Camera& camera = *renderer.viewer().getCamera();
        camera.setComputeNearFarMode(osg::CullSettings::DO_NOT_COMPUTE_NEAR_FAR);
        camera.setCullingMode(osg::CullSettings::NO_CULLING);  // OSG's frustum takes all projections for its default's
        camera.setProjectionMatrix(perspective(1.0, row.far, row.zeroToOne, row.reversed));
        osg::StateSet& s = *camera.getOrCreateStateSet();
        if (row.zeroToOne) s.setAttribute(new osg::ClipControl(osg::ClipControl::LOWER_LEFT, osg::ClipControl::ZERO_TO_ONE));
        if (row.reversed || row.flippedRange) {
            const double near = row.flippedRange ? 1.0 : 0.0;
            s.setAttributeAndModes(new osg::Depth(osg::Depth::GEQUAL, near, 1.0 - near));
            camera.setClearDepth(0.0);
        }
        NotifyCatcher notify;
        const osg::ref_ptr<osg::Image> found = renderer.render(scene(environment), 3);
        EXPECT_EQ("", notify.text());
        if (!expected) expected = found;
        EXPECT_GT(range(*found), 0.4);
        EXPECT_LE(difference(*expected, *found), edges) << "0 to 1: " << row.zeroToOne << ", reversed: " << row.reversed
                                                        << ", flipped: " << row.flippedRange << ", far " << row.far;
    }
}

TEST(Depth, ADepthPartitionShowsBothParts)
{
    const osg::ref_ptr<osg::Image> environment = map();
    osg::ref_ptr<osg::Image> expected;
    for (int background : {int(Settings::BACKGROUND_AUTO), int(Settings::BACKGROUND_ON)})
        for (bool partition : {false, true}) {
            WindowRenderer renderer(size, size);
            if (partition) {
                const osg::ref_ptr<osgViewer::DepthPartitionSettings> parts =
                    new osgViewer::DepthPartitionSettings(osgViewer::DepthPartitionSettings::FIXED_RANGE);
                parts->_zNear = 0.5;
                parts->_zMid = 4.3;
                parts->_zFar = 100.0;
                EXPECT_TRUE(renderer.viewer().setUpDepthPartition(parts));
            }
            const osg::ref_ptr<LitScene> lit = scene(environment);
            lit->getSettings()->background = background;
            const osg::ref_ptr<osg::Image> found = renderer.render(lit, 3);
            if (!partition && background == Settings::BACKGROUND_AUTO) expected = found;
            // Each part's screen shows its own side of the cut alone: what is near it is shaded a little otherwise.
            EXPECT_LE(difference(*expected, *found, 0.1), 0.03) << "partition " << partition << ", background " << background;
            EXPECT_GT(range(*found), 0.4);
        }
}

TEST(Depth, ACameraThatKeepsTheColoursBehindIsDrawnOverThem)
{
    for (int background : {int(Settings::BACKGROUND_AUTO), int(Settings::BACKGROUND_ON)}) {
        WindowRenderer renderer(size, size);
        renderer.viewer().getCamera()->setClearColor(osg::Vec4(0, 1, 0, 1));
        const osg::ref_ptr<osg::Camera> over = new osg::Camera;
        over->setClearMask(GL_DEPTH_BUFFER_BIT);
        over->setRenderOrder(osg::Camera::POST_RENDER, 1);
        over->setGraphicsContext(&renderer.window());
        over->setViewport(0, 0, size, size);
        renderer.viewer().addSlave(over, false);
        const osg::ref_ptr<LitScene> lit = new LitScene(map());
        lit->getSettings()->bounceProbes = fewestProbes;
        lit->getSettings()->background = background;
        lit->addChild(makeSphere(osg::Vec3d(), 0.5, 32));
        over->addChild(lit);
        const osg::ref_ptr<osg::Image> found = renderer.render(new osg::Group, 3);
        EXPECT_EQ(pixelOf(*found, 2, 2), osg::Vec4d(0, 1, 0, 1)) << background;
        EXPECT_LT(pixelOf(*found, size / 2, size / 2)[1], 0.99) << background;
        EXPECT_NE(lit->plan().explain().find("does not clear"), std::string::npos) << lit->plan().explain();
    }
}

TEST(Depth, StereoHasBothEyesInEveryMode)
{
    const osg::ref_ptr<osg::Image> environment = map();
    using D = osg::DisplaySettings;
    WindowRenderer mono(size, size);
    const osg::ref_ptr<osg::Image> expected = mono.render(scene(environment), 3);
    for (D::StereoMode mode : {D::HORIZONTAL_INTERLACE, D::VERTICAL_INTERLACE, D::CHECKERBOARD}) {
        WindowRenderer renderer(size, size, 8);
        const osg::ref_ptr<D> settings = new D(*D::instance());
        settings->setStereo(true);
        settings->setStereoMode(mode);
        settings->setMinimumNumStencilBits(8);
        renderer.viewer().setDisplaySettings(settings);
        NotifyCatcher notify;
        const osg::ref_ptr<LitScene> lit = scene(environment);
        const osg::ref_ptr<osg::Image> found = renderer.render(lit, 4);
        EXPECT_EQ("", notify.text());
        EXPECT_EQ(lit->numViews(), 2u) << "mode " << mode;
        // The eyes lie apart: edges are elsewhere in half of the pixels each, the sky and the floor are where they are.
        int alike = 0;
        for (int y = 0; y < size; ++y)
            for (int x = 0; x < size; ++x) {
                const osg::Vec4d d = pixelOf(*expected, x, y) - pixelOf(*found, x, y);
                alike += std::max({std::abs(d[0]), std::abs(d[1]), std::abs(d[2])}) < 0.1;
            }
        EXPECT_GT(alike, 0.75 * size * size) << "mode " << mode;
    }
}

}  // namespace Depth_test

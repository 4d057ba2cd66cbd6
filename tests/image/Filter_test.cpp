// SPDX-License-Identifier: MIT
// What the filter over the interleaved lights leaves and what it spoils [occlusion.md 3.3].
#include <SceneRenderer.h>

#include <gtest/gtest.h>

#include <cmath>
#include <complex>

namespace Filter_test
{

using osgEnvLight::LitScene;
using osgEnvLight::Settings;

namespace
{

const int side = 96;

class Filter : public testing::TestWithParam<int>
{
  protected:
    Filter() : renderer(side, side), lit(makeLit(lopsidedMap().get()))
    {
        Settings& s = *lit->getSettings();
        s.view = Settings::VISIBILITY;
        s.regeneration = Settings::IMMEDIATE;
        s.visibility = Settings::Visibility(GetParam());
        lit->addChild(makeBox(osg::Vec3d(-8, -8, -0.3), osg::Vec3d(8, 8, 0)));
    }

    void lookDown(double width)
    {
        renderer.lookAt(osg::Vec3d(0, 0, 20), osg::Vec3d(), osg::Vec3d(0, 1, 0));
        renderer.viewer().getCamera()->setProjectionMatrixAsOrtho(-width / 2, width / 2, -width / 2, width / 2, 1, 40);
    }

    SceneRenderer renderer;
    osg::ref_ptr<LitScene> lit;
};

// The largest amplitude of waves of two and four pixels, over the mean: of those that a pattern of 4x4 pixels is made of. Hann's
// window keeps what bends slowly out of it.
double patternOf(const Picture& p, int x0, int y0, int size)
{
    double worst = 0.0, mean = 0.0;
    for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 4; ++j) {
            std::complex<double> wave;
            double weights = 0.0;
            for (int y = 0; y < size; ++y)
                for (int x = 0; x < size; ++x) {
                    const double w =
                        (1 - std::cos(2 * osg::PI * (x + 0.5) / size)) * (1 - std::cos(2 * osg::PI * (y + 0.5) / size));
                    wave += w * double(p.color(x0 + x, y0 + y)[1]) * std::polar(1.0, osg::PI / 2 * (i * x + j * y));
                    weights += w;
                }
            const double amplitude = 2.0 * std::abs(wave) / weights;
            if (i == 0 && j == 0)
                mean = amplitude / 2.0;
            else
                worst = std::max(worst, amplitude);
        }
    return worst / mean;
}

std::string nameOf(const testing::TestParamInfo<int>& info)
{
    return info.param == int(Settings::VISIBILITY_SCREEN) ? "Screen" : "Atlas";
}

}  // namespace

INSTANTIATE_TEST_SUITE_P(Every, Filter, testing::Values(int(Settings::VISIBILITY_AUTO), int(Settings::VISIBILITY_SCREEN)),
                         nameOf);

// -40 dB, in the half-shadow of a wall.
TEST_P(Filter, NoPatternIsLeft)
{
    lit->addChild(makeBox(osg::Vec3d(-6, 1, 0), osg::Vec3d(6, 1.3, 2)));
    lookDown(4.0);
    const Picture filtered = renderer.render(lit, 2);
    EXPECT_LT(patternOf(filtered, 16, 8, 48), 0.01);
    // As much as is asked for would be seen.
    Picture patterned = filtered;
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) patterned.rgba[4 * size_t(y * side + x) + 1] *= x % 4 == 1 && y % 4 == 2 ? 1.1f : 1.0f;
    EXPECT_GT(patternOf(patterned, 16, 8, 48), 0.01);
}

// Where a coarse mesh has normals that are interpolated over its facets, neighbours are still found on its plane: on a floor seen
// at 6 degrees eight pixels are further apart than it is wide.
TEST_P(Filter, NoPatternIsLeftUnderInterpolatedNormals)
{
    const osg::ref_ptr<osg::Geode> floor = makeQuad(osg::Vec3d(-8, -8, 0.01), osg::Vec3d(16, 0, 0), osg::Vec3d(0, 16, 0));
    osg::ref_ptr<osg::Vec3Array> normals = new osg::Vec3Array;
    for (const osg::Vec3& v : static_cast<osg::Vec3Array&>(*floor->getDrawable(0)->asGeometry()->getVertexArray()))
        normals->push_back(osg::Vec3(v.x() / 8, v.y() / 8, 1));
    floor->getDrawable(0)->asGeometry()->setNormalArray(normals, osg::Array::BIND_PER_VERTEX);
    lit->addChild(floor);
    lit->addChild(makeBox(osg::Vec3d(-6, 5, 0), osg::Vec3d(6, 5.3, 4)));
    renderer.lookAt(osg::Vec3d(0, -14, 1.5), osg::Vec3d(0, 0, 0), osg::Vec3d(0, 0, 1), 12.0);
    const Picture p = renderer.render(lit, 2);
    EXPECT_LT(patternOf(p, 16, 24, 48), 0.01);  // measured .005, .022 by the normals' planes
}

// The top of a plate high above the floor sees everything, the floor below it does not: two pixels off the edge nothing of
// the floor's is left on the plate.
TEST_P(Filter, NoHaloAtADepthStep)
{
    const double pixel = 4.0 / side;
    lit->addChild(makeBox(osg::Vec3d(-1, -1, 0.8), osg::Vec3d(1, 1, 1)));
    lookDown(4.0);
    const Picture p = renderer.render(lit, 2);
    const int half = int(1.0 / pixel) - 2;
    double least = 1.0;
    for (int y = side / 2 - half; y < side / 2 + half; ++y)
        for (int x = side / 2 - half; x < side / 2 + half; ++x) least = std::min(least, double(p.color(x, y)[1]));
    EXPECT_GT(least, 0.98);
    double floor = 1.0;  // beside the plate, on the side away from the light
    for (int y = side / 2; y < side / 2 + half + 8; ++y) floor = std::min(floor, double(p.color(side / 2 - half - 4, y)[1]));
    EXPECT_LT(floor, 0.8);
}

}  // namespace Filter_test

// SPDX-License-Identifier: MIT
// Shadows of area lights beside ray-traced direct light, in the scenes of tests/bench/area_study.
#include <AreaScenes.h>

#include <gtest/gtest.h>

namespace AreaShadows_test
{

using osgEnvLight::LitScene;

namespace
{

const int size = 128;

struct Bound {
    const char* scene;
    double error;  // tRMSE; measured by this test, times 1.15 for another CPU's last bits and the reference's noise
    unsigned samples = 256;
};

class AreaShadows : public testing::TestWithParam<Bound>
{
};

}  // namespace

TEST_P(AreaShadows, AreThoseOfTheReference)
{
    SceneRenderer renderer(size, size);
    const osg::ref_ptr<LitScene> lit = suite::makeAreaScene(GetParam().scene, renderer);
    const suite::AreaTruth truth = suite::tracedArea(*lit, renderer, GetParam().samples);
    const Picture picture = renderer.render(lit, suite::areaFrames);
    const double error = osgEnvLight::compare(picture, truth.picture, truth.error, truth.mask).tRmse;
    RecordProperty("tRMSE", std::to_string(error));
    EXPECT_LT(error, GetParam().error);
    // Without shadows it is farther off by more: the test sees them.
    lit->getSettings()->occlusion = false;
    EXPECT_GT(osgEnvLight::compare(renderer.render(lit, suite::areaFrames), truth.picture, truth.error, truth.mask).tRmse,
              1.35 * GetParam().error);
}

INSTANTIATE_TEST_SUITE_P(Scenes, AreaShadows,
                         testing::Values(Bound{"table", 0.0108}, Bound{"room", 0.0112}, Bound{"grille", 0.0194},
                                         Bound{"strips", 0.0537}, Bound{"many", 0.0145}, Bound{"city", 0.032, 64},
                                         Bound{"stripes", 0.0144}, Bound{"screen", 0.0513}),
                         [](const auto& i) { return std::string(i.param.scene); });

}  // namespace AreaShadows_test

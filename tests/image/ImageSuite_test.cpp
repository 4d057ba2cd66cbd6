// SPDX-License-Identifier: MIT
// Fifteen scenes under four maps, beside the ray-traced reference: no figure of tests/suite/measured.csv gets worse. Whoever
// changes what the pictures look like writes it anew, and sees in its diff where they are nearer the truth and where not:
//   envlight_image_suite --table tests/suite/measured.csv
#include "Suite.h"

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <sstream>
#include <stdexcept>

namespace ImageSuite_test
{

using suite::Figure;
using suite::Figures;
using suite::Result;
using suite::Row;

namespace
{

const char* const measuredFile = ENVLIGHT_SOURCE_DIR "/tests/suite/measured.csv";
const char* const scalarFile = ENVLIGHT_SOURCE_DIR "/tests/suite/exact_scalar_occlusion.csv";
const char* const sheetFile = ENVLIGHT_BINARY_DIR "/image-suite.png";

const Figures* measuredOf(const Row& row)
{
    static const auto measured = suite::readMeasured(measuredFile);
    const auto found = measured.find(row.name());
    return found != measured.end() ? &found->second : nullptr;
}

// Of the installed rows; how many they are.
template <class Function>
int forRows(Function function)
{
    int count = 0;
    for (const Row& row : suite::rows())
        if (suite::result(row).installed) {
            ++count;
            function(row, suite::result(row));
        }
    return count;
}

// For the eye, of what has been rendered.
class ContactSheet : public testing::Environment
{
  public:
    void TearDown() override
    {
        bool any = false;
        for (const Row& row : suite::rows()) any = any || suite::hasResult(row);
        if (!any) return;
        suite::writeContactSheet(sheetFile);
        std::cout << "pictures, ours, reference, difference: " << sheetFile << "\n";
    }
};

const testing::Environment* const contactSheet = testing::AddGlobalTestEnvironment(new ContactSheet);

}  // namespace

// Of the index of a row.
class ImageSuite : public testing::TestWithParam<size_t>
{
};

TEST_P(ImageSuite, IsNoWorseThanMeasured)
{
    const Row& row = suite::rows()[GetParam()];
    const Result& r = suite::result(row);
    if (!r.installed) GTEST_SKIP() << "its scene or its map is not installed";
    const Figures* measured = measuredOf(row);
    ASSERT_TRUE(measured) << "not in " << measuredFile;
    for (int i = 0; i < suite::NUM_FIGURES; ++i) {
        const Figure f = Figure(i);
        if (!suite::bounded(f, (*measured)[f])) continue;
        EXPECT_LE(r.figures[f], suite::bound(f, (*measured)[f], r.noise[f]))
            << suite::figureNames[f] << ", measured " << (*measured)[f] << (*row.why ? ": " : "") << row.why;
    }
}

INSTANTIATE_TEST_SUITE_P(Rows, ImageSuite, testing::Range(size_t(0), suite::rows().size()),
                         [](const auto& parameter) { return suite::rows()[parameter.param].name(); });

// Bounds that the pictures have left far behind bound nothing.
TEST(ImageSuiteTable, IsNotFarBetterThanMeasured)
{
    Figures now{}, before{};
    ASSERT_GT(forRows([&](const Row& row, const Result& r) {
                  const Figures* measured = measuredOf(row);
                  if (!measured) return;
                  for (size_t f = 0; f < now.size(); ++f) now[f] += r.figures[f], before[f] += (*measured)[f];
              }),
              0);
    for (Figure f : {suite::TONED, suite::DISSIMILARITY, suite::DIFFUSE, suite::SPECULAR, suite::OCCLUSION, suite::BOUNCED})
        EXPECT_GE(now[f], before[f] / 1.15) << suite::figureNames[f] << ": better; write " << measuredFile << " anew";
}

TEST(ImageSuiteTable, OcclusionBringsThePictureNearerTheReference)
{
    double with = 0.0, without = 0.0;
    std::ostringstream worse;
    const int count = forRows([&](const Row& row, const Result& r) {
        if (!*row.why) {
            with += r.figures[suite::TONED];
            without += r.withoutOcclusion;
        }
        if (r.figures[suite::TONED] > 1.05 * r.withoutOcclusion + r.noise[suite::TONED]) worse << " " << row.name();
    });
    ASSERT_GT(count, 0);
    EXPECT_LT(with, 0.25 * without);  // .16 when written; rows that say why are left out
    EXPECT_EQ("", worse.str());
}

// What surfaces send each other: beside full light transport the bounce leaves less than without it. Rows on which it is worse
// are open scenes where hardly any light is sent on, and lose a thousandth of white at most.
TEST(ImageSuiteTable, TheBounceBringsThePictureNearerFullTransport)
{
    double with = 0.0, without = 0.0;
    std::ostringstream worse;
    const int count = forRows([&](const Row& row, const Result& r) {
        with += r.figures[suite::BOUNCED];
        without += r.withoutBounce;
        if (r.figures[suite::BOUNCED] > r.withoutBounce + 0.0015 + r.noise[suite::BOUNCED]) worse << " " << row.name();
    });
    ASSERT_GT(count, 0);
    EXPECT_LT(with, 0.42 * without);  // .37 when written
    EXPECT_EQ("", worse.str());
}

// One number a pixel can't say from where light is kept: even exact, and with all else exact, it leaves more error than our
// pictures have with all of theirs [envlight_scalar_study]. tRMSE says so of 59 rows in 61, relMSE of 54. Not of three of the
// atrium's, where light leaks at the walls' feet into what is all but black; nor of four in which a few pixels of S outweigh the
// picture, as glossy surfaces reflect what is hidden from them: gloss under courtyard and sunset, chess and spheres under studio.
// D - O alone is nearer than exact ambient occlusion on those, too.
TEST(ImageSuiteTable, IsBetterThanExactScalarOcclusion)
{
    const auto scalar = suite::readScalar(scalarFile);
    for (Figure f : {suite::REL_MSE, suite::TONED}) {
        const double share = f == suite::REL_MSE ? 0.86 : 0.95;  // one row fewer than that
        int better = 0;
        std::ostringstream others;
        const int count = forRows([&](const Row& row, const Result& r) {
            ASSERT_EQ(1u, scalar.count(row.name())) << row.name() << " is not in " << scalarFile;
            const double figure = scalar.at(row.name())[f], noise = r.noise[f];
            const double most = f == suite::REL_MSE ? figure + noise * noise : std::hypot(figure, noise);
            if (r.figures[f] <= most)
                ++better;
            else
                others << "\n" << row.name() << " " << r.figures[f] << " > " << most;
        });
        ASSERT_GT(count, 0);
        EXPECT_GE(better, share * count) << suite::figureNames[f] << others.str();
    }
}

TEST(ImageSuiteTable, HalfTheSpecularSamplesAreWorse)
{
    double all = 0.0, half = 0.0;
    forRows([&](const Row&, const Result& r) {
        if (r.halfSamples > 0.0) all += r.figures[suite::SPECULAR], half += r.halfSamples;
    });
    if (half == 0.0) GTEST_SKIP() << "nothing glossy is installed";
    EXPECT_LT(all, 0.8 * half);
}

}  // namespace ImageSuite_test

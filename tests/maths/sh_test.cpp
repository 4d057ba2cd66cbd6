// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "Maths.h"

namespace sh_test
{

using namespace testmaths;
using glsl::vec3;

namespace
{

const int firstOfBand[] = {0, 1, 4, 9, 18};  // bands 0, 1, 2, 4
const double cosine[] = {pi, 2.0 * pi / 3.0, pi / 4.0, -pi / 24.0};

// Coefficients of E/pi for one light of unit flux from d.
std::vector<vec3> ofLight(const vec3& d)
{
    std::vector<vec3> c(18);
    for (int band = 0; band < 4; ++band)
        for (int i = firstOfBand[band]; i < firstOfBand[band + 1]; ++i)
            c[size_t(i)] = vec3(cosine[band] / pi * glsl::shBasis18(i, d));
    return c;
}

}  // namespace

TEST(sh, Orthonormal)
{
    // Products are polynomials of degree 8: 8 Gauss nodes and 16 azimuths are exact.
    for (int i = 0; i < 18; ++i)
        for (int j = 0; j <= i; ++j) {
            auto product = [&](const vec3& d) { return glsl::shBasis18(i, d) * glsl::shBasis18(j, d); };
            EXPECT_NEAR(integrateBand(product, -1.0, 1.0, 8, 16), i == j ? 1.0 : 0.0, 1e-13) << i << " " << j;
        }
}

TEST(sh, AdditionTheorem)
{
    // sum_m Y^2 = (2l+1) / 4 pi in every direction: no band is another's
    for (const vec3& d : spiral(200))
        for (int band = 0; band < 4; ++band) {
            double sum = 0.0;
            for (int i = firstOfBand[band]; i < firstOfBand[band + 1]; ++i) sum += glsl::shBasis18(i, d) * glsl::shBasis18(i, d);
            EXPECT_NEAR(sum, (2.0 * (band == 3 ? 4 : band) + 1.0) / (4.0 * pi), 1e-14);
        }
}

TEST(sh, ZonalTermsAndSigns)
{
    // No Condon-Shortley sign: Y_1 = sqrt(3/4pi) (y, z, x), positive along their axes.
    const double k = std::sqrt(0.75 / pi);
    EXPECT_NEAR(glsl::shBasis18(1, vec3(0, 1, 0)), k, 1e-15);
    EXPECT_NEAR(glsl::shBasis18(2, vec3(0, 0, 1)), k, 1e-15);
    EXPECT_NEAR(glsl::shBasis18(3, vec3(1, 0, 0)), k, 1e-15);
    EXPECT_NEAR(glsl::shBasis18(6, vec3(0, 0, 1)), std::sqrt(1.25 / pi), 1e-15);
    EXPECT_NEAR(glsl::shBasis18(13, vec3(0, 0, 1)), std::sqrt(2.25 / pi), 1e-15);
}

TEST(sh, IrradianceOfAConstantMap)
{
    std::vector<vec3> c(18, vec3(0.0));
    c[0] = vec3(std::sqrt(4.0 * pi)) * vec3(1.0, 2.0, 0.5);
    for (const vec3& n : spiral(50)) {
        const vec3 e = glsl::shIrradiance(c.data(), n);
        EXPECT_NEAR(e.x, 1.0, 1e-14);
        EXPECT_NEAR(e.y, 2.0, 1e-14);
        EXPECT_NEAR(e.z, 0.5, 1e-14);
    }
}

TEST(sh, IrradianceOfOneLight)
{
    // Towards the light sum A_l (2l+1)/4pi = 1/4 + 1/2 + 5/16 - 3/32; away from it 1/4 - 1/2 + 5/16 - 3/32 < 0, clamped.
    for (const vec3& d : spiral(50)) {
        const std::vector<vec3> light = ofLight(d);
        std::vector<vec3> c = light;
        EXPECT_NEAR(glsl::shIrradiance(c.data(), d).x * pi, 0.96875, 1e-14);
        EXPECT_EQ(glsl::shIrradiance(c.data(), -d), vec3(0.0));
    }
}

TEST(sh, CosineLobeWithinItsTruncation)
{
    // Clamped cosine against its bands 0, 1, 2, 4. All that is missing begins with band 6; it is largest at the kink,
    // 1/4 - 5/16 1/2 - 3/32 3/8 = .05859375, and .03125 at both ends.
    for (int i = 0; i <= 200; ++i) {
        const double z = -1.0 + i / 100.0;
        std::vector<vec3> c = ofLight(vec3(0, 0, 1));
        const double e = glsl::shIrradiance(c.data(), vec3(std::sqrt(std::max(0.0, 1.0 - z * z)), 0.0, z)).x * pi;
        EXPECT_NEAR(e, std::max(z, 0.0), std::abs(z) < 0.5 ? 0.05859375 + 1e-13 : 0.03125 + 1e-13) << z;
    }
}

}  // namespace sh_test

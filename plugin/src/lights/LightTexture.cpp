// SPDX-License-Identifier: MIT
#include "lights/LightTexture.h"

#include "base/Limits.h"

#include "gl/TargetTexture.h"
#include "environment/SphericalHarmonics.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>

#include "glsl.h"

namespace osgEnvLight
{

namespace
{

const size_t dealtGroups = limits::LIGHT_GROUPS;
const int lastBand = 6;
const size_t moments = 49;

// Index along the Hilbert curve of the cell (x, y) of a 4096 x 4096 square.
uint32_t hilbertIndex(uint32_t x, uint32_t y)
{
    uint32_t index = 0;
    for (uint32_t s = 2048; s > 0; s /= 2) {
        const uint32_t rx = (x & s) ? 1 : 0;
        const uint32_t ry = (y & s) ? 1 : 0;
        index += s * s * ((3 * rx) ^ ry);
        if (ry == 0) {
            if (rx == 1) {
                x = 4095 - x;
                y = 4095 - y;
            }
            std::swap(x, y);
        }
    }
    return index;
}

uint32_t hilbertIndex(const osg::Vec3d& d)
{
    const glsl::vec2 st = glsl::octahedralFromDirection(glsl::vec3(d[0], d[1], d[2]));
    auto cell = [](double x) { return uint32_t(std::clamp(x * 4096.0, 0.0, 4095.0)); };
    return hilbertIndex(cell(st.x), cell(st.y));
}

// Along the Hilbert curve of the octahedral square: each block of 16 neighbours gives one light to each group.
std::vector<int> alongCurve(const LightList& lights)
{
    std::vector<std::pair<uint32_t, int>> keys(lights.size());
    for (size_t i = 0; i < lights.size(); ++i) keys[i] = {hilbertIndex(lights[i].direction), int(i)};
    std::sort(keys.begin(), keys.end());
    std::vector<int> order;
    for (const auto& [key, i] : keys) order.push_back(i);
    return order;
}

// Fisher and Yates, by the generator of Park and Miller: std::shuffle is another one in every library.
std::vector<int> shuffled(size_t count)
{
    std::vector<int> order(count);
    std::iota(order.begin(), order.end(), 0);
    uint64_t state = 1;
    for (size_t i = count; i > 1; --i) {
        state = state * 48271 % 2147483647;
        std::swap(order[i - 1], order[state % i]);
    }
    return order;
}

// Of a light's flux: spherical harmonics, those of the higher bands, which matter less to irradiance, weighted down.
using Signature = std::array<double, moments>;

Signature signature(const DirectionalLight& light)
{
    Signature s;
    evaluateHarmonics(lastBand, light.direction, s.data());
    for (int l = 0; l <= lastBand; ++l) {
        // The flux itself counts three times: without, the worst group of a map of few lamps has 5 % too much; with, .8 %.
        const double weight = l == 0 ? 3.0 : std::sqrt(1.0 / (1.0 + 0.5 * l * l));
        for (int m = l * l; m < (l + 1) * (l + 1); ++m) s[size_t(m)] *= weight * sumOf(light.flux);
    }
    return s;
}

// Four passes over the pairs of each block: swap where the groups' sums come nearer to their mean.
void evenGroups(std::vector<int>& order, const LightList& lights)
{
    std::vector<Signature> signatures(order.size(), Signature{});
    std::array<Signature, dealtGroups> sums{};
    for (size_t i = 0; i < order.size(); ++i) {
        if (order[i] >= 0) signatures[i] = signature(lights[size_t(order[i])]);
        for (size_t k = 0; k < moments; ++k) sums[i % dealtGroups][k] += signatures[i][k];
    }
    for (int pass = 0; pass < 4; ++pass)
        for (size_t block = 0; block < order.size(); block += dealtGroups)
            for (size_t a = 0; a < dealtGroups; ++a)
                for (size_t b = a + 1; b < dealtGroups; ++b) {
                    Signature& x = signatures[block + a];
                    Signature& y = signatures[block + b];
                    double gain = 0.0;
                    for (size_t k = 0; k < moments; ++k) {
                        const double d = x[k] - y[k];
                        gain += d * (sums[a][k] - sums[b][k] - d);
                    }
                    if (gain <= 0.0) continue;
                    for (size_t k = 0; k < moments; ++k) {
                        const double d = x[k] - y[k];
                        sums[a][k] -= d;
                        sums[b][k] += d;
                    }
                    std::swap(x, y);
                    std::swap(order[block + a], order[block + b]);
                }
}

}  // namespace

std::vector<int> dealOrder(const LightList& lights, LightDeal deal)
{
    std::vector<int> order = deal == DEAL_RANDOM ? shuffled(lights.size()) : alongCurve(lights);
    order.resize((order.size() + dealtGroups - 1) / dealtGroups * dealtGroups, -1);
    if (deal == DEAL_MOMENTS) evenGroups(order, lights);
    return order;
}

LightList dealt(const LightList& lights, LightDeal deal)
{
    LightList result;
    for (int i : dealOrder(lights, deal))
        result.push_back(i < 0 ? DirectionalLight{osg::Vec3d(0, 0, 1), osg::Vec3d()} : lights[size_t(i)]);
    return result;
}

osg::ref_ptr<osg::Texture2D> lightTexture(const LightList& lights, unsigned groups, double scale)
{
    const unsigned columns = std::max(1u, (unsigned(lights.size()) + groups - 1) / groups);
    osg::ref_ptr<osg::Image> image = new osg::Image;
    image->allocateImage(int(columns), int(2 * groups), 1, GL_RGBA, GL_FLOAT);
    image->setInternalTextureFormat(GL_RGBA32F_ARB);
    std::fill_n(reinterpret_cast<float*>(image->data()), image->getTotalSizeInBytes() / sizeof(float), 0.0f);
    for (unsigned i = 0; i < lights.size(); ++i) {
        float* direction = reinterpret_cast<float*>(image->data(i / groups, 2 * (i % groups)));
        float* flux = reinterpret_cast<float*>(image->data(i / groups, 2 * (i % groups) + 1));
        for (int k = 0; k < 3; ++k) {
            direction[k] = float(lights[i].direction[k]);
            flux[k] = float(lights[i].flux[k] * scale);
        }
    }
    osg::ref_ptr<osg::Texture2D> texture = targetTexture(int(columns), int(2 * groups), GL_RGBA32F_ARB);
    texture->setImage(image);
    return texture;
}

}  // namespace osgEnvLight

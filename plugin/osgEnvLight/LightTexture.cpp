// SPDX-License-Identifier: MIT
#include <osgEnvLight/LightTexture>

#include <osgEnvLight/GBuffer>

#include <algorithm>
#include <cstdint>
#include <numeric>

#include "glsl.h"

namespace osgEnvLight
{

namespace
{

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

}  // namespace

LightList dealt(LightList lights)
{
    std::vector<std::pair<uint32_t, size_t>> order(lights.size());
    for (size_t i = 0; i < lights.size(); ++i) order[i] = {hilbertIndex(lights[i].direction), i};
    std::sort(order.begin(), order.end());
    LightList result;
    result.reserve(lights.size());
    for (const auto& [index, i] : order) result.push_back(lights[i]);
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

// SPDX-License-Identifier: MIT
#include "indirect/StoppedRay.h"

#include <cmath>
#include <cstring>

namespace osgEnvLight
{

namespace
{

// A number in [0,1) that looks random, the same for the same triangle and ray.
float chance(unsigned triangle, const osg::Vec3f& direction)
{
    uint32_t bits[3];
    std::memcpy(bits, direction.ptr(), sizeof(bits));
    uint32_t h = triangle * 0x9E3779B9u ^ bits[0] * 0x85EBCA6Bu ^ bits[1] * 0xC2B2AE35u ^ bits[2];
    h = (h ^ h >> 16) * 0x7FEB352Du;
    h = (h ^ h >> 15) * 0x846CA68Bu;
    return float((h ^ h >> 16) >> 8) / 16777216.0f;
}

}  // namespace

std::optional<CasterBvh::Hit> stoppedRay(const TracedScene& scene, const CasterBvh& bvh, const osg::Vec3f& from,
                                         const osg::Vec3f& to, float within)
{
    float before = 0.0f;
    for (int layer = 0; layer < 64 && before < within; ++layer) {
        std::optional<CasterBvh::Hit> hit = bvh.nearest(from + to * before, to, within - before);
        if (!hit) return hit;
        hit->distance += before;
        const float opacity = scene.surfaces[scene.surfaceOf[hit->triangle]].opacity;
        if (opacity >= 1.0f || chance(hit->triangle, to) < opacity) return hit;
        before = std::nextafter(hit->distance * 1.0001f, 1e30f);
    }
    return std::nullopt;
}

}  // namespace osgEnvLight

// SPDX-License-Identifier: MIT
#include "environment/PrefilteredMap.h"

#include "environment/MapPyramid.h"

#include <osg/Vec3f>

#include <algorithm>
#include <cmath>
#include <vector>

#include "glsl.h"

namespace osgEnvLight
{

namespace
{

struct LobeSample {
    glsl::vec3 direction;  // in a lobe about +Z
    float share;           // of the lobe
    unsigned level;        // of the pyramid, with texels as wide as the share
};

// A level has a quarter of the texels of the one before: twice the samples for each.
unsigned samplesOf(unsigned level)
{
    return 32u << std::min(level, 5u);
}

std::vector<LobeSample> sampleLobe(double alpha, unsigned count, unsigned side, unsigned lastLevel)
{
    const glsl::vec3 up(0, 0, 1);
    std::vector<LobeSample> samples;
    double sum = 0.0;
    for (unsigned i = 0; i < count; ++i) {
        const glsl::vec2 u(std::fmod((i + 0.5) * 0.6180339887498949, 1.0), (i + 0.5) / count);
        const glsl::vec3 h = glsl::ggxVisibleNormalSample(up, alpha, u);
        const glsl::vec3 d = 2.0 * h.z * h - up;
        if (d.z <= 0.0) continue;
        const double share = glsl::ggxG2OverG1(1.0, d.z, alpha);
        const double texels = 4.0 * glsl::PI * count * glsl::ggxReflectionPdf(up, h, alpha);  // of that width on the sphere
        const double level = std::clamp(std::floor(std::log2(side / std::sqrt(texels))), 0.0, double(lastLevel));
        samples.push_back({d, float(share), unsigned(level)});
        sum += share;
    }
    for (LobeSample& s : samples) s.share /= float(sum);
    return samples;
}

// The pyramid's levels, read bilinearly.
class Levels
{
  public:
    Levels(const osg::Image& atlas, unsigned side, unsigned last) : _rowFloats(size_t(atlas.s()) * 3)
    {
        for (unsigned level = 0; level <= last; ++level) {
            const glsl::vec2 corner = glsl::pyramidLevelCorner(side, level);
            _levels.push_back(
                {reinterpret_cast<const float*>(atlas.data(unsigned(corner.x), unsigned(corner.y))), float(side >> level)});
        }
    }

    /** Adds that share of what lies in the direction. */
    void add(const glsl::vec3& d, float share, unsigned level, osg::Vec3f& sum) const
    {
        const Level& l = _levels[level];
        const glsl::vec2 st = glsl::octahedralFromDirection(d);
        const float tx = float(st.x) * l.side + 0.5f, ty = float(st.y) * l.side + 0.5f;  // of the bordered square's texels
        const unsigned ix = unsigned(tx), iy = unsigned(ty);
        const float below = share * (1.0f - ty + float(iy));
        const float* row = l.texels + iy * _rowFloats + size_t(ix) * 3;
        addPair(row, below, tx - float(ix), sum);
        addPair(row + _rowFloats, share - below, tx - float(ix), sum);
    }

  private:
    struct Level {
        const float* texels;
        float side;
    };

    static void addPair(const float* t, float share, float a, osg::Vec3f& sum)
    {
        const float right = share * a, left = share - right;
        for (int i = 0; i < 3; ++i) sum[i] += left * t[i] + right * t[i + 3];
    }

    size_t _rowFloats;
    std::vector<Level> _levels;
};

osg::Vec3f filtered(const Levels& levels, const std::vector<LobeSample>& lobe, const glsl::vec3& normal)
{
    const glsl::mat3 frame = glsl::frameAround(normal);
    osg::Vec3f sum;
    for (const LobeSample& s : lobe) levels.add(frame * s.direction, s.share, s.level, sum);
    return sum;
}

}  // namespace

osg::ref_ptr<osg::Image> prefilterPyramid(const osg::Image& pyramid, unsigned side)
{
    const unsigned last = pyramidLastLevel(side);
    const Levels levels(pyramid, side, last);
    osg::ref_ptr<osg::Image> atlas = new osg::Image;
    atlas->allocateImage(pyramid.s(), pyramid.t(), 1, GL_RGB, GL_FLOAT);
    std::fill_n(reinterpret_cast<float*>(atlas->data()), atlas->getTotalSizeInBytes() / sizeof(float), 0.0f);
    for (unsigned level = 0; level <= last; ++level) {
        const int s = int(side >> level);
        const std::vector<LobeSample> lobe = sampleLobe(glsl::prefilteredAlpha(side, level), samplesOf(level), side, last);
        const glsl::ivec2 corner(glsl::pyramidLevelCorner(side, level));
        const auto texel = [&](glsl::ivec2 p) -> float* {
            return reinterpret_cast<float*>(atlas->data(unsigned(corner.x + 1 + p.x), unsigned(corner.y + 1 + p.y)));
        };
        for (int y = 0; y < s; ++y)
            for (int x = 0; x < s; ++x) {
                const osg::Vec3f mean =
                    filtered(levels, lobe, glsl::directionFromOctahedral((glsl::vec2(x, y) + 0.5) / double(s)));
                std::copy_n(mean.ptr(), 3, texel({x, y}));
            }
        for (int i = -1; i <= s; ++i)
            for (const glsl::ivec2 p : {glsl::ivec2(i, -1), glsl::ivec2(i, s), glsl::ivec2(-1, i), glsl::ivec2(s, i)})
                std::copy_n(texel(glsl::foldedTexel(p, s)), 3, texel(p));
    }
    return atlas;
}

}  // namespace osgEnvLight

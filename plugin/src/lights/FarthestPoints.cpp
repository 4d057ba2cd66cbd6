// SPDX-License-Identifier: MIT
#include "lights/FarthestPoints.h"

#include <algorithm>
#include <cmath>

namespace osgEnvLight
{

namespace
{

const size_t length = 32;  // texels of a segment
const size_t lanes = 8;    // compared at a time
// Beyond any squared chord: nothing is chosen yet, and the radiance, scaled to below 1, says where to begin.
const float unseen = 8.0f;

}  // namespace

FarthestPoints::FarthestPoints(const LightTexels& texels, const TexelGroup& group, const std::vector<osg::Vec3d>& taken)
    : _texels(texels), _segments((size_t(texels.width()) + length - 1) / length), _stride(_segments * length)
{
    const size_t padded = _stride * size_t(texels.height());
    for (std::vector<float>* v : {&_x, &_y, &_z}) v->assign(padded, 0.0f);
    _chord.assign(padded, -1.0f);
    std::vector<unsigned> nearest(texels.size(), 0);
    findNearest(texels, group, taken, 0, nearest);
    double brightest = 0.0;
    for (size_t i = 0; i < texels.size(); ++i)
        if (group.has(i)) brightest = std::max(brightest, texels.deciding(i) / texels.solidAngle(i));
    const size_t width = size_t(texels.width());
    for (size_t row = 0; row < size_t(texels.height()); ++row) {
        std::copy_n(texels.x() + row * width, width, &_x[row * _stride]);
        std::copy_n(texels.y() + row * width, width, &_y[row * _stride]);
        std::copy_n(texels.z() + row * width, width, &_z[row * _stride]);
        for (size_t i = row * width; i < (row + 1) * width; ++i) {
            if (!group.has(i)) continue;
            _chord[i + row * (_stride - width)] = taken.empty()
                                                      ? unseen + float(texels.deciding(i) / texels.solidAngle(i) / brightest)
                                                      : float((texels.direction(i) - taken[nearest[i]]).length2());
        }
    }
    _greatest.resize(_segments * size_t(texels.height()));
    for (size_t s = 0; s < _greatest.size(); ++s) findGreatest(s);
}

size_t FarthestPoints::next()
{
    const size_t segment = size_t(std::max_element(_greatest.begin(), _greatest.end()) - _greatest.begin());
    const auto begin = _chord.begin() + long(segment * length);
    const size_t chosen = size_t(std::max_element(begin, begin + long(length)) - _chord.begin());
    approach(chosen, _chord[chosen]);
    // Below that of any texel that is left, even one in the same place in single precision.
    _chord[chosen] = -1.0f;
    findGreatest(segment);
    return chosen / _stride * size_t(_texels.width()) + chosen % _stride;
}

// Visits what is nearer to the chosen texel than the greatest distance: rows within that angle, and of those the columns
// between the meridians that touch the cap.
void FarthestPoints::approach(size_t chosen, float farthest)
{
    const int width = _texels.width();
    const int height = _texels.height();
    const double angle = 2.0 * std::asin(std::min(1.0, 0.5 * std::sqrt(double(farthest))));
    const double row = double(chosen / _stride) + 0.5;
    const double theta = osg::PI * row / height;
    const double rows = angle * height / osg::PI + 1.0;
    const bool pole = theta - angle <= 0.0 || theta + angle >= osg::PI;
    const double turn = pole ? osg::PI : std::asin(std::min(1.0, std::sin(angle) / std::sin(theta)));
    const int reach = int(std::min(turn / (2.0 * osg::PI) * width + 2.0, double(width)));
    const int x = int(chosen % _stride);
    for (int y = std::max(0, int(row - rows)); y < std::min(double(height), row + rows); ++y) {
        if (2 * reach + 1 >= width) {
            approachRow(y, 0, width, chosen);
            continue;
        }
        approachRow(y, std::max(x - reach, 0), std::min(x + reach + 1, width), chosen);
        if (x < reach) approachRow(y, x - reach + width, width, chosen);
        if (x + reach >= width) approachRow(y, 0, x + reach + 1 - width, chosen);
    }
}

void FarthestPoints::approachRow(int y, int x0, int x1, size_t chosen)
{
    const float cx = _x[chosen];
    const float cy = _y[chosen];
    const float cz = _z[chosen];
    const size_t first = size_t(y) * _segments + size_t(x0) / length;
    const size_t last = size_t(y) * _segments + (size_t(x1) - 1) / length;
    for (size_t s = first; s <= last; ++s) {
        if (_greatest[s] <= 0.0f) continue;
        for (size_t p = s * length; p < (s + 1) * length; ++p) {
            const float dx = _x[p] - cx;
            const float dy = _y[p] - cy;
            const float dz = _z[p] - cz;
            const float chord = dx * dx + dy * dy + dz * dz;
            _chord[p] = chord < _chord[p] ? chord : _chord[p];
        }
        findGreatest(s);
    }
}

void FarthestPoints::findGreatest(size_t segment)
{
    const float* c = &_chord[segment * length];
    float greatest[lanes];
    std::copy_n(c, lanes, greatest);
    for (size_t p = lanes; p < length; p += lanes)
        for (size_t k = 0; k < lanes; ++k) greatest[k] = c[p + k] > greatest[k] ? c[p + k] : greatest[k];
    _greatest[segment] = *std::max_element(greatest, greatest + lanes);
}

}  // namespace osgEnvLight

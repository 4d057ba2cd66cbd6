// SPDX-License-Identifier: MIT
#include "shadow/SunShadows.h"

#include "lights/MapTextures.h"

#include <algorithm>
#include <cmath>

#include "glsl.h"

namespace osgEnvLight
{

namespace
{

const double coarsest = 1.0;     // pixels of the view that a texel may be wide
const double narrowest = 0.125;  // of a level's width, that the next has at least
const double spare = 1.25;       // a level's side, in sides of what it must show: how far the view may wander

// Up to which depth texels are wider than the view's pixels ask for; 0 where none are.
double depthOfWideTexels(double texel, const ShadowView& view, const VisibleBoxes& boxes)
{
    const double at0 = view.footprint(0.0), at1 = view.footprint(1.0);
    const double slope = at1 - at0;
    if (!(slope > 1e-9 * at1)) return at0 * coarsest < texel ? boxes.farthest() : 0.0;
    return std::min((texel / coarsest - at0) / slope, boxes.farthest());
}

// The wanted side as the next power of two of the whole's, so that a view that comes nearer does not fit a map in every frame.
double level(double wanted, double whole)
{
    return whole * std::exp2(std::min(std::ceil(std::log2(std::max(wanted / whole, 1e-6))), 0.0));
}

// The first two axes' bounds, without extent along the third.
template <class Corners>
osg::BoundingBoxd rectangleOf(const std::array<osg::Vec3d, 3>& axes, const Corners& corners)
{
    osg::BoundingBoxd r;
    for (const osg::Vec3d& c : corners) r.expandBy(osg::Vec3d(c * axes[0], c * axes[1], 0.0));
    return r;
}

std::vector<osg::Vec3d> cornersOf(const osg::BoundingBoxd& box)
{
    std::vector<osg::Vec3d> corners;
    for (unsigned i = 0; i < 8; ++i) corners.push_back(box.corner(i));
    return corners;
}

osg::Vec2d sidesOf(const osg::BoundingBoxd& r)
{
    return {r.xMax() - r.xMin(), r.yMax() - r.yMin()};
}

// Of a level that shows the rectangle with room to wander.
osg::Vec2d sidesFor(const osg::BoundingBoxd& needed, const osg::Vec2d& whole)
{
    return {level(spare * sidesOf(needed).x(), whole.x()), level(spare * sidesOf(needed).y(), whole.y())};
}

// By area: the map of a long street is made shorter before it is made narrower.
bool isFiner(const osg::Vec2d& sides, const osg::Vec2d& former, double narrowing)
{
    const double most = narrowing * narrowing * (1.0 + 1e-9) * former.x() * former.y();
    return sides.x() <= former.x() && sides.y() <= former.y() && sides.x() * sides.y() <= most;
}

// Axes about the direction in which the box has the least bound: a low sun sees a floor as a narrow strip, and texels as
// narrow are what its long shadows need.
std::array<osg::Vec3d, 3> narrowestAxes(const osg::BoundingBoxd& box, const osg::Vec3d& direction)
{
    const glsl::mat3 frame = glsl::frameAround(glsl::vec3(direction.x(), direction.y(), direction.z()));
    const osg::Vec3d t(frame[0].x, frame[0].y, frame[0].z), b(frame[1].x, frame[1].y, frame[1].z);
    const int steps = 64;
    std::array<osg::Vec3d, 3> best;
    double least = 1e300;
    for (int i = 0; i < steps; ++i) {
        const double turn = 0.5 * glsl::PI * i / steps;
        const std::array<osg::Vec3d, 3> axes = {t * std::cos(turn) + b * std::sin(turn), b * std::cos(turn) - t * std::sin(turn),
                                                direction};
        const osg::Vec2d sides = sidesOf(rectangleOf(axes, cornersOf(box)));
        if (sides.x() * sides.y() >= least) continue;
        least = sides.x() * sides.y();
        best = axes;
    }
    return best;
}

}  // namespace

SunShadows::SunShadows(unsigned sunCount, unsigned levelCount, unsigned mapSize)
    : suns(sunCount), levels(levelCount), size(mapSize), _suns(sunCount), _targets(size, levels, suns, 1, GL_RG32F, GL_R32F)
{
}

unsigned SunShadows::sizeOf(unsigned maps, unsigned wanted)
{
    const unsigned most = 4;
    if (maps <= most) return wanted;
    return std::max(unsigned(wanted * std::sqrt(double(most) / maps)) / 16 * 16, 64u);
}

unsigned SunShadows::wantedLevels(const osg::BoundingBoxd& scene, const ShadowView& view, const VisibleBoxes& boxes,
                                  unsigned size)
{
    if (boxes.empty()) return 1;
    const double wide = diagonal(scene) / size / (coarsest * view.footprint(boxes.nearest()));
    const double finer = std::ceil(std::log2(std::max(wide, 1.0)));
    return 1 + unsigned(std::min(finer, double(maximumLevels - 1)));
}

// The bound stays while it fits: a caster that wanders within it moves no map.
bool SunShadows::fitScene(const osg::BoundingBoxd& bound)
{
    if (!bound.valid() || (contains(_box, bound) && diagonal(bound) > 0.5 * diagonal(_box))) return false;
    const double margin = 0.02 * diagonal(bound);
    const osg::Vec3d more(margin, margin, margin);
    _box = osg::BoundingBoxd(bound._min - more, bound._max + more);
    _targets.origin = _box.center();  // floats about it keep their digits
    return true;
}

void SunShadows::place(Sun& sun, const osg::Vec3d& direction) const
{
    sun.axes = narrowestAxes(_box, direction);
    sun.low = 1e300;
    sun.high = -1e300;
    for (const osg::Vec3d& c : cornersOf(_box)) {
        const double height = (c - _targets.origin) * sun.axes[2];
        sun.low = std::min(sun.low, height);
        sun.high = std::max(sun.high, height);
    }
    const double margin = 1e-3 * (sun.high - sun.low);
    sun.low -= margin;
    sun.high += margin;
    sun.rectangles = {};
    sun.lost = true;
}

bool SunShadows::Rectangle::contains(const osg::BoundingBoxd& r) const
{
    const osg::Vec2d half = sides * 0.5;
    return r.xMin() >= center.x() - half.x() && r.xMax() <= center.x() + half.x() && r.yMin() >= center.y() - half.y() &&
           r.yMax() <= center.y() + half.y();
}

SunShadows::Rectangle SunShadows::snapped(const osg::BoundingBoxd& needed, const osg::Vec2d& sides) const
{
    const osg::Vec2d texel = sides / size;
    return {osg::Vec2d(std::round(needed.center().x() / texel.x()) * texel.x(),
                       std::round(needed.center().y() / texel.y()) * texel.y()),
            sides};
}

// The finest level is to have the view's pixels where that begins to show much. In steps, so that no view that wanders redraws
// all.
void SunShadows::fitNarrowing(const ShadowView& view)
{
    if (!(view.nearDepth > 0.0) || levels < 2) return;
    const double finest = coarsest * view.footprint(view.nearDepth) * size / diagonal(_box);
    const double wanted = std::clamp(std::pow(finest, 1.0 / (levels - 1)), narrowest, 0.5);
    if (std::abs(std::log2(wanted / _narrowing)) > 0.4) _narrowing = std::exp2(0.5 * std::round(2.0 * std::log2(wanted)));
}

void SunShadows::fitLevels(const Sun& sun, const ShadowView& view, const VisibleBoxes& boxes, Rectangles& rectangles) const
{
    const osg::BoundingBoxd scene = rectangleOf(sun.axes, cornersOf(_box));
    Rectangle& whole = rectangles[0];
    if (!whole.exists()) whole = snapped(scene, sidesOf(scene) * (1.0 + 4.0 / size));
    for (unsigned i = 1; i < levels; ++i) {
        const Rectangle& former = rectangles[i - 1];
        const osg::BoundingBoxd needed = nearPart(sun, view, boxes, whole, former);
        Rectangle& own = rectangles[i];
        if (!needed.valid() || !former.exists()) {
            own = Rectangle();
            continue;
        }
        const osg::Vec2d sides = sidesFor(needed, whole.sides);
        const bool stays =
            isFiner(own.sides, former.sides, _narrowing) && own.area() <= 2.0 * sides.x() * sides.y() && own.contains(needed);
        if (!stays) own = snapped(needed, sides);
    }
}

// Of what the view shows, as much of that for which the former's texels are too wide as fits into a finer map; not valid where
// nothing is.
osg::BoundingBoxd SunShadows::nearPart(const Sun& sun, const ShadowView& view, const VisibleBoxes& boxes, const Rectangle& whole,
                                       const Rectangle& former) const
{
    const osg::BoundingBoxd scene = rectangleOf(sun.axes, cornersOf(_box));
    double near = boxes.nearest(), far = depthOfWideTexels(former.texel(size), view, boxes);
    osg::BoundingBoxd part;
    for (int step = 0; far > near && step < 8; ++step) {
        const double depth = step == 0 ? far : 0.5 * (near + far);
        const osg::BoundingBoxd r = boxes.rectangle(sun.axes, depth).intersect(scene);
        const bool fits = isFiner(sidesFor(r, whole.sides), former.sides, _narrowing);
        (fits ? near : far) = depth;
        if (fits) part = r;
    }
    return part;
}

ShadowRefresh SunShadows::refresh(unsigned index, unsigned level, const ChangedPart& changed) const
{
    const Sun& sun = _suns[index];
    const Rectangle& r = sun.rectangles[level];
    const double depth = 0.5 * (sun.high - sun.low);
    const double center[] = {r.center.x() - _targets.origin * sun.axes[0], r.center.y() - _targets.origin * sun.axes[1],
                             0.5 * (sun.low + sun.high)};
    const double scale[] = {2.0 / r.sides.x(), 2.0 / r.sides.y(), -1.0 / depth};
    osg::Matrixd m;
    for (int column = 0; column < 3; ++column) {
        for (int row = 0; row < 3; ++row) m(row, column) = sun.axes[size_t(column)].ptr()[row] * scale[column];
        m(3, column) = -center[column] * scale[column];
    }
    const float texel = float(r.texel(size) / (sun.high - sun.low));
    return {index * levels + level, m, texel, 0.0f, regionOf(changed, m, _targets.origin, size)};
}

std::vector<ShadowRefresh> SunShadows::update(const CasterList& casters, const DominantLights& list, const ShadowView& view,
                                              const VisibleBoxes& boxes)
{
    double texel = _box.valid() ? diagonal(_box) / size : 0.0;
    for (const Sun& sun : _suns)
        for (const Rectangle& r : sun.rectangles)
            if (r.exists()) texel = std::min({texel, r.sides.x() / size, r.sides.y() / size});
    const bool moved = _casters.take(casters, 0.02 * texel);
    const bool fitted = moved && fitScene(casters.bound);
    const bool lost = _lost.exchange(false);
    std::vector<ShadowRefresh> refreshes;
    bool changed = fitted;
    if (_box.valid()) fitNarrowing(view);
    for (unsigned i = 0; i < suns && _box.valid(); ++i) {
        Sun& sun = _suns[i];
        // A quarter of a texel of the whole scene's.
        const bool turned = (list[i].direction - sun.axes[2]).length() > 0.25 / size;
        if (fitted || turned) place(sun, list[i].direction);
        const Rectangles former = sun.rectangles;
        fitLevels(sun, view, boxes, sun.rectangles);
        for (unsigned k = 0; k < levels; ++k) {
            const bool same = sun.rectangles[k] == former[k];
            changed = changed || !same;
            const bool anew = lost || sun.lost || !same;
            if (!sun.rectangles[k].exists() || !(moved || anew)) continue;
            const ShadowRefresh part = refresh(i, k, anew ? ChangedPart::everything() : _casters.changed());
            if (!part.region.isEmpty()) refreshes.push_back(part);
        }
        sun.lost = false;
    }
    if (changed) ++_version;
    _drawn = unsigned(refreshes.size());
    return refreshes;
}

void SunShadows::setUniforms(osg::StateSet& stateSet) const
{
    const auto array = [&](const char* name, osg::Uniform::Type type, unsigned elements) {
        return stateSet.getOrCreateUniform(name, type, elements);
    };
    osg::Uniform* axes = array("sunAxes", osg::Uniform::FLOAT_VEC3, 3 * MapTextures::maximumSuns);
    osg::Uniform* heights = array("sunHeights", osg::Uniform::FLOAT_VEC2, MapTextures::maximumSuns);
    osg::Uniform* places = array("sunLevels", osg::Uniform::FLOAT_VEC4, maximumLevels * MapTextures::maximumSuns);
    array("sunShadowLevels", osg::Uniform::INT, 1)->set(int(levels));
    array("sunMapSize", osg::Uniform::INT, 1)->set(int(size));
    for (unsigned i = 0; i < suns; ++i) {
        const Sun& sun = _suns[i];
        for (unsigned k = 0; k < 3; ++k) axes->setElement(3 * i + k, osg::Vec3f(sun.axes[k]));
        heights->setElement(i, osg::Vec2f(float(sun.low), float(sun.high)));
        for (unsigned k = 0; k < maximumLevels; ++k) {
            const Rectangle& r = sun.rectangles[k];
            const osg::Vec2d scale = r.exists() ? osg::Vec2d(size / r.sides.x(), size / r.sides.y()) : osg::Vec2d();
            const osg::Vec2d center = r.center - osg::Vec2d(_targets.origin * sun.axes[0], _targets.origin * sun.axes[1]);
            places->setElement(maximumLevels * i + k,
                               osg::Vec4f(float(scale.x()), float(scale.y()), float(0.5 * size - center.x() * scale.x()),
                                          float(0.5 * size - center.y() * scale.y())));
        }
    }
}

void SunShadows::resizeGLObjectBuffers(unsigned maximum)
{
    _targets.resizeGLObjectBuffers(maximum);
}

void SunShadows::releaseGLObjects(osg::State* state) const
{
    _targets.releaseGLObjects(state);
    _lost = true;
}

size_t SunShadows::bytes() const
{
    const size_t map = size_t(size) * size;
    return 8 * map * levels * suns + (4 + 4 + 4) * map;
}

}  // namespace osgEnvLight

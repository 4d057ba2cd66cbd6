// SPDX-License-Identifier: MIT
#include "surface/StaticCasters.h"

#include "surface/CoarseMesh.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <unordered_map>
#include <utility>

namespace osgEnvLight
{

namespace
{

using Triangle = std::array<unsigned, 3>;

// The bits of a number below 1024, two apart.
uint32_t spread(uint32_t x)
{
    x = (x | x << 16) & 0x30000ffu;
    x = (x | x << 8) & 0x300f00fu;
    x = (x | x << 4) & 0x30c30c3u;
    return (x | x << 2) & 0x9249249u;
}

// Along a curve that visits neighbouring places one after another [Morton 1966].
void sortByPlace(std::vector<Triangle>& triangles, const osg::Vec3Array& vertices)
{
    osg::BoundingBox box;
    for (const osg::Vec3& v : vertices) box.expandBy(v);
    const osg::Vec3 sides = box._max - box._min;
    const auto cell = [&](const osg::Vec3& p) {
        uint32_t place = 0;
        for (int i = 0; i < 3; ++i)
            place |= spread(uint32_t(std::clamp(1024.0f * (p[i] - box._min[i]) / std::max(sides[i], 1e-30f), 0.0f, 1023.0f)))
                     << i;
        return place;
    };
    std::vector<std::pair<uint32_t, Triangle>> places;
    places.reserve(triangles.size());
    for (const Triangle& t : triangles) places.emplace_back(cell((vertices[t[0]] + vertices[t[1]] + vertices[t[2]]) / 3.0f), t);
    std::sort(places.begin(), places.end());
    for (size_t i = 0; i < triangles.size(); ++i) triangles[i] = places[i].second;
}

}  // namespace

// Where casters stand in the order that they had.
class StaticCasters::FormerPlaces
{
  public:
    explicit FormerPlaces(const std::vector<Still>& former) : _former(former) {}

    /** From a place on; all of them: it is not there. Made when first asked, and by hash: many that move among many that stand
     * still would take a time that grows with the product. */
    size_t find(const Caster& caster, size_t from)
    {
        if (_places.empty())
            for (size_t i = 0; i < _former.size(); ++i) _places.emplace(hash(_former[i].caster), i);
        size_t found = _former.size();
        const auto [first, last] = _places.equal_range(hash(caster));
        for (auto it = first; it != last; ++it)
            if (it->second >= from && sameShadow(_former[it->second].caster, caster, 0.0)) found = std::min(found, it->second);
        return found;
    }

  private:
    static size_t hash(const Caster& caster)
    {
        size_t value = std::hash<const void*>()(caster.geometry.get());
        for (int i = 0; i < 4; ++i)
            for (int k = 0; k < 3; ++k) value = 31 * value + std::hash<double>()(caster.worldFromModel(i, k));
        return value;
    }

    const std::vector<Still>& _former;
    std::unordered_multimap<size_t, size_t> _places;  // by hash
};

void StaticCasters::setPlace(const osg::Vec3d& origin, double cell)
{
    if (origin == _origin && cell > 0.5 * _cell && cell < 2.0 * _cell) return;
    _origin = origin;
    _cell = cell;
    _still.clear();
    _perforated = 0;
    _isBuilt = false;
}

void StaticCasters::update(const CasterList& casters, bool moved, double slack)
{
    _frames = moved ? 0 : _frames + 1;
    const bool merges = !_isBuilt || (!noneMoves() && _frames == patience);
    if (merges || moved) sort(casters.all, merges, slack);
    if (casters.version == 0 || casters.version != _seen) takeSentLight(casters.all);
    _seen = casters.version;
}

// Those that are merged are some of the casters, in their order.
void StaticCasters::takeSentLight(const std::vector<Caster>& casters)
{
    size_t next = 0;
    bool changed = false;
    for (const Caster& caster : casters) {
        if (next == _still.size()) break;
        Caster& still = _still[next].caster;
        if (caster.geometry != still.geometry || caster.state != still.state) continue;
        ++next;
        if (caster.sent == still.sent) continue;
        still.sent = caster.sent;
        changed = true;
    }
    if (changed) ++_sentVersion;
}

StaticCasters::Parts StaticCasters::parts() const
{
    Parts parts;
    for (const Still& still : _still) parts.push_back({still.mesh, still.caster.sent});
    return parts;
}

// Both lists have one order, but some of either are not in the other; the former meshes serve on.
void StaticCasters::sort(const std::vector<Caster>& casters, bool merges, double slack)
{
    std::vector<Still> former;
    former.swap(_still);
    _loose.clear();
    _perforated = 0;
    size_t next = 0;
    FormerPlaces places(former);
    for (const Caster& caster : casters) {
        if (caster.moves) {
            _loose.push_back(caster);
            continue;
        }
        size_t found = next;
        if (found == former.size() || !sameShadow(former[found].caster, caster, slack)) found = places.find(caster, next);
        if (found < former.size()) {
            _still.push_back(std::move(former[found]));
            next = found + 1;
        } else if (merges) {
            _still.push_back({caster, std::make_shared<CasterMesh>(coarseMesh(caster, _origin, _cell))});
        } else {
            _loose.push_back(caster);
            continue;
        }
        if (!caster.state) continue;
        _loose.push_back(caster);
        ++_perforated;
    }
    if (merges || _still.size() != former.size()) build();
}

// All draw from one array of vertices.
void StaticCasters::build()
{
    ++_generation;
    _isBuilt = true;
    _merged.clear();
    osg::ref_ptr<osg::Vec3Array> vertices = new osg::Vec3Array;
    std::vector<Triangle> triangles;
    for (const Still& still : _still) {
        if (still.caster.state) continue;
        const auto base = unsigned(vertices->size());
        vertices->insert(vertices->end(), still.mesh->positions.begin(), still.mesh->positions.end());
        for (const auto& t : still.mesh->triangles) triangles.push_back({base + t[0], base + t[1], base + t[2]});
    }
    const size_t parts = (triangles.size() + mostTriangles - 1) / mostTriangles;
    if (parts > 1) sortByPlace(triangles, *vertices);
    for (size_t i = 0; i < parts; ++i) {
        const auto begin = triangles.begin() + std::ptrdiff_t(triangles.size() * i / parts);
        const auto end = triangles.begin() + std::ptrdiff_t(triangles.size() * (i + 1) / parts);
        osg::ref_ptr<osg::DrawElementsUInt> indices = new osg::DrawElementsUInt(GL_TRIANGLES);
        osg::BoundingBox box;
        for (auto t = begin; t != end; ++t)
            for (unsigned v : *t) {
                indices->push_back(v);
                box.expandBy((*vertices)[v]);
            }
        osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
        geometry->setVertexArray(vertices);
        geometry->addPrimitiveSet(indices);
        geometry->setUseDisplayList(false);
        geometry->setUseVertexBufferObjects(true);
        geometry->setInitialBound(box);  // of these vertices, not of all
        geometry->setComputeBoundingBoxCallback(new osg::Drawable::ComputeBoundingBoxCallback);
        _merged.push_back(geometry);
    }
}

std::vector<Caster> StaticCasters::drawn() const
{
    std::vector<Caster> result;
    for (const auto& geometry : _merged) result.push_back({geometry, osg::Matrixd::translate(_origin), nullptr, 0});
    result.insert(result.end(), _loose.begin(), _loose.end());
    return result;
}

double StaticCasters::shareShown(const osg::Matrixd& projection) const
{
    size_t shown = 0, all = 0;
    for (const auto& geometry : _merged) {
        const size_t indices = geometry->getPrimitiveSet(0)->getNumIndices();
        all += indices;
        if (mapShows(projection, osg::BoundingBoxd(geometry->getBoundingBox()))) shown += indices;
    }
    return all > 0 ? double(shown) / double(all) : 0.0;
}

size_t StaticCasters::bytes() const
{
    size_t sum = _merged.empty() ? 0 : _merged[0]->getVertexArray()->getTotalDataSize();
    for (const auto& geometry : _merged) sum += 4 * geometry->getPrimitiveSet(0)->getNumIndices();
    return sum;
}

void StaticCasters::resizeGLObjectBuffers(unsigned maximum) const
{
    for (const auto& geometry : _merged) geometry->resizeGLObjectBuffers(maximum);
}

void StaticCasters::releaseGLObjects(osg::State* state) const
{
    for (const auto& geometry : _merged) geometry->releaseGLObjects(state);
}

}  // namespace osgEnvLight

// SPDX-License-Identifier: MIT
#include "surface/StaticCasters.h"

#include "surface/CoarseMesh.h"

#include <algorithm>
#include <functional>
#include <unordered_map>

namespace osgEnvLight
{

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
    _geometry = nullptr;
}

void StaticCasters::update(const CasterList& casters, bool moved, double slack)
{
    _frames = moved ? 0 : _frames + 1;
    const bool merges = !_geometry || (!noneMoves() && _frames == patience);
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

void StaticCasters::build()
{
    ++_generation;
    osg::ref_ptr<osg::Vec3Array> vertices = new osg::Vec3Array;
    osg::ref_ptr<osg::DrawElementsUInt> indices = new osg::DrawElementsUInt(GL_TRIANGLES);
    for (const Still& still : _still) {
        if (still.caster.state) continue;
        const auto base = unsigned(vertices->size());
        vertices->insert(vertices->end(), still.mesh->positions.begin(), still.mesh->positions.end());
        for (const auto& triangle : still.mesh->triangles)
            for (unsigned v : triangle) indices->push_back(base + v);
    }
    _geometry = new osg::Geometry;
    _geometry->setVertexArray(vertices);
    _geometry->addPrimitiveSet(indices);
    _geometry->setUseDisplayList(false);
    _geometry->setUseVertexBufferObjects(true);
}

std::vector<Caster> StaticCasters::drawn() const
{
    std::vector<Caster> result;
    if (_geometry && _geometry->getPrimitiveSet(0)->getNumIndices() > 0)
        result.push_back({_geometry, osg::Matrixd::translate(_origin), nullptr, 0});
    result.insert(result.end(), _loose.begin(), _loose.end());
    return result;
}

size_t StaticCasters::bytes() const
{
    if (!_geometry) return 0;
    return _geometry->getVertexArray()->getTotalDataSize() + 4 * _geometry->getPrimitiveSet(0)->getNumIndices();
}

void StaticCasters::resizeGLObjectBuffers(unsigned maximum) const
{
    if (_geometry) _geometry->resizeGLObjectBuffers(maximum);
}

void StaticCasters::releaseGLObjects(osg::State* state) const
{
    if (_geometry) _geometry->releaseGLObjects(state);
}

}  // namespace osgEnvLight

// SPDX-License-Identifier: MIT
#include "surface/StaticCasters.h"

#include "surface/CoarseMesh.h"

#include <algorithm>

namespace osgEnvLight
{

void StaticCasters::setPlace(const osg::Vec3d& origin, double cell)
{
    if (origin == _origin && cell > 0.5 * _cell && cell < 2.0 * _cell) return;
    _origin = origin;
    _cell = cell;
    _still.clear();
    _geometry = nullptr;
}

void StaticCasters::update(const std::vector<Caster>& casters, bool moved, double slack)
{
    _frames = moved ? 0 : _frames + 1;
    const bool merges = !_geometry || (!noneMoves() && _frames == patience);
    if (merges || moved) sort(casters, merges, slack);
    takeSentLight(casters);
}

size_t StaticCasters::countPerforated() const
{
    return size_t(std::count_if(_still.begin(), _still.end(), [](const Still& s) { return s.caster.state.valid(); }));
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

// Both lists have one order; the former meshes serve on.
void StaticCasters::sort(const std::vector<Caster>& casters, bool merges, double slack)
{
    std::vector<Still> former;
    former.swap(_still);
    _loose.clear();
    size_t next = 0;
    for (const Caster& caster : casters) {
        if (caster.moves) {
            _loose.push_back(caster);
            continue;
        }
        size_t found = next;
        while (found < former.size() && !sameShadow(former[found].caster, caster, slack)) ++found;
        if (found < former.size()) {
            _still.push_back(std::move(former[found]));
            next = found + 1;
        } else if (merges) {
            _still.push_back({caster, std::make_shared<CasterMesh>(coarseMesh(caster, _origin, _cell))});
        } else {
            _loose.push_back(caster);
            continue;
        }
        if (caster.state) _loose.push_back(caster);
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

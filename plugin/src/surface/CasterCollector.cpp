// SPDX-License-Identifier: MIT
#include "surface/CasterCollector.h"

#include <osg/Billboard>
#include <osg/Camera>
#include <osg/Projection>
#include <osgUtil/CullVisitor>
#include <osgUtil/StateGraph>

#include <algorithm>
#include <cmath>
#include <set>

namespace osgEnvLight
{

namespace
{

bool hasSurfaces(const osg::Geometry& geometry)
{
    for (unsigned i = 0; i < geometry.getNumPrimitiveSets(); ++i) {
        const GLenum mode = geometry.getPrimitiveSet(i)->getMode();
        if (mode != GL_POINTS && mode != GL_LINES && mode != GL_LINE_STRIP && mode != GL_LINE_LOOP) return true;
    }
    return false;
}

// The state sets above the node, and its own.
MovingStates::Path pathTo(osgUtil::CullVisitor& cv)
{
    MovingStates::Path path;
    for (const osgUtil::StateGraph* graph = cv.getCurrentStateGraph(); graph; graph = graph->_parent)
        if (graph->getStateSet()) path.push_back(graph->getStateSet());
    std::reverse(path.begin(), path.end());
    return path;
}

// What they say of all below the node.
CasterState stateOf(const MovingStates::Path& path, SurfaceFacts* facts)
{
    CasterState state(facts);
    for (const osg::StateSet* s : path) state.merge(*s);
    state.enterNode();
    return state;
}

}  // namespace

CasterCollector::CasterCollector(osgUtil::CullVisitor& cv, const osg::Matrixd& worldFromEye, StateSets& stateSets,
                                 SurfaceFacts* facts)
    : osg::NodeVisitor(osg::NodeVisitor::NODE_VISITOR, osg::NodeVisitor::TRAVERSE_ACTIVE_CHILDREN),
      osg::CullStack(cv),  // not made anew, which reads the environment's variables and, at INFO, prints that in every frame
      _worldFromEye(worldFromEye),
      _stateSets(stateSets),
      _path(pathTo(cv))
{
    _states.push_back(stateOf(_path, facts));
    setTraversalMask(cv.getTraversalMask());
    setNodeMaskOverride(cv.getNodeMaskOverride());
    setFrameStamp(const_cast<osg::FrameStamp*>(cv.getFrameStamp()));
    setTraversalNumber(cv.getTraversalNumber());
    setCullingMode(osg::CullSettings::NO_CULLING);
    setLODScale(cv.getLODScale());
    pushViewport(cv.getViewport());
    pushProjectionMatrix(cv.getProjectionMatrix());
    pushModelViewMatrix(cv.getModelViewMatrix(), osg::Transform::ABSOLUTE_RF);
}

std::vector<Caster> CasterCollector::collect(osg::Group& group)
{
    for (unsigned i = 0; i < group.getNumChildren(); ++i) group.getChild(i)->accept(*this);
    return std::move(_casters);
}

void CasterCollector::forgetUnused(StateSets& stateSets, const std::vector<Caster>& casters)
{
    if (stateSets.perforated.empty() && stateSets.moving.empty()) return;
    std::set<const osg::StateSet*> used;
    for (const Caster& caster : casters) used.insert(caster.state.get());
    for (auto it = stateSets.perforated.begin(); it != stateSets.perforated.end();)
        it = used.count(it->second.get()) ? std::next(it) : stateSets.perforated.erase(it);
    stateSets.moving.forgetUnused(used);
}

float CasterCollector::getDistanceToEyePoint(const osg::Vec3& pos, bool withLODScale) const
{
    return (pos - getEyeLocal()).length() * (withLODScale ? getLODScale() : 1.0f);
}

float CasterCollector::getDistanceToViewPoint(const osg::Vec3& pos, bool withLODScale) const
{
    return (pos - getViewPointLocal()).length() * (withLODScale ? getLODScale() : 1.0f);
}

float CasterCollector::getDistanceFromEyePoint(const osg::Vec3& pos, bool withLODScale) const
{
    const osg::Matrixd& m = *const_cast<CasterCollector*>(this)->getModelViewMatrix();
    const double z = double(pos.x()) * m(0, 2) + double(pos.y()) * m(1, 2) + double(pos.z()) * m(2, 2) + m(3, 2);
    return float(-z) * (withLODScale ? getLODScale() : 1.0f);
}

void CasterCollector::push(const osg::StateSet* stateSet)
{
    if (!stateSet) return;
    _states.push_back(_states.back());
    _states.back().merge(*stateSet);
    _path.push_back(stateSet);
}

void CasterCollector::pop(const osg::StateSet* stateSet)
{
    if (!stateSet) return;
    _states.pop_back();
    _path.pop_back();
}

void CasterCollector::traverseWith(const osg::StateSet* stateSet, osg::Node& node)
{
    push(stateSet);
    traverse(node);
    pop(stateSet);
}

void CasterCollector::apply(osg::Node& node)
{
    traverseWith(node.getStateSet(), node);
}

void CasterCollector::apply(osg::Transform& node)
{
    osg::ref_ptr<osg::RefMatrix> matrix = new osg::RefMatrix(*getModelViewMatrix());
    node.computeLocalToWorldMatrix(*matrix, this);
    pushModelViewMatrix(matrix.get(), node.getReferenceFrame());
    traverseWith(node.getStateSet(), node);
    popModelViewMatrix();
}

// As the view turns it.
void CasterCollector::apply(osg::Billboard& node)
{
    const osg::Vec3 eye = getEyeLocal();
    for (unsigned i = 0; i < node.getNumDrawables(); ++i) {
        const osg::Geometry* geometry = node.getDrawable(i)->asGeometry();
        if (!geometry) continue;
        osg::Matrixd matrix(*getModelViewMatrix());
        node.computeMatrix(matrix, eye, node.getPosition(i));
        const osg::StateSet* of[] = {static_cast<const osg::Node&>(node).getStateSet(), geometry->getStateSet()};
        for (const osg::StateSet* s : of) push(s);
        add(*geometry, matrix);
        for (const osg::StateSet* s : of) pop(s);
    }
}

void CasterCollector::apply(osg::Geometry& geometry)
{
    push(geometry.getStateSet());
    add(geometry, *getModelViewMatrix());
    pop(geometry.getStateSet());
}

void CasterCollector::add(const osg::Geometry& geometry, const osg::Matrixd& eyeFromModel)
{
    const CasterState& state = _states.back();
    if (!state.casts(&geometry) || !hasSurfaces(geometry)) return;
    Caster caster{&geometry, eyeFromModel * _worldFromEye, nullptr,
                  geometry.getVertexArray() ? geometry.getVertexArray()->getModifiedCount() : 0};
    if (state.movingProgram()) {
        caster.moves = true;
        caster.state = _stateSets.moving.get(_path, state, geometry);
        caster.shape += _stateSets.moving.change(_path, *state.movingProgram(), getTraversalNumber());
        _casters.push_back(caster);
        return;
    }
    if (state.perforated(geometry)) {
        osg::ref_ptr<osg::StateSet>& shared = _stateSets.perforated[state.key(geometry)];
        if (!shared) shared = state.makeStateSet(geometry);
        caster.state = shared;
    }
    if (_findsSentLight) {
        caster.sent = state.sentLight(geometry, _displayColors);
        if (caster.state) caster.sent.opacity = state.opacity();
    }
    const osg::Vec3f lamp = state.lampEmission(_lampRule);
    if (lamp != osg::Vec3f() && !state.drawnForward(&geometry)) {
        caster.lamp = lamp;
        caster.bothSides = !state.culled();
        caster.sent.emission = osg::Vec3f();
    }
    _casters.push_back(caster);
}

bool sameShadow(const Caster& a, const Caster& b, double slack)
{
    if (a.geometry != b.geometry || a.state != b.state || a.shape != b.shape) return false;
    if (a.worldFromModel == b.worldFromModel) return true;
    const osg::BoundingBox& box = a.geometry->getBoundingBox();
    for (unsigned k = 0; box.valid() && k < 8; ++k) {
        const osg::Vec3d corner = box.corner(k);
        if ((corner * a.worldFromModel - corner * b.worldFromModel).length() > slack) return false;
    }
    return true;
}

bool sameShadows(const std::vector<Caster>& a, const std::vector<Caster>& b, double slack)
{
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [&](const Caster& x, const Caster& y) { return sameShadow(x, y, slack); });
}

osg::BoundingBoxd boundOf(const Caster& caster)
{
    osg::BoundingBoxd bound;
    const osg::BoundingBox& box = caster.geometry->getBoundingBox();
    for (unsigned k = 0; box.valid() && k < 8; ++k) {
        const osg::Vec3d p = osg::Vec3d(box.corner(k)) * caster.worldFromModel;
        if (std::isfinite(p.x()) && std::isfinite(p.y()) && std::isfinite(p.z())) bound.expandBy(p);
    }
    return bound;
}

osg::BoundingBoxd boundOf(const std::vector<Caster>& casters)
{
    osg::BoundingBoxd bound;
    for (const Caster& caster : casters) bound.expandBy(boundOf(caster));
    return bound;
}

size_t trianglesOf(const std::vector<Caster>& casters)
{
    size_t sum = 0;
    for (const Caster& caster : casters)
        for (unsigned i = 0; i < caster.geometry->getNumPrimitiveSets(); ++i) {
            const osg::PrimitiveSet& set = *caster.geometry->getPrimitiveSet(i);
            sum += set.getMode() == GL_TRIANGLES ? set.getNumIndices() / 3 : set.getNumIndices();
        }
    return sum;
}

bool mapShows(const osg::Matrixd& projection, const osg::BoundingBoxd& bound)
{
    bool outside[5] = {true, true, true, true, true};
    for (unsigned i = 0; i < 8; ++i) {
        const osg::Vec4d p = osg::Vec4d(bound.corner(i), 1.0) * projection;
        const double reach = p[3] + 1e-3 * std::abs(p[3]);
        const double beyond[5] = {p[0] - reach, -p[0] - reach, p[1] - reach, -p[1] - reach, p[2] - reach};
        for (int k = 0; k < 5; ++k) outside[k] = outside[k] && beyond[k] > 0.0;
    }
    return std::find(outside, outside + 5, true) == outside + 5;
}

}  // namespace osgEnvLight

// SPDX-License-Identifier: MIT
#include "surface/CasterCollector.h"

#include <osg/Billboard>
#include <osg/Camera>
#include <osg/MatrixTransform>
#include <osg/PositionAttitudeTransform>
#include <osg/Projection>
#include <osgUtil/CullVisitor>
#include <osgUtil/StateGraph>

#include <algorithm>
#include <cmath>
#include <set>
#include <typeinfo>

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

// What differs by no more is rounding: the eye's place was multiplied in by the host, and out again.
bool isRounded(const osg::Matrixd& a, const osg::Matrixd& b, const osg::Vec3d& eye)
{
    const double rounding = 1e-12, far = eye.length() + a.getTrans().length();
    for (int row = 0; row < 4; ++row) {
        const double size = row < 3 ? std::abs(a(row, 0)) + std::abs(a(row, 1)) + std::abs(a(row, 2)) : far;
        for (int column = 0; column < 4; ++column)
            if (!(std::abs(a(row, column) - b(row, column)) <= rounding * size)) return false;
    }
    return true;
}

// These matrices say where children are whatever the view.
bool isPlain(const osg::Transform& node)
{
    if (node.getReferenceFrame() != osg::Transform::RELATIVE_RF) return false;
    return typeid(node) == typeid(osg::MatrixTransform) || typeid(node) == typeid(osg::PositionAttitudeTransform);
}

}  // namespace

CasterCollector::CasterCollector(osgUtil::CullVisitor& cv, const osg::Matrixd& worldFromEye, StateSets& stateSets,
                                 SurfaceFacts* facts)
    : osg::NodeVisitor(osg::NodeVisitor::NODE_VISITOR, osg::NodeVisitor::TRAVERSE_ACTIVE_CHILDREN),
      osg::CullStack(cv),  // not made anew, which reads the environment's variables and, at INFO, prints that in every frame
      _worldFromEye(worldFromEye),
      _eyeFromWorld(osg::Matrixd::inverse(worldFromEye)),
      _stateSets(stateSets),
      _path(pathTo(cv))
{
    _levels.push_back({stateOf(_path, facts), {}, {}});
    _places.push_back({*cv.getModelViewMatrix() * worldFromEye, true});
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

void CasterCollector::collect(osg::Group& group, CasterList& list)
{
    osg::Matrixd& worldFromNode = _places.back().worldFromModel;
    if (isRounded(worldFromNode, list.worldFromNode, _worldFromEye.getTrans())) worldFromNode = list.worldFromNode;
    list.worldFromNode = worldFromNode;
    _list = &list;
    _count = list.lamps = 0;
    _isChanged = false;
    for (unsigned i = 0; i < group.getNumChildren(); ++i) group.getChild(i)->accept(*this);
    if (!_isChanged && _count == list.all.size() && list.version > 0) return;
    list.all.resize(_count);
    list.bound = boundOf(list.all);
    ++list.version;
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

// The matrices that only nodes ask for are made when one does.
osg::CullStack& CasterCollector::cullStack()
{
    Place& place = _places.back();
    if (!place.isPushed)
        pushModelViewMatrix(new osg::RefMatrix(place.worldFromModel * _eyeFromWorld), osg::Transform::RELATIVE_RF);
    place.isPushed = true;
    return *this;
}

const osg::CullStack& CasterCollector::cullStack() const
{
    return const_cast<CasterCollector*>(this)->cullStack();
}

float CasterCollector::getDistanceToEyePoint(const osg::Vec3& pos, bool withLODScale) const
{
    return (pos - getEyePoint()).length() * (withLODScale ? getLODScale() : 1.0f);
}

float CasterCollector::getDistanceToViewPoint(const osg::Vec3& pos, bool withLODScale) const
{
    return (pos - getViewPoint()).length() * (withLODScale ? getLODScale() : 1.0f);
}

float CasterCollector::getDistanceFromEyePoint(const osg::Vec3& pos, bool withLODScale) const
{
    const osg::Matrixd& m = *const_cast<CasterCollector*>(this)->cullStack().getModelViewMatrix();
    const double z = double(pos.x()) * m(0, 2) + double(pos.y()) * m(1, 2) + double(pos.z()) * m(2, 2) + m(3, 2);
    return float(-z) * (withLODScale ? getLODScale() : 1.0f);
}

void CasterCollector::push(const osg::StateSet* stateSet)
{
    if (!stateSet) return;
    _levels.push_back({_levels.back().state, {}, {}});
    _levels.back().state.merge(*stateSet);
    _path.push_back(stateSet);
}

void CasterCollector::pop(const osg::StateSet* stateSet)
{
    if (!stateSet) return;
    _levels.pop_back();
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
    if (isPlain(node)) {
        _places.push_back({_places.back().worldFromModel, false});
        node.computeLocalToWorldMatrix(_places.back().worldFromModel, this);
        return traverseAtLastPlace(node);
    }
    osg::ref_ptr<osg::RefMatrix> matrix = new osg::RefMatrix(*cullStack().getModelViewMatrix());
    node.computeLocalToWorldMatrix(*matrix, this);
    pushModelViewMatrix(matrix.get(), node.getReferenceFrame());
    _places.push_back({*matrix * _worldFromEye, true});
    traverseAtLastPlace(node);
}

void CasterCollector::traverseAtLastPlace(osg::Transform& node)
{
    traverseWith(node.getStateSet(), node);
    if (_places.back().isPushed) popModelViewMatrix();
    _places.pop_back();
}

// As the view turns it.
void CasterCollector::apply(osg::Billboard& node)
{
    const osg::Vec3 eye = getEyePoint();
    for (unsigned i = 0; i < node.getNumDrawables(); ++i) {
        const osg::Geometry* geometry = node.getDrawable(i)->asGeometry();
        if (!geometry) continue;
        osg::Matrixd matrix(*cullStack().getModelViewMatrix());
        node.computeMatrix(matrix, eye, node.getPosition(i));
        const osg::StateSet* of[] = {static_cast<const osg::Node&>(node).getStateSet(), geometry->getStateSet()};
        for (const osg::StateSet* s : of) push(s);
        add(*geometry, matrix * _worldFromEye);
        for (const osg::StateSet* s : of) pop(s);
    }
}

void CasterCollector::apply(osg::Geometry& geometry)
{
    push(geometry.getStateSet());
    add(geometry, _places.back().worldFromModel);
    pop(geometry.getStateSet());
}

// Most are what they were in the frame before, and matrices are large: they are not copied to find that out.
void CasterCollector::add(const osg::Geometry& geometry, const osg::Matrixd& worldFromModel)
{
    const CasterState& state = _levels.back().state;
    if (!state.casts(&geometry) || !hasSurfaces(geometry)) return;
    Caster caster;
    caster.shape = geometry.getVertexArray() ? geometry.getVertexArray()->getModifiedCount() : 0;
    caster.box = geometry.getBoundingBox();
    if (state.movingProgram())
        setMotion(geometry, caster);
    else
        setLight(geometry, caster);
    std::vector<Caster>& all = _list->all;
    const size_t place = _count++;
    if (place == all.size()) all.emplace_back();
    Caster& former = all[place];
    if (former.geometry == &geometry && former.worldFromModel == worldFromModel && former.isLike(caster)) return;
    caster.geometry = &geometry;
    caster.worldFromModel = worldFromModel;
    const bool isKnown = former.geometry == &geometry && !caster.moves;
    if (isKnown && (former.isMeasured || former.shape != caster.shape)) measureBound(caster);
    if (!caster.isMeasured) caster.bound = boundOf(caster);
    former = std::move(caster);
    _isChanged = true;
}

void CasterCollector::setMotion(const osg::Geometry& geometry, Caster& caster)
{
    const CasterState& state = _levels.back().state;
    caster.moves = true;
    caster.state = _stateSets.moving.get(_path, state, geometry);
    caster.shape += _stateSets.moving.change(_path, *state.movingProgram(), getTraversalNumber());
}

void CasterCollector::setLight(const osg::Geometry& geometry, Caster& caster)
{
    Level& level = _levels.back();
    const CasterState& state = level.state;
    if (state.perforated(geometry)) {
        osg::ref_ptr<osg::StateSet>& shared = _stateSets.perforated[state.key(geometry)];
        if (!shared) shared = state.makeStateSet(geometry);
        caster.state = shared;
    }
    if (_findsSentLight && geometry.getColorArray()) {
        caster.sent = state.sentLight(geometry, _displayColors);
    } else if (_findsSentLight) {
        if (!level.sent) level.sent = state.sentLight(geometry, _displayColors);
        caster.sent = *level.sent;
    }
    if (_findsSentLight && caster.state) caster.sent.opacity = state.opacity(geometry);
    if (!level.lamp) level.lamp = state.lampEmission(_lampRule);
    if (*level.lamp == osg::Vec3f() || state.drawnForward(&geometry)) return;
    caster.lamp = *level.lamp;
    caster.bothSides = !state.culled();
    caster.sent.emission = osg::Vec3f();
    ++_list->lamps;
}

}  // namespace osgEnvLight

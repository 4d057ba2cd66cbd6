// SPDX-License-Identifier: MIT
#include "surface/DepthConvention.h"

#include "surface/SurfaceState.h"

#include <osg/ClipControl>
#include <osgUtil/StateGraph>

#include <vector>

namespace osgEnvLight
{

DepthConvention DepthConvention::of(const osgUtil::StateGraph& graph)
{
    std::vector<const osg::StateSet*> path;
    for (const osgUtil::StateGraph* g = &graph; g; g = g->_parent)
        if (g->getStateSet()) path.push_back(g->getStateSet());
    SurfaceState::Attribute depth, clip;
    for (auto s = path.rbegin(); s != path.rend(); ++s) {
        depth.merge((*s)->getAttributePair(osg::StateAttribute::DEPTH));
        clip.merge((*s)->getAttributePair(osg::StateAttribute::CLIPCONTROL));
    }
    DepthConvention result;
    if (const auto* d = depth.as<osg::Depth>()) {
        result.reversed = d->getFunction() == osg::Depth::GREATER || d->getFunction() == osg::Depth::GEQUAL;
        result.near = d->getZNear();
        result.far = d->getZFar();
    }
    const auto* c = clip.as<osg::ClipControl>();
    result.zeroToOne = c && c->getDepthMode() == osg::ClipControl::ZERO_TO_ONE;
    return result;
}

osg::Matrixd DepthConvention::fromHostClip() const
{
    const double sense = grows() ? 1.0 : -1.0;
    osg::Matrixd m;
    m(2, 2) = zeroToOne ? 2.0 * sense : sense;
    m(3, 2) = zeroToOne ? -sense : 0.0;
    return m;
}

}  // namespace osgEnvLight

// SPDX-License-Identifier: MIT
#include "surface/GBufferFill.h"

#include <osgUtil/CullVisitor>

namespace osgEnvLight
{

void GBufferFill::setState(osg::StateSet& stateSet, osg::Program* program, osg::Viewport* viewport)
{
    stateSet.setAttribute(program, osg::StateAttribute::ON | osg::StateAttribute::PROTECTED);
    stateSet.setDefine("ENVLIGHT_GBUFFER");  // for programs of SurfaceProgram
    stateSet.setMode(GL_BLEND, osg::StateAttribute::OFF | osg::StateAttribute::OVERRIDE);
    stateSet.setAttribute(viewport);  // the host's own is re-applied with its state
    stateSet.addUniform(new osg::Uniform("baseColorMap", 0));
    stateSet.addUniform(new osg::Uniform("materialColors", 0));
    stateSet.addUniform(new osg::Uniform("emittedStops", 0.0f));
}

osgUtil::StateGraph& GBufferFill::push(osgUtil::CullVisitor& cv, osg::ref_ptr<osg::RefMatrix>& projection)
{
    projection = cv.getProjectionMatrix();
    cv.pushStateSet(_stateSet.get());
    return *cv.getCurrentStateGraph();
}

void GBufferFill::pop(osgUtil::CullVisitor& cv)
{
    cv.popStateSet();
}

}  // namespace osgEnvLight

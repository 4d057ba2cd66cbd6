/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include "surface/SurfaceSorter.h"

#include <osg/Program>
#include <osg/Viewport>

namespace osgUtil
{
class CullVisitor;
}

namespace osgEnvLight
{

/** Culls what fills a G-buffer: pushes the G-buffer's program and, after the traversal, chooses the variant of it that each
 * surface's state asks for. */
class OSGENVLIGHT_EXPORT GBufferFill : public osg::Referenced
{
  public:
    GBufferFill(osg::StateSet* stateSet, SurfaceSorter* sorter) : _stateSet(stateSet), _sorter(sorter) {}

    /** Pushed above what fills the G-buffer. */
    osg::StateSet* getStateSet() const { return _stateSet.get(); }

    /** Cull with traverse() into the visitor's current bin.
     * forward, lit, lamps, moved: as SurfaceSorter::sort.*/
    template <class Traverse>
    SurfaceSorter::Sorted fill(osgUtil::CullVisitor& cv, osgUtil::RenderBin& bin, osgUtil::RenderBin* forward,
                               const SurfaceSorter::LitState& lit, const LampRule& lamps, std::vector<ForwardGraph>& moved,
                               Traverse traverse)
    {
        osg::ref_ptr<osg::RefMatrix> projection;
        osgUtil::StateGraph& top = push(cv, projection);
        traverse();
        pop(cv);
        return _sorter->sort({bin, forward, top, projection.get(), lamps, moved}, lit);
    }

    /** Make stateSet that of a G-buffer with that program and viewport: the program ON | PROTECTED, so that a program below it
     * wins and an override above it does not; blending off.*/
    static void setState(osg::StateSet& stateSet, osg::Program* program, osg::Viewport* viewport);

  protected:
    ~GBufferFill() override = default;

  private:
    osgUtil::StateGraph& push(osgUtil::CullVisitor& cv, osg::ref_ptr<osg::RefMatrix>& projection);
    static void pop(osgUtil::CullVisitor& cv);

    const osg::ref_ptr<osg::StateSet> _stateSet;
    const osg::ref_ptr<SurfaceSorter> _sorter;
};

}  // namespace osgEnvLight

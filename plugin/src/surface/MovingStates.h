/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include "surface/CasterState.h"

#include <osg/Program>

#include <cstdint>
#include <map>
#include <set>
#include <vector>

namespace osgEnvLight
{

/** State sets that casters are drawn with whose vertices a SurfaceProgram moves: its uniforms and textures, as the state sets
 * above them have them, and the program that draws shadows. Kept from frame to frame. */
class OSGENVLIGHT_EXPORT MovingStates
{
  public:
    /** State sets from the root down to the drawable. */
    using Path = std::vector<const osg::StateSet*>;

    /** The same one as long as the path has the same uniforms and textures. A draw may still use a former one.
     * @param state  of the path */
    osg::ref_ptr<osg::StateSet> get(const Path& path, const CasterState& state, const osg::Geometry& geometry);

    /** Changes with the values of the path's uniforms; with the frame if the program follows time. */
    uint64_t change(const Path& path, const osg::Program& program, unsigned frame);

    bool empty() const { return _states.empty(); }
    void resizeGLObjectBuffers(unsigned maximum);
    void releaseGLObjects(osg::State* state) const;
    void forgetUnused(const std::set<const osg::StateSet*>& used);

  private:
    struct Drawn {
        osg::ref_ptr<osg::Program> program;
        bool followsTime = false;
    };
    const Drawn& drawnBy(const osg::Program& moving);

    std::map<Path, osg::ref_ptr<osg::StateSet>> _states;
    std::map<osg::ref_ptr<const osg::Shader>, Drawn> _drawn;  // by the application's shader
};

}  // namespace osgEnvLight

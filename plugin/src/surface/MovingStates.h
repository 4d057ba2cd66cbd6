/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include "surface/CasterState.h"

#include <osg/Program>

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace osgEnvLight
{

/** State sets that casters are drawn with whose vertices a SurfaceProgram moves: the uniforms, defines and textures that its
 * function may read, as the state sets above them have them, and the program that draws shadows. Kept from frame to frame. */
class OSGENVLIGHT_EXPORT MovingStates
{
  public:
    /** State sets from the root down to the drawable. */
    using Path = std::vector<const osg::StateSet*>;

    /** The same one for the same inputs.
     * @param state  of the path */
    osg::ref_ptr<osg::StateSet> get(const Path& path, const CasterState& state, const osg::Geometry& geometry);

    /** Changes with the values of the uniforms that the function reads; with the frame if it follows time. */
    uint64_t change(const Path& path, const osg::Program& program, unsigned frame);

    bool empty() const { return _states.empty(); }
    void forgetUnused(const std::set<const osg::StateSet*>& used);
    void resizeGLObjectBuffers(unsigned maximum);
    void releaseGLObjects(osg::State* state) const;

  private:
    struct Drawn {
        osg::ref_ptr<osg::Program> program;
        std::set<std::string> words;  // of the application's shader
        bool followsTime = false;
    };
    const Drawn& drawnBy(const osg::Program& moving);

    /** Objects, and defines. */
    using Key = std::pair<std::vector<const void*>, std::string>;
    static Key keyOf(const osg::StateSet& inputs, const CasterState& state, const osg::Geometry& geometry);

    std::map<Key, osg::ref_ptr<osg::StateSet>> _states;
    std::map<osg::ref_ptr<const osg::Shader>, Drawn> _drawn;  // by the application's shader
};

}  // namespace osgEnvLight

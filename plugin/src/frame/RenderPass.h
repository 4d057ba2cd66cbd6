/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include "frame/Requirement.h"

#include <osgEnvLight/Export>

#include <osg/State>

namespace osgEnvLight
{

struct FrameContext;
class PassBuilder;

/** A part of the frame. One object serves one view; it names no other pass: what passes exchange are the textures of PassBuilder
 * and the members of FrameContext. All but the destructor and the functions for OpenGL's objects are called during cull.*/
class OSGENVLIGHT_EXPORT RenderPass : public osg::Referenced
{
  public:
    /** Of its shader pass/NAME.frag, if shader() says no other, its times, its line in the plan. */
    virtual const char* name() const = 0;
    /** Passes that do the same to other textures share a shader. */
    virtual const char* shader() const { return name(); }

    /** Without ".vert". */
    virtual const char* vertexShader() const { return "fullscreen"; }

    /** Whether the view needs it in this frame. */
    virtual Requirement require(const FrameContext& context) const = 0;

    /** Called for each pass that is needed, in the order in which they were added, before any setup(). */
    virtual void update(FrameContext&) {}

    /** Says what the pass reads, writes and draws in this frame. */
    virtual void setup(PassBuilder& builder, FrameContext& context) = 0;

    /** Called in place of both where the pass is not needed: frees what it has kept. */
    virtual void dismiss(FrameContext&) {}

    /** Bytes of textures of its own, besides those of the graph. */
    virtual size_t bytes() const { return 0; }
    virtual void resizeGLObjectBuffers(unsigned) {}
    virtual void releaseGLObjects(osg::State*) const {}

  protected:
    ~RenderPass() override = default;
};

}  // namespace osgEnvLight

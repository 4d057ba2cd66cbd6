/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include "gl/ContextWatch.h"
#include "gl/FrameTimer.h"
#include "gl/FullScreenTriangle.h"
#include "surface/DepthConvention.h"

#include <osgEnvLight/Export>

#include <osg/Geometry>
#include <osg/Matrixd>

#include <array>
#include <vector>

namespace osgEnvLight
{

/** A triangle over the viewport for a pass. The host's projection is final only after cull, so the uniforms that depend on it are
 * read from osg::State when it is drawn: projection, inverseProjection, mapFromEye, atlasFromEye, viewportSize,
 * viewportOrigin, subpixel, hostDepth. None of these may also be an osg::Uniform.*/
class OSGENVLIGHT_EXPORT FullScreen : public osg::Geometry
{
  public:
    /** @param vertices  fullScreenVertices(), which several may share */
    explicit FullScreen(osg::Vec3Array* vertices);

    void drawImplementation(osg::RenderInfo& renderInfo) const override;
    osg::BoundingBox computeBoundingBox() const override { return osg::BoundingBox(); }

    /** Written at cull by the frame that owns this. */
    osg::Matrixd mapFromWorld;
    osg::Vec3d atlasOrigin;  // in the world
    osg::Vec2d subpixel;     // shift of the picture in clip space over w
    DepthConvention depth;   // the host's
    TimedDraw timed;
    osg::observer_ptr<ContextWatch::Listener> owner;  // told when the context is lost that this was drawn in; may be null
    unsigned textureUnits = 0;                        // that its state set binds, from 0 on

    /** What is in a target before the triangle. */
    struct Clear {
        int target;  // 0, 1, ...
        std::array<float, 4> value;
        bool bits;  // of integers
    };
    std::vector<Clear> clears;

  protected:
    /** Draw what covers the pixels, with the program that has the uniforms. */
    virtual void drawShapes(osg::RenderInfo& renderInfo) const { osg::Geometry::drawImplementation(renderInfo); }
    /** Upload the uniforms that depend on the host's projection to the program in use. */
    void uploadUniforms(const osg::State& state) const;

  private:
    void clearTargets() const;
};

}  // namespace osgEnvLight

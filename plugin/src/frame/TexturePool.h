/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include "base/Failure.h"
#include "frame/StageCamera.h"
#include "gl/RetiredObjects.h"

#include <osg/FrameBufferObject>
#include <osg/StateSet>
#include <osg/Texture2D>
#include <osg/Viewport>

#include <map>
#include <string>
#include <vector>

namespace osgEnvLight
{

/** Textures that are drawn into together, and the camera whose callbacks bind them. */
struct RenderTarget : public osg::Referenced {
    osg::ref_ptr<osg::FrameBufferObject> frameBuffer;
    osg::ref_ptr<StageCamera> camera;
    osg::ref_ptr<osg::Viewport> viewport;
    osg::ref_ptr<osg::StateSet> state;  // with that viewport: the host's own is re-applied with its state
    std::vector<osg::ref_ptr<osg::Texture2D>> textures;
};

/** The textures that the passes of a view draw into: two passes of a frame share one of like format and size where the first is
 * no longer read when the second writes. What a frame does not use is given up at its end.*/
class OSGENVLIGHT_EXPORT TexturePool
{
  public:
    TexturePool(Failure* failure, RetiredObjects* retired) : _failure(failure), _retired(retired) {}

    struct Size {
        GLint format;
        int width;
        int height;
        bool linear = false;
        bool operator==(const Size& o) const
        {
            return format == o.format && width == o.width && height == o.height && linear == o.linear;
        }
    };

    void beginFrame();
    /** One that is written from draw `first` on, and last read in draw `last`. */
    osg::ref_ptr<osg::Texture2D> transient(const Size& size, int first, int last);
    /** The one of that name, as it was left by the frame before. */
    osg::ref_ptr<osg::Texture2D> kept(const std::string& name, const Size& size);
    /** @param marks  depth texture of the same size, or null */
    RenderTarget& target(const std::vector<osg::ref_ptr<osg::Texture2D>>& colors, const osg::ref_ptr<osg::Texture2D>& marks);
    void endFrame();

    /** Give up everything. */
    void clear();

    size_t bytes() const;
    void resizeGLObjectBuffers(unsigned maximum);
    void releaseGLObjects(osg::State* state) const;

  private:
    struct Entry {
        osg::ref_ptr<osg::Texture2D> texture;
        Size size;
        int busyUntil = -1;  // of this frame; negative: not used
        std::string keptName;
    };
    osg::ref_ptr<osg::Texture2D> make(const Size& size, int last, const std::string& name);

    const osg::ref_ptr<Failure> _failure;
    const osg::ref_ptr<RetiredObjects> _retired;
    std::vector<Entry> _entries;
    struct Used {
        osg::ref_ptr<RenderTarget> target;
        bool used = false;
    };
    std::map<std::vector<osg::Texture2D*>, Used> _targets;
};

}  // namespace osgEnvLight

/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include <osgEnvLight/Export>

#include <osg/Texture2D>
#include <osg/observer_ptr>

#include <mutex>
#include <vector>

namespace osgEnvLight
{

/** Bytes of texture memory of a texture without mips. */
OSGENVLIGHT_EXPORT size_t bytesOf(const osg::Texture2D& texture);

/** What a view has replaced, and a frame that is being drawn may still refer to: such objects die with the last stage that
 * holds them. Until then they are counted, and released with the others. Thread-safe. */
class OSGENVLIGHT_EXPORT RetiredObjects : public osg::Referenced
{
  public:
    /** A texture, frame buffer or drawable; may be null. */
    void add(osg::Object* object);

    size_t bytes() const;
    void releaseGLObjects(osg::State* state) const;

  protected:
    ~RetiredObjects() override = default;

  private:
    mutable std::mutex _mutex;
    std::vector<osg::observer_ptr<osg::Object>> _objects;
};

}  // namespace osgEnvLight

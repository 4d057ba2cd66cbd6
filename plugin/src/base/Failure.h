/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include <osgEnvLight/Export>

#include <osg/Referenced>

#include <mutex>
#include <set>
#include <string>

namespace osgEnvLight
{

/** In which contexts a node can't light, as the draw thread of one has found, or its cull. Until the context ends its host draws
 * as without us. Thread-safe.*/
class OSGENVLIGHT_EXPORT Failure : public osg::Referenced
{
  public:
    bool happened(unsigned contextID) const;
    /** Reports a context's first message, and only that, as osg::WARN. */
    void report(unsigned contextID, const std::string& message);
    /** Of all contexts, or of one. */
    void clear();
    void clear(unsigned contextID);

  protected:
    ~Failure() override = default;

  private:
    mutable std::mutex _mutex;
    std::set<unsigned> _contexts;
};

}  // namespace osgEnvLight

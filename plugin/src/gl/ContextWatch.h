/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include <osgEnvLight/Export>

#include <osg/GLObjects>
#include <osg/State>
#include <osg/observer_ptr>

#include <mutex>
#include <set>

namespace osgEnvLight
{

/** Tells when a context loses its objects of OpenGL: its window closes, or its host deletes or discards them all. OSG then
 * forgets textures and buffers by itself, wherever they are; frame buffers, programs and queries only where the graph leads to
 * them. One for each context, owned by OSG.*/
class OSGENVLIGHT_EXPORT ContextWatch : public osg::GraphicsObjectManager
{
  public:
    class Listener : public osg::Referenced
    {
      public:
        /** The context is current if its objects can still be deleted. */
        virtual void contextLost(unsigned contextID) = 0;
    };

    /** Tell the listener, as long as it lives. In the context's draw thread. */
    static void add(osg::State& state, Listener* listener);

    explicit ContextWatch(unsigned contextID);

    void flushDeletedGLObjects(double, double&) override {}
    void flushAllDeletedGLObjects() override {}
    void deleteAllGLObjects() override { tell(); }
    void discardAllGLObjects() override;

  private:
    void tell();

    std::mutex _mutex;
    std::set<osg::observer_ptr<Listener>> _listeners;
    bool _discarding = false;
    bool _hasManagers = false;  // of the draw thread alone
};

}  // namespace osgEnvLight

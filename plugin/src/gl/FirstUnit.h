/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include <osg/Drawable>

namespace osgEnvLight
{

/** Draws nothing. It makes texture unit 0 the active one, as it is in a host without us: drawables that call OpenGL themselves
 * rely on that, and OpenGL refuses evaluators and fixed-function coordinates with another one [OpenGL 2.1, 5.1].*/
class FirstUnit : public osg::Drawable
{
  public:
    FirstUnit()
    {
        setUseDisplayList(false);
        setCullingActive(false);
    }

    void drawImplementation(osg::RenderInfo& renderInfo) const override { renderInfo.getState()->setActiveTextureUnit(0); }

  protected:
    ~FirstUnit() override = default;
};

}  // namespace osgEnvLight

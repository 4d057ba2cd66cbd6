// SPDX-License-Identifier: MIT
// What makes a surface one that is drawn forward.
#pragma once

#include <osg/Material>
#include <osg/StateSet>

/** Blended, and as good as opaque. */
inline void blend(osg::StateSet& stateSet)
{
    const osg::ref_ptr<osg::Material> material = new osg::Material;
    material->setAlpha(osg::Material::FRONT_AND_BACK, 0.999f);
    stateSet.setAttribute(material);
    stateSet.setMode(GL_BLEND, osg::StateAttribute::ON);
    stateSet.setRenderingHint(osg::StateSet::TRANSPARENT_BIN);
}

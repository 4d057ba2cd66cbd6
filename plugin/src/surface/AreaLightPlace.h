/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include "surface/Emitter.h"

#include <osg/StateAttribute>
#include <osg/observer_ptr>
#include <osgUtil/RenderStage>

namespace osgEnvLight
{

/** What a cull leaves at its stage of an area light that it meets, as an osg::LightSource leaves its light: the stage keeps it
 * with the matrix at which it was met. It changes no state. */
class OSGENVLIGHT_EXPORT AreaLightPlace : public osg::StateAttribute
{
  public:
    AreaLightPlace() = default;
    explicit AreaLightPlace(AreaLight* light) : _light(light) {}
    AreaLightPlace(const AreaLightPlace& other, const osg::CopyOp& copyop)
        : osg::StateAttribute(other, copyop), _light(other._light)
    {
    }
    META_StateAttribute(osgEnvLight, AreaLightPlace, Type(120))  // of no attribute of OSG's

        int compare(const osg::StateAttribute& other) const override;
    /** Null once it is deleted. */
    osg::ref_ptr<const AreaLight> light() const;

    /** The light that draws a drawable as its own surface: its place; null of any other drawable. */
    static const AreaLightPlace* of(const osg::Drawable& drawable);

  protected:
    ~AreaLightPlace() override = default;

  private:
    osg::observer_ptr<AreaLight> _light;
};

/** An area light as a cull has met it. What the light draws has the same matrix, not only an equal one. */
struct MetAreaLight {
    osg::ref_ptr<const AreaLightPlace> place;
    osg::ref_ptr<const osg::RefMatrix> eyeFromLight;

    /** @return as placeEmitter(), with the light's name in front */
    std::string emitter(const osg::Matrixd& targetFromEye, Emitter& result) const;
};

/** Those of a stage, in the order in which cull met them; the stage keeps none. */
OSGENVLIGHT_EXPORT std::vector<MetAreaLight> takeAreaLights(osgUtil::RenderStage& stage);

/** The same in other coordinates, without those that are black or can not light.
 * @param problems  receives a text for each that can not; null: nothing is said */
OSGENVLIGHT_EXPORT std::vector<Emitter> takeEmitters(osgUtil::RenderStage& stage, const osg::Matrixd& targetFromEye,
                                                     std::vector<std::string>* problems);

}  // namespace osgEnvLight

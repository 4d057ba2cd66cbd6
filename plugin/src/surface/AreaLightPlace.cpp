// SPDX-License-Identifier: MIT
#include "surface/AreaLightPlace.h"

#include <algorithm>

namespace osgEnvLight
{

int AreaLightPlace::compare(const osg::StateAttribute& other) const
{
    COMPARE_StateAttribute_Types(AreaLightPlace, other) COMPARE_StateAttribute_Parameter(_light) return 0;
}

osg::ref_ptr<const AreaLight> AreaLightPlace::light() const
{
    osg::ref_ptr<AreaLight> light;
    return _light.lock(light) ? light : nullptr;
}

const AreaLightPlace* AreaLightPlace::of(const osg::Drawable& drawable)
{
    return dynamic_cast<const AreaLightPlace*>(drawable.getUserData());
}

std::string MetAreaLight::emitter(const osg::Matrixd& targetFromEye, Emitter& result) const
{
    const osg::ref_ptr<const AreaLight> light = place->light();
    if (!light) return "area light was deleted";
    const std::string problem = placeEmitter(*light, *eyeFromLight * targetFromEye, result);
    if (problem.empty()) return problem;
    return "area light" + (light->getName().empty() ? std::string() : " '" + light->getName() + "'") + " " + problem;
}

std::vector<MetAreaLight> takeAreaLights(osgUtil::RenderStage& stage)
{
    std::vector<MetAreaLight> met;
    auto& entries = stage.getPositionalStateContainer()->getAttrMatrixList();
    const auto isOurs = [&met](const auto& entry) {
        const auto* place = dynamic_cast<const AreaLightPlace*>(entry.first.get());
        if (place) met.push_back({place, entry.second});
        return place != nullptr;
    };
    entries.erase(std::remove_if(entries.begin(), entries.end(), isOurs), entries.end());
    return met;
}

std::vector<Emitter> takeEmitters(osgUtil::RenderStage& stage, const osg::Matrixd& targetFromEye,
                                  std::vector<std::string>* problems)
{
    std::vector<Emitter> emitters;
    for (const MetAreaLight& met : takeAreaLights(stage)) {
        Emitter emitter;
        const std::string problem = met.emitter(targetFromEye, emitter);
        if (problem.empty() && emitter.flux() > 0.0) emitters.push_back(std::move(emitter));
        if (!problem.empty() && problems) problems->push_back(problem);
    }
    return emitters;
}

}  // namespace osgEnvLight

// SPDX-License-Identifier: MIT
#include "Lights.h"

#include "Materials.h"

#include <algorithm>
#include <cmath>

namespace osgEnvLight::gltf
{

osg::ref_ptr<osg::LightSource> makeLight(const tinygltf::Light& light, int number)
{
    osg::Vec4d color(1.0, 1.0, 1.0, 1.0);
    for (std::size_t i = 0; i < light.color.size() && i < 3; ++i) color.ptr()[i] = light.color[i];
    for (int i = 0; i < 3; ++i) color.ptr()[i] *= light.intensity / osg::PI;

    osg::ref_ptr<osg::Light> result = new osg::Light(unsigned(number));
    result->setName(light.name);
    result->setAmbient(osg::Vec4(0, 0, 0, 1));
    result->setDiffuse(displayColor(color));
    result->setSpecular(result->getDiffuse());
    // glTF's lights shine along -Z.
    result->setDirection(osg::Vec3(0, 0, -1));
    result->setPosition(light.type == "directional" ? osg::Vec4(0, 0, 1, 0) : osg::Vec4(0, 0, 0, 1));
    if (light.type != "directional") {
        result->setConstantAttenuation(0.0f);
        result->setQuadraticAttenuation(1.0f);
    }
    if (light.type == "spot") {
        const double outer = std::clamp(light.spot.outerConeAngle, 0.001, osg::PI_2);
        const double middle = 0.5 * (outer + std::min(light.spot.innerConeAngle, outer));
        result->setSpotCutoff(float(osg::RadiansToDegrees(outer)));
        result->setSpotExponent(float(std::clamp(std::log(0.5) / std::log(std::max(std::cos(middle), 1e-9)), 0.0, 128.0)));
    }
    osg::ref_ptr<osg::LightSource> source = new osg::LightSource;
    source->setName(light.name);
    source->setLight(result);
    return source;
}

}  // namespace osgEnvLight::gltf

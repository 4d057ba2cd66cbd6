// SPDX-License-Identifier: MIT
// Every BRDF of osgEnvLight::Material that has a lobe, for tests that hold for all.
#pragma once

#include <osgEnvLight/Material>

#include <algorithm>
#include <cmath>

inline const osgEnvLight::Material::Brdf lobedBrdfs[] = {osgEnvLight::Material::PHONG, osgEnvLight::Material::COOK_TORRANCE,
                                                         osgEnvLight::Material::BLINN_PHONG, osgEnvLight::Material::BECKMANN,
                                                         osgEnvLight::Material::STRAUSS};

/** A lobe of about that colour and width, with as little below it as the BRDF allows. Strauss's smoothness is 1 - roughness. */
inline void setLobe(osg::StateSet& stateSet, osgEnvLight::Material::Brdf brdf, const osg::Vec3f& color, float roughness)
{
    using osgEnvLight::Material;
    const float exponent = 2.0f / std::pow(std::max(roughness, 0.04f), 4.0f) - 2.0f;
    switch (brdf) {
        case Material::PHONG:
            return Material::setPhong(stateSet, osg::Vec3f(), color, exponent);
        case Material::BLINN_PHONG:
            return Material::setBlinnPhong(stateSet, osg::Vec3f(), color, exponent);
        case Material::BECKMANN:
            return Material::setCookTorrance(stateSet, color, 1.0f, roughness, Material::BECKMANN_NORMALS);
        case Material::STRAUSS:
            return Material::setStrauss(stateSet, color, 1.0f - roughness, 1.0f);
        default:
            return Material::setCookTorrance(stateSet, color, 1.0f, roughness);
    }
}

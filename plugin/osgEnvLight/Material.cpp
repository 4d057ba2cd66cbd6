// SPDX-License-Identifier: MIT
#include <osgEnvLight/Material>

#include <osg/Uniform>

namespace osgEnvLight
{

namespace
{

const char* const defines[] = {"ENVLIGHT_LAMBERT", "ENVLIGHT_PHONG", "ENVLIGHT_COOK_TORRANCE"};

// The others are switched off, or those of a state set above would stay defined beside this one's.
void choose(osg::StateSet& stateSet, Material::Brdf brdf)
{
    for (int i = 0; i < 3; ++i)
        stateSet.setDefine(defines[i], i == brdf ? osg::StateAttribute::ON : osg::StateAttribute::OFF);
}

template <class T>
void setUniform(osg::StateSet& stateSet, const char* name, const T& value)
{
    stateSet.addUniform(new osg::Uniform(name, value));
}

} // namespace

void Material::setLambert(osg::StateSet& stateSet, const osg::Vec3f& diffuse)
{
    choose(stateSet, LAMBERT);
    setUniform(stateSet, "envlightDiffuse", diffuse);
}

void Material::setPhong(osg::StateSet& stateSet, const osg::Vec3f& diffuse, const osg::Vec3f& specular, float exponent)
{
    choose(stateSet, PHONG);
    setUniform(stateSet, "envlightDiffuse", diffuse);
    setUniform(stateSet, "envlightSpecular", specular);
    setUniform(stateSet, "envlightExponent", exponent);
}

void Material::setCookTorrance(osg::StateSet& stateSet, const osg::Vec3f& baseColor, float metalness, float roughness)
{
    choose(stateSet, COOK_TORRANCE);
    setUniform(stateSet, "envlightBaseColor", baseColor);
    setUniform(stateSet, "envlightMetalness", metalness);
    setUniform(stateSet, "envlightRoughness", roughness);
}

int Material::brdfOf(const osg::StateSet& stateSet, int inherited)
{
    for (int i = 0; i < 3; ++i) {
        const osg::StateSet::DefinePair* define = stateSet.getDefinePair(defines[i]);
        if (define && (define->second & osg::StateAttribute::ON)) return i;
    }
    return inherited;
}

} // namespace osgEnvLight

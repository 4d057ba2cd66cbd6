// SPDX-License-Identifier: MIT
#include <osgEnvLight/Material>

#include <osg/Uniform>

namespace osgEnvLight
{

namespace
{

// Which BRDF, for the CPU. A uniform and not a define, because OSG's XML files lose their place at a list of defines.
const char* const brdfUniform = "envlightBrdf";

template <class T>
void setUniform(osg::StateSet& stateSet, const char* name, const T& value)
{
    stateSet.addUniform(new osg::Uniform(name, value));
}

}  // namespace

void Material::setLambert(osg::StateSet& stateSet, const osg::Vec3f& diffuse)
{
    setUniform(stateSet, brdfUniform, int(LAMBERT));
    setUniform(stateSet, "envlightDiffuse", diffuse);
}

void Material::setPhong(osg::StateSet& stateSet, const osg::Vec3f& diffuse, const osg::Vec3f& specular, float exponent)
{
    setUniform(stateSet, brdfUniform, int(PHONG));
    setUniform(stateSet, "envlightDiffuse", diffuse);
    setUniform(stateSet, "envlightSpecular", specular);
    setUniform(stateSet, "envlightExponent", exponent);
}

void Material::setCookTorrance(osg::StateSet& stateSet, const osg::Vec3f& baseColor, float metalness, float roughness)
{
    setUniform(stateSet, brdfUniform, int(COOK_TORRANCE));
    setUniform(stateSet, "envlightBaseColor", baseColor);
    setUniform(stateSet, "envlightMetalness", metalness);
    setUniform(stateSet, "envlightRoughness", roughness);
}

int Material::brdfOf(const osg::StateSet& stateSet, int inherited)
{
    const osg::Uniform* uniform = stateSet.getUniform(brdfUniform);
    int brdf = inherited;
    return uniform && uniform->get(brdf) && brdf >= LAMBERT && brdf <= COOK_TORRANCE ? brdf : inherited;
}

}  // namespace osgEnvLight

// SPDX-License-Identifier: MIT
// What a surface emits, and whether it is a lamp.
#include "surface/MaterialMaps.h"
#include "surface/SurfaceState.h"

#include <osg/Texture2D>

#include <algorithm>
#include <cmath>

#include "glsl.h"
#include "lib/tone.glsl"

namespace osgEnvLight
{

osg::Vec3f SurfaceState::emission(bool displayColors) const
{
    if (!emits()) {
        const osg::Material* m = osgMaterial();
        osg::Vec3f color;
        if (!m || m->getEmission(osg::Material::FRONT) == osg::Vec4(0, 0, 0, 1)) return color;
        for (int i = 0; i < 3; ++i) {
            const float typed = std::max(m->getEmission(osg::Material::FRONT)[unsigned(i)], 0.0f);
            color[i] = displayColors ? float(glsl::typedDecode(double(typed))) : typed;
        }
        return color;
    }
    if (!mapped(MaterialMaps::ofEmission)) return _emission;
    const TextureUnit& unit = _units[size_t(_mapUnits[MaterialMaps::ofEmission])];
    return osg::componentMultiply(_emission, factsOf(*unit.texture.as<osg::Texture2D>()).mean);
}

osg::Vec3f SurfaceState::lampEmission(const LampRule& rule) const
{
    if (!rule.finds || unlit() || isAreaLight() || _light == Material::LIGHT_OFF) return osg::Vec3f();
    osg::Vec3f emitted = emission(rule.displayColors);
    for (int i = 0; i < 3; ++i)
        if (!std::isfinite(emitted[i]) || emitted[i] < 0.0f) emitted[i] = 0.0f;
    const float most = std::max({emitted[0], emitted[1], emitted[2]});
    const bool isUneven = texture() || mapped(MaterialMaps::ofEmission);
    if (_light == Material::LIGHT_AUTO && (isUneven || !(most > rule.least))) return osg::Vec3f();
    return most > 0.0f ? emitted : osg::Vec3f();
}

}  // namespace osgEnvLight

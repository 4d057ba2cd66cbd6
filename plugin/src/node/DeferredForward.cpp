// SPDX-License-Identifier: MIT
// What the transparent surfaces of the host are drawn with, after the composite and in its own bins.
#include "node/DeferredTechnique.h"

namespace osgEnvLight
{

namespace
{

const unsigned on = osg::StateAttribute::ON | osg::StateAttribute::OVERRIDE | osg::StateAttribute::PROTECTED;
const unsigned firstUnit = 8;  // beyond those that fixed-function state reaches

void addUniforms(osg::StateSet& to, const osg::StateSet& from)
{
    for (const auto& [name, uniform] : from.getUniformList()) to.addUniform(uniform.first);
}

}  // namespace

// The state set that was pushed above them when they were culled: only now is it known what the frame's maps are.
void DeferredTechnique::setForwardState(Cull& c)
{
    const FramePlan& plan = c.view.plan;
    MapTextures& textures = c.view.textures();
    osg::StateSet& s = *c.frame.forwardState;
    addUniforms(s, *c.frame.uniforms);
    s.setAttribute(_library->program("pass/surface.vert", "pass/forward.frag"),
                   osg::StateAttribute::ON | osg::StateAttribute::PROTECTED);
    s.addUniform(new osg::Uniform("baseColorMap", 0));
    s.addUniform(textures.harmonics());
    PassInputs in;
    in.samplers = {{"pyramidMap", textures.pyramid()}, {"albedoTable", albedoTable()}};
    if (c.settings.output == Settings::LINEAR) in.defines.push_back("OUTPUT_LINEAR");
    if (!textures.suns().empty()) {
        in.defines.push_back("HAS_SUNS");
        if (c.settings.suns == Settings::SUNS_AUTO) in.defines.push_back("SUN_DIFFUSE");
        textures.addSuns(in.uniforms);
    }
    const auto addPlace = [&](const char* name, const osg::Vec3d& origin) {
        s.addUniform(new osg::Uniform(name, osg::Matrixf(c.worldFromEye * osg::Matrixd::translate(-origin))));
    };
    if (plan.atlas) {
        ShadowAtlas& atlas = *skyAtlas(c).maps;
        in.defines.push_back("HAS_ATLAS");
        addMaps(in, atlas, c.finer);
        const ShadowPlaces places = placesOf(c, "atlas", atlas, c.finer);
        addUniforms(s, *places.uniforms);
        s.setTextureAttribute(Frame::atlasLightUnit,
                              places.uniforms->getTextureAttribute(Frame::atlasLightUnit, osg::StateAttribute::TEXTURE), on);
        addPlace("atlasFromEye", places.origin);
    }
    if (SunShadows* suns = plan.sunMaps ? c.view.sunShadows() : nullptr) {
        in.defines.push_back("HAS_SUN_MAPS");
        in.samplers.push_back({"sunShadowMaps", suns->texture()});
        addUniforms(s, c.frame.sunState(*suns));
        addPlace("sunsFromEye", suns->targets().origin);
    }
    if (!c.lights.empty()) {
        in.defines.push_back("HAS_SCENE_LIGHTS");
        c.frame.sceneLights.addTo(s);
    }
    if (plan.bounce) {
        in.defines.push_back("HAS_BOUNCE");
        in.samplers.push_back({"bounceMap", c.view.target("bouncesum", {}).textures[0].get()});
    }
    for (const std::string& d : in.defines) s.setDefine(d);
    for (const osg::ref_ptr<osg::Uniform>& u : in.uniforms) s.addUniform(u.get());
    for (unsigned i = 0; i < in.samplers.size(); ++i) bind(s, firstUnit + i, in.samplers[i]);
}

}  // namespace osgEnvLight

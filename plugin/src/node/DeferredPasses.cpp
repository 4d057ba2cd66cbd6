// SPDX-License-Identifier: MIT
// What each pass of a frame reads, and the state set that binds it.
#include "surface/AlbedoTable.h"
#include "node/DeferredTechnique.h"

#include <osg/BlendFunc>
#include <osg/Depth>
#include <osg/PolygonMode>
#include <osgUtil/CullVisitor>

namespace osgEnvLight
{

namespace
{

const unsigned on = osg::StateAttribute::ON | osg::StateAttribute::OVERRIDE | osg::StateAttribute::PROTECTED;
const unsigned off = osg::StateAttribute::OFF | osg::StateAttribute::OVERRIDE | osg::StateAttribute::PROTECTED;

}  // namespace

osg::StateSet& DeferredTechnique::gbufferState(Cull& c)
{
    const DepthConvention& depth = c.depth;
    const bool plain = !depth.reversed && depth.near == 0.0 && depth.far == 1.0;
    ViewData::State state = c.view.state({plain           ? "gbuffer"
                                          : depth.grows() ? "gbuffer growing"
                                                          : "gbuffer falling",
                                          {},
                                          {c.view.viewport()}});
    if (!state.isNew) return state.stateSet;
    GBufferFill::setState(state.stateSet, _library->program("pass/surface.vert", "pass/gbuffer.frag"), c.view.viewport());
    const double near = depth.grows() ? 0.0 : 1.0;
    if (!plain)
        state.stateSet.setAttributeAndModes(new osg::Depth(osg::Depth::LEQUAL, near, 1.0 - near),
                                            osg::StateAttribute::ON | osg::StateAttribute::OVERRIDE);
    return state.stateSet;
}

void DeferredTechnique::bind(osg::StateSet& stateSet, unsigned unit, const Sampler& sampler)
{
    stateSet.setTextureAttribute(unit, sampler.texture, on);
    stateSet.addUniform(new osg::Uniform(sampler.name, int(unit)), on);
}

osg::StateSet& DeferredTechnique::passState(Cull& c, const std::string& name, const PassInputs& inputs)
{
    const bool composite = name == "composite";
    const bool reversed = composite && c.depth.reversed;
    osg::Viewport* viewport = inputs.viewport ? inputs.viewport : c.view.viewport();
    std::vector<Sampler> all = {{"albedoMap", c.gbuffer.albedo.get()},
                                {"normalMap", c.gbuffer.normal.get()},
                                {"specularMap", c.gbuffer.specular.get()},
                                {"depthMap", c.gbuffer.depth.get()}};
    all.insert(all.end(), inputs.samplers.begin(), inputs.samplers.end());
    ViewData::StateKey key{name + (inputs.adds ? " adds" : "") + (reversed ? " reversed" : ""), inputs.defines, {viewport}};
    for (const Sampler& sampler : all) key.objects.push_back(sampler.texture);
    for (const osg::ref_ptr<osg::Uniform>& u : inputs.uniforms) key.objects.push_back(u.get());
    ViewData::State state = c.view.state(key);
    osg::StateSet& s = state.stateSet;
    if (!state.isNew) return s;
    s.setName("osgEnvLight " + name);
    for (const osg::ref_ptr<osg::Uniform>& u : inputs.uniforms) s.addUniform(u.get());
    for (const std::string& d : inputs.defines) s.setDefine(d);
    s.setAttribute(_library->program("pass/fullscreen.vert", "pass/" + name + ".frag"), on);
    for (GLenum mode : {GLenum(GL_BLEND), GLenum(GL_CULL_FACE), GLenum(GL_LIGHTING), GLenum(GL_ALPHA_TEST)}) s.setMode(mode, off);
    for (GLenum plane = GL_CLIP_PLANE0; plane < GL_CLIP_PLANE0 + 6; ++plane) s.setMode(plane, off);
    if (inputs.adds) s.setAttributeAndModes(new osg::BlendFunc(GL_ONE, GL_ONE), on);
    s.setAttribute(new osg::PolygonMode, on);
    const auto test = reversed ? osg::Depth::GEQUAL : osg::Depth::LEQUAL;
    s.setAttributeAndModes(new osg::Depth(composite ? test : osg::Depth::ALWAYS, 0, 1, composite), composite ? on : off);
    if (!composite) s.setAttribute(viewport);
    for (unsigned unit = 0; unit < all.size(); ++unit) bind(s, unit, all[unit]);
    return s;
}

osg::Texture* DeferredTechnique::albedoTable()
{
    if (!_albedoTable) {
        _albedoTable = new osg::Texture2D(albedoTableImage());
        _albedoTable->setInternalFormat(GL_RG32F);
        _albedoTable->setFilter(osg::Texture::MIN_FILTER, osg::Texture::LINEAR);
        _albedoTable->setFilter(osg::Texture::MAG_FILTER, osg::Texture::LINEAR);
        _albedoTable->setWrap(osg::Texture::WRAP_S, osg::Texture::CLAMP_TO_EDGE);
        _albedoTable->setWrap(osg::Texture::WRAP_T, osg::Texture::CLAMP_TO_EDGE);
    }
    return _albedoTable.get();
}

void DeferredTechnique::prepare(FullScreen& triangle, const osg::StateSet& state, const Cull& c) const
{
    triangle.textureUnits = std::max(state.getNumTextureAttributeLists(), c.view.plan.atlas ? Frame::atlasLightUnit + 1 : 0u);
    triangle.mapFromWorld = c.mapFromWorld;
    triangle.subpixel = c.subpixel;
    triangle.depth = c.depth;
    triangle.timed = c.timed;
}

void DeferredTechnique::addPass(Cull& c, osgUtil::CullVisitor& cv, const std::string& name, Target& target, osg::StateSet& state,
                                const ShadowPlaces& places)
{
    osg::ref_ptr<Pass>& pass = c.frame.passes[name];
    if (!pass) pass = new Pass(new FullScreen(name, &c.view.timer(name), c.frame.triangle.get()));
    auto& triangle = static_cast<FullScreen&>(pass->drawable());
    prepare(triangle, state, c);
    triangle.atlasOrigin = places.origin;
    pass->add(c.host, *target.camera, *target.viewport, state, places.uniforms ? *places.uniforms : *c.frame.uniforms,
              cv.getProjectionMatrix(), cv.getModelViewMatrix());
}

void DeferredTechnique::addPasses(Cull& c, osgUtil::CullVisitor& cv)
{
    if (c.rests()) {
        awaitLights(c);
        return;
    }
    if (c.ownGBuffer) c.host.addPreRenderStage(c.frame.gbufferStage.get(), afterHosts);
    const FramePlan& plan = c.view.plan;
    MapTextures& textures = c.view.textures();
    const auto halves = [](size_t count) { return std::vector<GLint>(count, GL_RGBA16F_ARB); };
    Target* lit = plan.sceneLights ? &lightTarget(c) : nullptr;
    Target* seen = plan.sunShadows ? &c.view.target("sunshadow", halves((plan.suns + 1) / 2)) : nullptr;
    Target* visibility = plan.sunShadows ? &c.view.target("sunfilter", halves((plan.suns + 3) / 4)) : nullptr;
    const size_t diffuseTargets = !plan.sunDiffuse ? 1 : plan.sunShadows ? 3 : 2;
    Target* diffuse = plan.diffuse ? &c.view.target("diffuse", halves(diffuseTargets)) : nullptr;
    // A mirrored sun exceeds half floats in units of the map's mean.
    const std::vector<GLint> lobe = {GL_RGBA32F_ARB, GL_RGBA16F_ARB};
    Target* specular = plan.specular ? &c.view.target("specular", plan.lobes ? lobe : std::vector<GLint>{lobe[0]}) : nullptr;
    Target* sums = plan.occlusion ? &c.view.target("occlusion", halves(plan.lobes ? 3 : 2)) : nullptr;
    Target* filtered = plan.occlusion ? &c.view.target("filter", halves(plan.lobes ? 2 : 1)) : nullptr;
    const int bounceBlocks = 32;  // as in pass/bounce.frag
    Target* blocks = plan.bounce ? &c.view.target("bounce", std::vector<GLint>(5, GL_RGBA32F_ARB), bounceBlocks) : nullptr;
    const int bounceSums = 8;  // five are used
    Target* bounce = plan.bounce ? &c.view.target("bouncesum", {GL_RGBA32F_ARB}, bounceSums) : nullptr;
    Target* points = c.measures ? &c.view.target("seen", {GL_RGBA32F_ARB}, DepthProbe::side) : nullptr;
    for (const PassReport& r : plan.passes)
        if (!r.runs) c.view.dropTarget(r.pass);
    if (!plan.bounce) c.view.dropTarget("bouncesum");

    if (lit) addSceneLights(c, cv, *lit);
    if (points) addSeenPoints(c, cv, *points);
    if (c.shadesSuns()) addSunShadows(c, cv, *seen, *visibility);
    if (diffuse) {
        PassInputs in;
        if (plan.diffuseLights) {
            in.samplers.push_back({"diffuseLightMap", textures.diffuseLights()});
        } else {
            in.defines.push_back(plan.diffuseHarmonics == 9 ? "DIFFUSE_SH_9" : "DIFFUSE_SH_18");
            in.uniforms.push_back(textures.harmonics());
        }
        addLobes(c, in);
        if (plan.sunDiffuse) in.defines.push_back("HAS_SUNS");
        if (plan.sunDiffuse && c.shadesSuns()) addSunVisibility(c, in);
        if (plan.sunDiffuse) textures.addSuns(in.uniforms);
        addPass(c, cv, "diffuse", *diffuse, passState(c, "diffuse", in));
    }
    if (sums && !c.adds()) addOcclusion(c, cv, *sums, *filtered);
    if (specular) {
        PassInputs in;
        in.samplers = {{"pyramidMap", textures.pyramid()}, {"latlongMap", textures.latlong()}};
        addLobes(c, in);
        if (plan.suns) in.defines.push_back("HAS_SUNS");
        if (c.shadesSuns()) addSunVisibility(c, in);
        if (plan.lobes) {
            in.defines.push_back("HAS_LOBES");
            if (c.adds()) in.defines.push_back("LOBES_UNOCCLUDED");
            in.samplers.push_back({"lobeSeenMap", filtered->textures[1].get()});
        }
        if (plan.suns) textures.addSuns(in.uniforms);
        addPass(c, cv, "specular", *specular, passState(c, "specular", in));
    }
    if (c.adds()) {
        addAccumulation(c, cv);
        return;
    }
    if (blocks) addBounce(c, cv, *blocks, *bounce);
    if (c.still) addStillPicture(c, cv);
}

// Those that are in view.
void DeferredTechnique::addLobes(const Cull& c, PassInputs& inputs)
{
    if (c.view.plan.surfaces.phong) inputs.defines.push_back("HAS_PHONG");
    if (!c.view.plan.surfaces.cookTorrance) return;
    inputs.defines.push_back("HAS_COOK_TORRANCE");
    inputs.samplers.push_back({"albedoTable", albedoTable()});
}

// What pass/terms.glsl reads.
DeferredTechnique::PassInputs DeferredTechnique::diffuseTerms(Cull& c)
{
    const FramePlan& plan = c.view.plan;
    PassInputs in;
    in.samplers.push_back({"emissionMap", c.gbuffer.emission.get()});
    if (plan.diffuse) {
        in.defines.push_back("HAS_DIFFUSE");
        in.samplers.push_back({"diffuseTermMap", c.view.target("diffuse", {}).textures[0].get()});
    }
    if (plan.diffuse && plan.sunDiffuse) {
        in.defines.push_back("HAS_SUNS");
        in.samplers.push_back({"sunDiffuseMap", c.view.target("diffuse", {}).textures[1].get()});
        if (c.shadesSuns()) {
            in.defines.push_back("HAS_SUN_SHADOWS");
            in.samplers.push_back({"sunShadedMap", c.view.target("diffuse", {}).textures[2].get()});
        }
    }
    if (plan.occlusion) {
        in.defines.push_back("HAS_OCCLUSION");
        in.samplers.push_back({"occlusionTermMap", c.view.target("filter", {}).textures[0].get()});
    }
    if (c.settings.combine == Settings::SUBTRACT) in.defines.push_back("COMBINE_SUBTRACT");
    return in;
}

void DeferredTechnique::addBounce(Cull& c, osgUtil::CullVisitor& cv, Target& blocks, Target& sums)
{
    PassInputs first = diffuseTerms(c);
    first.viewport = blocks.viewport.get();
    addPass(c, cv, "bounce", blocks, passState(c, "bounce", first));
    PassInputs second;
    second.viewport = sums.viewport.get();
    second.samplers = {{"plainMap", blocks.textures[0].get()},
                       {"alongXMap", blocks.textures[1].get()},
                       {"alongYMap", blocks.textures[2].get()},
                       {"alongZMap", blocks.textures[3].get()},
                       {"sentOnMap", blocks.textures[4].get()}};
    addPass(c, cv, "bouncesum", sums, passState(c, "bouncesum", second));
}

void DeferredTechnique::addOcclusion(Cull& c, osgUtil::CullVisitor& cv, Target& sums, Target& filtered)
{
    const FramePlan& plan = c.view.plan;
    MapTextures& textures = c.view.textures();
    PassInputs in;
    ShadowPlaces places;
    if (plan.atlas) {
        ShadowAtlas& atlas = *skyAtlas(c).maps;
        places = placesOf(c, "atlas", atlas, c.finer);
        in.defines.push_back("HAS_ATLAS");
        addMaps(in, atlas, c.finer);
    } else {
        in.samplers = {{"occlusionLightMap", textures.occlusionLights(plan.occlusionLights)}};
    }
    // Beside the atlas it is slices, whatever the method of the screen alone.
    static const char* const methods[] = {"OCCLUSION_SLICES", "OCCLUSION_RAYS", "OCCLUSION_POINTS", "OCCLUSION_HORIZONS",
                                          "OCCLUSION_BENT_NORMAL"};
    if (plan.screen) in.defines.push_back(methods[plan.atlas ? Settings::SLICE : c.settings.occlusionMethod]);
    if (plan.lobes) in.defines.push_back("HAS_LOBES");
    addPass(c, cv, "occlusion", sums, passState(c, "occlusion", in), places);
    PassInputs filter;
    if (c.settings.combine == Settings::SUBTRACT) filter.defines.push_back("COMBINE_SUBTRACT");
    filter.samplers = {{"numMap", sums.textures[0].get()}, {"denMap", sums.textures[1].get()}};
    if (plan.lobes) {
        filter.defines.push_back("HAS_LOBES");
        filter.samplers.push_back({"lobeMap", sums.textures[2].get()});
    }
    addPass(c, cv, "filter", filtered, passState(c, "filter", filter));
}

// What pass/picture.glsl reads.
DeferredTechnique::PassInputs DeferredTechnique::pictureInputs(Cull& c)
{
    const FramePlan& plan = c.view.plan;
    PassInputs in = diffuseTerms(c);
    auto addTerm = [&](bool has, const char* define, const char* name, const char* pass) {
        if (!has) return;
        in.defines.push_back(define);
        in.samplers.push_back({name, c.view.target(pass, {}).textures[0].get()});
    };
    addTerm(plan.specular, "HAS_SPECULAR", "specularTermMap", "specular");
    addTerm(plan.bounce, "HAS_BOUNCE", "bounceMap", "bouncesum");
    if (plan.bounce && plan.lobes) {
        in.defines.push_back("HAS_LOBES");
        in.samplers.push_back({"blockedLobeMap", c.view.target("specular", {}).textures[1].get()});
    }
    if (c.background != Settings::BACKGROUND_OFF) in.defines.push_back("BACKGROUND");
    if (c.background == Settings::BACKGROUND_BLUR) {
        in.defines.push_back("BACKGROUND_BLUR");
        in.samplers.push_back({"pyramidMap", c.view.textures().pyramid()});
    }
    if (c.background == Settings::BACKGROUND_ON || c.settings.view == Settings::LIGHT_LIST)
        in.samplers.push_back({"latlongMap", c.view.textures().latlong()});
    return in;
}

DeferredTechnique::PassInputs DeferredTechnique::compositeInputs(Cull& c)
{
    const Settings& s = c.settings;
    PassInputs in;
    std::vector<std::string>& defines = in.defines;
    std::vector<Sampler>& samplers = in.samplers;
    if (c.still && c.still->frames() > 0) {
        defines.push_back("ACCUMULATED");
        if (c.background != Settings::BACKGROUND_OFF) defines.push_back("BACKGROUND");
        samplers = {{"stillMap", c.view.target("still", {}).textures[0].get()},
                    {"accumulatedMap", c.view.target("accumulate", {}).textures[0].get()}};
    } else {
        in = pictureInputs(c);
    }
    if (s.output == Settings::LINEAR) defines.push_back("OUTPUT_LINEAR");
    if (s.view != Settings::BEAUTY) defines.push_back("VIEW_TERM");
    if (s.view == Settings::LIGHT_LIST) {
        samplers.push_back({"diffuseLightMap", c.view.textures().diffuseLights()});
        c.view.textures().addSuns(in.uniforms);
    }
    return in;
}

void DeferredTechnique::addComposite(Cull& c, osgUtil::CullVisitor& cv)
{
    osg::StateSet& state = passState(c, "composite", compositeInputs(c));
    if (!c.frame.composite) c.frame.composite = new FullScreen("composite", &c.view.timer("composite"), c.frame.triangle.get());
    prepare(*c.frame.composite, state, c);
    c.frame.composite->owner = this;
    cv.pushStateSet(&state);
    cv.pushStateSet(c.frame.uniforms.get());
    cv.addDrawable(c.frame.composite.get(), cv.getModelViewMatrix());
    cv.popStateSet();
    cv.popStateSet();
}

}  // namespace osgEnvLight

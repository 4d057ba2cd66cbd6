// SPDX-License-Identifier: MIT
#include "passes/StillView.h"

#include "base/Limits.h"
#include "base/R2Points.h"
#include "passes/Inputs.h"

#include <osgUtil/CullVisitor>

#include <cmath>

namespace osgEnvLight
{

namespace
{

// Draws the blocks and reads them back.
class ErrorReader : public FullScreen
{
  public:
    using FullScreen::FullScreen;

    void drawImplementation(osg::RenderInfo& renderInfo) const override
    {
        FullScreen::drawImplementation(renderInfo);
        const int side = limits::ERROR_BLOCKS;
        std::vector<osg::Vec4f> blocks(size_t(side * side));
        glReadPixels(0, 0, side, side, GL_RGBA, GL_FLOAT, blocks.data());
        double square = 0.0, light = 0.0, pixels = 0.0;
        for (const osg::Vec4f& block : blocks) {
            square += double(block[0]);
            light += double(block[1]);
            pixels += double(block[3]);
        }
        if (accumulation && light > 0.0) accumulation->setStandardError(run, std::sqrt(square * pixels) / light);
    }

    /** Written at cull by the frame that owns this. */
    osg::ref_ptr<const Accumulation> accumulation;
    unsigned run = 0;
};

// Rarely enough not to wait for the GPU in most frames.
bool measuresError(unsigned frames)
{
    return frames >= 4 && (frames & (frames - 1) & 7) == 0;
}

Requirement requireStill(const FrameContext& c)
{
    Requirement still;
    still.unless(!c.settings.accumulate, "switched off");
    still.unless(c.settings.view != Settings::BEAUTY, "an intermediate is shown");
    still.unless(!c.decisions.atlas.needed, "without the atlas there is nothing to converge to: " + c.decisions.atlas.reason);
    still.unless(c.facts.surfaces.deferred == 0, c.facts.whyNoneIsDeferred());
    return still.unless(!c.facts.ownGBuffer, "what the application's own G-buffer shows may move unseen");
}

Accumulation::Key keyOf(const FrameContext& c)
{
    Accumulation::Key key;
    key.view = c.worldFromEye;
    key.projection = *c.cv.getProjectionMatrix();
    key.mapFromWorld = c.mapFromWorld;
    key.radianceScale = c.radianceScale;
    key.settings = &c.settings;
    key.lights = c.lights;
    key.areaLights = c.areaLights;
    key.fog = c.fog;
    key.background = c.background;
    key.textures = c.textures.get();
    key.viewport = c.viewport;
    key.surfaces = surfacesOf(*c.frame.gbufferStage, c.frame.fill->getStateSet(), c.number);
    return key;
}

std::string describeAverage(const Accumulation& a, const Settings& settings)
{
    if (a.frames() == 0) return "begins when nothing moves";
    return "frame " + std::to_string(a.frames()) + " of " + std::to_string(settings.accumulateFrames) + ", " +
           std::to_string(a.lightCount()) + " lights, maps of " + std::to_string(a.mapSize()) + " x " +
           std::to_string(a.mapSize());
}

}  // namespace

Requirement StillView::require(const FrameContext& c) const
{
    return requireStill(c).because(std::to_string(c.settings.accumulateLights) + " lights a frame while nothing moves");
}

void StillView::update(FrameContext& c)
{
    if (!_accumulation) _accumulation = new Accumulation;
    Accumulation& a = *_accumulation;
    a.advance(keyOf(c), !c.skyMaps->moved() && c.waitingMaps == 0 && c.waitingBounces == 0, c.textures->map());
    c.still = &a;
    c.frame.setUniforms(&a);
    if (!c.nearSkyMaps) _near.drop();
    if (!a.adds()) return;
    c.stillMaps = &updateMaps(c, _all, nullptr);
    if (c.nearSkyMaps) c.stillNearMaps = &updateMaps(c, _near, c.nearSkyMaps);
    if (c.canShift()) c.shift(r2Point(a.frames()));
}

ShadowAtlas& StillView::updateMaps(const FrameContext& c, AtlasOwner& owner, const ShadowAtlas* near) const
{
    const Accumulation& a = *_accumulation;
    ShadowAtlas& maps = owner.make(unsigned(a.lights().size()), a.mapSize());
    if (near) maps.setFocus(near->focus());
    maps.turn(a.frames());
    maps.setCasters(c.casters);
    owner.update(c, a.lights(), maps.lights);
    return maps;
}

void StillView::setup(PassBuilder& b, FrameContext& c)
{
    _all.draw(b, c, name(), "stillmaps");
    _near.draw(b, c, name(), "near stillmaps");
}

void StillView::dismiss(FrameContext& c)
{
    _accumulation = nullptr;
    _all.drop();
    _near.drop();
    c.frame.setUniforms(nullptr);
}

void StillView::resizeGLObjectBuffers(unsigned maximum)
{
    _all.resizeGLObjectBuffers(maximum);
    _near.resizeGLObjectBuffers(maximum);
}

void StillView::releaseGLObjects(osg::State* state) const
{
    _all.releaseGLObjects(state);
    _near.releaseGLObjects(state);
}

Requirement AccumulatePass::require(const FrameContext& c) const
{
    return requireStill(c);
}

void AccumulatePass::setup(PassBuilder& b, FrameContext& c)
{
    const Accumulation& a = *c.still;
    c.remark(describeAverage(a, c.settings));
    const TextureId average = b.create("average", {GL_RGBA32F_ARB, 0, true});
    const TextureId squares = b.create("average of squares", {GL_R32F, 0, true});
    if (!a.adds()) {
        b.keepContents();
        return;
    }
    b.readGBuffer();
    readPicture(b, c);
    readFog(b, c);
    if (b.read("gathered", "gatheredMap")) b.define("HAS_GATHERED");
    readSkyMaps(b, c, "accumulate", *c.stillMaps, c.stillNearMaps);
    b.define("MAP_IS_BLACK", c.facts.mapIsBlack);
    readLobes(b, c);
    for (const TextureId target : {average, squares}) a.frames() > 1 ? b.addTo(target) : b.write(target);
}

Requirement StillErrorPass::require(const FrameContext& c) const
{
    return requireStill(c).because("measured in every eighth frame");
}

void StillErrorPass::setup(PassBuilder& b, FrameContext& c)
{
    if (!c.isAccumulating() || !measuresError(c.still->frames())) return;
    b.readGBuffer();
    b.read(b.find("average"), "accumulatedMap");
    b.read(b.find("average of squares"), "squareMap");
    b.write(b.create("still error", {GL_RGBA32F_ARB, limits::ERROR_BLOCKS}));
    b.triangle([vertices = c.frame.triangle] { return new ErrorReader(vertices.get()); },
               [still = osg::ref_ptr<const Accumulation>(c.still)](FullScreen& t) {
                   auto& reader = static_cast<ErrorReader&>(t);
                   reader.accumulation = still;
                   reader.run = still->run();
               });
}

}  // namespace osgEnvLight

// SPDX-License-Identifier: MIT
// A still view that converges: when it stands still, and what its frames draw.
#include "node/DeferredTechnique.h"

#include <osgUtil/CullVisitor>

#include <cmath>

namespace osgEnvLight
{

namespace
{

const int errorBlocks = 32;  // as in pass/stillerror.frag

// Draws the blocks and reads them back.
class ErrorReader : public FullScreen
{
  public:
    explicit ErrorReader(GpuTimer* timer) : FullScreen("stillerror", timer) {}

    void drawImplementation(osg::RenderInfo& renderInfo) const override
    {
        FullScreen::drawImplementation(renderInfo);
        std::vector<osg::Vec4f> blocks(size_t(errorBlocks * errorBlocks));
        glReadPixels(0, 0, errorBlocks, errorBlocks, GL_RGBA, GL_FLOAT, blocks.data());
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

std::string describe(const Accumulation& a, const Settings& settings)
{
    if (a.frames() == 0) return "begins when nothing moves";
    return "frame " + std::to_string(a.frames()) + " of " + std::to_string(settings.accumulateFrames) + ", " +
           std::to_string(a.frames() * Accumulation::lightsPerFrame) + " lights, maps of " + std::to_string(a.mapSize()) + " x " +
           std::to_string(a.mapSize());
}

}  // namespace

Accumulation::Key DeferredTechnique::stillKey(Cull& c, osgUtil::CullVisitor& cv)
{
    Accumulation::Key key;
    key.view = c.worldFromEye;
    key.projection = *cv.getProjectionMatrix();
    key.mapFromWorld = c.mapFromWorld;
    key.radianceScale = c.radianceScale;
    key.settings = &c.settings;
    key.lights = c.lights;
    key.background = c.background;
    key.textures = &c.view.textures();
    key.surfaces = surfacesOf(*c.frame.gbufferStage, c.frame.fill->getStateSet());
    return key;
}

void DeferredTechnique::advanceStillView(Cull& c, osgUtil::CullVisitor& cv)
{
    ViewData& v = c.view;
    if (!v.plan.accumulate) {
        v.dropAccumulation();
        for (const char* pass : {"still", "accumulate", "stillerror"}) v.dropTarget(pass);
        v.dropAtlas("accumulate");
        v.dropAtlas("accumulate finer");
        c.frame.setUniforms(nullptr);
    } else {
        v.target("still", {GL_RGBA32F_ARB});
        v.target("accumulate", {GL_RGBA32F_ARB, GL_R32F});
        v.target("stillerror", {GL_RGBA32F_ARB}, errorBlocks);
        Accumulation& a = v.accumulation();
        a.advance(stillKey(c, cv), !skyAtlas(c).maps->moved() && _waitingMaps == 0, v.textures().map());
        c.still = &a;
        c.frame.setUniforms(&a);
        if (a.adds()) v.atlas("accumulate", Accumulation::lightsPerFrame, a.mapSize());
        if (a.adds() && c.finer) v.atlas("accumulate finer", Accumulation::lightsPerFrame, a.mapSize());
        // What is drawn forward has no offset, nor has a background of the host's.
        if (a.adds() && v.plan.surfaces.forward == 0 && c.background != Settings::BACKGROUND_OFF) {
            const osg::Vec2d offset = r2Point(a.frames()) - osg::Vec2d(0.5, 0.5);
            c.subpixel = osg::Vec2d(2.0 * offset[0] / v.width(), 2.0 * offset[1] / v.height());
        }
        for (PassReport& r : v.plan.passes)
            if (r.pass == "accumulate") r.reason = describe(a, c.settings);
    }
    if (c.frame.subpixel) c.frame.subpixel->set(osg::Vec2(c.subpixel));
}

void DeferredTechnique::addStillPicture(Cull& c, osgUtil::CullVisitor& cv)
{
    addPass(c, cv, "still", c.view.target("still", {}), passState(c, "still", pictureInputs(c)));
}

void DeferredTechnique::addAccumulation(Cull& c, osgUtil::CullVisitor& cv)
{
    const Accumulation& a = *c.still;
    ShadowAtlas* maps[] = {nullptr, nullptr};
    for (const bool finer : {false, true}) {
        if (finer && !c.finer) continue;
        ViewData::Atlas& atlas =
            c.view.atlas(finer ? "accumulate finer" : "accumulate", Accumulation::lightsPerFrame, a.mapSize());
        maps[finer] = atlas.maps.get();
        if (finer) atlas.maps->setFocus(c.finer->focus());
        atlas.maps->turn(a.frames());
        atlas.maps->setCasters(c.casters);
        refreshAtlas(c, cv, finer ? "stillmaps finer" : "stillmaps", atlas, a.lights(), Accumulation::lightsPerFrame);
    }

    Target& average = c.view.target("accumulate", {});
    PassInputs in = pictureInputs(c);
    in.adds = a.frames() > 1;
    addMaps(in, *maps[0], maps[1]);
    addLobes(c, in);
    addPass(c, cv, "accumulate", average, passState(c, "accumulate", in), placesOf(c, "accumulate", *maps[0], maps[1]));
    if (measuresError(a.frames())) addStillError(c, cv, average);
}

void DeferredTechnique::addStillError(Cull& c, osgUtil::CullVisitor& cv, Target& average)
{
    Target& blocks = c.view.target("stillerror", {});
    PassInputs in;
    in.viewport = blocks.viewport.get();
    in.samplers = {{"accumulatedMap", average.textures[0].get()}, {"squareMap", average.textures[1].get()}};
    osg::ref_ptr<Pass>& pass = c.frame.passes["stillerror"];
    if (!pass) pass = new Pass(new ErrorReader(&c.view.timer("stillerror")));
    auto& reader = static_cast<ErrorReader&>(pass->drawable());
    reader.accumulation = c.still;
    reader.run = c.still->run();
    addPass(c, cv, "stillerror", blocks, passState(c, "stillerror", in));
}

}  // namespace osgEnvLight

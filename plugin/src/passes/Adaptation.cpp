// SPDX-License-Identifier: MIT
#include "passes/Adaptation.h"

#include "base/Limits.h"
#include "passes/Inputs.h"

#include <osgUtil/CullVisitor>

#include <cmath>

namespace osgEnvLight
{

namespace
{

// 5 % of a change are left then.
const double timesUntilAdapted = 3.0;

Requirement requireAdaptation(const FrameContext& c)
{
    Requirement adaptation;
    adaptation.unless(c.settings.view != Settings::BEAUTY, "an intermediate is shown");
    adaptation.unless(c.settings.output == Settings::LINEAR, "the host gets linear radiance");
    adaptation.unless(c.settings.exposureBase != Settings::EXPOSURE_PICTURE, "the exposure does not follow the picture");
    return adaptation;
}

}  // namespace

double secondsBetween(const osg::FrameStamp* former, const osg::FrameStamp* now)
{
    const double unknown = 1.0 / 60.0;
    if (!former || !now) return unknown;
    const double simulated = now->getSimulationTime() - former->getSimulationTime();
    if (simulated > 0.0) return simulated;
    const double passed = now->getReferenceTime() - former->getReferenceTime();
    return passed > 0.0 ? passed : unknown;
}

Requirement MeterPass::require(const FrameContext& c) const
{
    Requirement meter = requireAdaptation(c);
    meter.unless(c.facts.surfaces.deferred == 0, c.facts.whyNoneIsDeferred());
    return meter.because("the exposure follows the light on what is shown");
}

void MeterPass::setup(PassBuilder& b, FrameContext& c)
{
    b.readGBuffer();
    b.define("HAS_CATCHERS", c.facts.surfaces.catchers > 0);
    b.read(b.find("emission"), "emissionMap");
    b.read(b.find("radiance"), "radianceMap");
    b.write(b.create("metered", {GL_RG32F, limits::METER_SIDE}));
}

Requirement AdaptationPass::require(const FrameContext& c) const
{
    return requireAdaptation(c).because("the exposure follows the light on what is shown, in time");
}

bool AdaptationPass::changes(const FrameContext& c) const
{
    return !c.former || c.former->worldFromEye != c.worldFromEye ||
           !sameProjection(c.former->projection, *c.cv.getProjectionMatrix()) || _casters != c.casters.version ||
           c.waitingMaps + c.waitingBounces > 0;
}

void AdaptationPass::update(FrameContext& c)
{
    const double time = double(c.settings.adaptationTime);
    const double seconds = secondsBetween(_former, c.cv.getFrameStamp());
    _former = c.cv.getFrameStamp() ? new osg::FrameStamp(*c.cv.getFrameStamp()) : nullptr;
    c.frame.setAdaptedShare(time > 0.0 ? 1.0 - std::exp(-seconds / time) : 1.0);
    _stillFor = changes(c) ? 0.0 : _stillFor + seconds;
    _casters = c.casters.version;
    c.adapts = _stillFor < timesUntilAdapted * time;
}

void AdaptationPass::setup(PassBuilder& b, FrameContext& c)
{
    const TextureId metered = b.find("metered");
    if (!metered.valid() && !_hasStops) return;
    const TextureDesc one{GL_R32F, 1, true};
    const TextureId stops[2] = {b.create("stops", one), b.create("other stops", one)};
    if (!metered.valid()) {
        b.keepContents();
        c.adaptedStops = stops[_side];
        return;
    }
    b.read(metered, "meteredMap");
    if (_hasStops) {
        b.define("HISTORY");
        b.read(stops[_side], "formerStopsMap");
    }
    _side = 1 - _side;
    b.write(stops[_side]);
    c.adaptedStops = stops[_side];
    _hasStops = true;
}

void AdaptationPass::dismiss(FrameContext&)
{
    _hasStops = false;
    _former = nullptr;
}

}  // namespace osgEnvLight

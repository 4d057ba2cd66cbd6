// SPDX-License-Identifier: MIT
#include "passes/Temporal.h"

#include "base/R2Points.h"
#include "passes/Inputs.h"

#include <osgUtil/CullVisitor>

namespace osgEnvLight
{

Requirement TemporalPass::require(const FrameContext& c) const
{
    Requirement temporal = c.decisions.average;
    return temporal.because("edges, and what flickers, averaged over frames");
}

void TemporalPass::update(FrameContext& c)
{
    _continues = c.former && _hasPicture;
    if (_continues && !c.hasFirstFrame() && c.canShift()) c.shift(r2Point(c.number));
}

void TemporalPass::setup(PassBuilder& b, FrameContext& c)
{
    const TextureDesc picture{GL_RGBA16, 0, true, false, true};
    const TextureDesc distance{GL_R32F, 0, true};
    const TextureId pictures[2] = {b.create("history", picture), b.create("other history", picture)};
    const TextureId places[2] = {b.create("history places", distance), b.create("other history places", distance)};
    const int former = _side;
    _side = 1 - _side;
    b.read("display", "displayMap");
    b.read("depth", "depthMap");
    if (c.facts.surfaces.catchers > 0 && c.background != Settings::BACKGROUND_OFF && !isMapOnGround(c)) {
        b.define("HAS_CATCHERS");
        b.read("normal", "normalMap");
        b.read("specular properties", "specularMap");
    }
    b.define("ACCUMULATED", c.hasFirstFrame());
    if (_continues) {
        b.define("HISTORY");
        b.read(pictures[former], "historyMap");
        b.read(places[former], "placeMap");
        const osg::Matrixd formerEyeFromEye = c.worldFromEye * osg::Matrixd::inverse(c.former->worldFromEye);
        b.frameUniforms(&c.frame.historyState(formerEyeFromEye, c.former->projection));
        b.define("MOTION", !c.hasFirstFrame() && b.read("motion", "motionMap"));
    }
    b.write(pictures[_side]);
    b.write(places[_side]);
    c.shownPicture = pictures[_side];
    c.shownPlaces = places[_side];
    _hasPicture = true;
}

void TemporalPass::dismiss(FrameContext&)
{
    _hasPicture = false;
}

}  // namespace osgEnvLight

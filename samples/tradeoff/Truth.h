// SPDX-License-Identifier: MIT
// What the measured pictures are held against.
#pragma once

#include "ReferenceScene.h"
#include "Report.h"

#include <metrics/Mask>

#include <map>

namespace tradeoff
{

struct Truth {
    using Layer = osgEnvLight::Layer;
    using Picture = osgEnvLight::Picture;

    bool full = false;  // beauty has light from surface to surface
    std::map<Layer, Picture> means;
    std::map<Layer, Picture> standardErrors;
    osgEnvLight::Mask mask;      // geometry without its edges
    osgEnvLight::Mask deferred;  // of that, what is not seen through a transparent surface: the terms are of no others
    double exposure = 0.0;       // [stops]
    std::string statement;
    bool interrupted = false;

    const osgEnvLight::Mask& maskOf(Layer layer) const { return layer == Layer::BEAUTY ? mask : deferred; }
    const Picture& operator[](Layer layer) const { return means.at(layer); }
};

struct TruthOptions {
    bool full = false;
    double error = 0.005;  // of the beauty picture, relative
    double seconds = 300;  // at most
    double reach = 0.0;    // of the occlusion's rays, in the scene's units
};

/** Ray trace it. @param progress  of all of it in [0,1]; false interrupts */
Truth makeTruth(const ReferenceScene& scene, const TruthOptions& options, const std::function<bool(double, double)>& progress);

/** How far a picture is from one of the layers. */
Figures figuresOf(const osgEnvLight::Picture& picture, const Truth& truth, osgEnvLight::Layer layer);

}  // namespace tradeoff

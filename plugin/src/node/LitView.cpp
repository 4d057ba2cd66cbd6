// SPDX-License-Identifier: MIT
#include "node/LitView.h"

#include "passes/Adaptation.h"
#include "passes/AreaLights.h"
#include "passes/Caustics.h"
#include "passes/Gather.h"
#include "passes/Guides.h"
#include "passes/Indirect.h"
#include "passes/Lighting.h"
#include "passes/Links.h"
#include "passes/LobeRays.h"
#include "passes/Motion.h"
#include "passes/NearLight.h"
#include "passes/Occlusion.h"
#include "passes/Output.h"
#include "passes/PixelMarks.h"
#include "passes/SceneLights.h"
#include "passes/SeenPoints.h"
#include "passes/SkyShadows.h"
#include "passes/Specular.h"
#include "passes/StillView.h"
#include "passes/SunPasses.h"
#include "passes/Temporal.h"

namespace osgEnvLight
{

LitView::LitView(Failure* failure, RetiredObjects* retired, SurfaceSorter* sorter)
    : ViewData(failure, retired), gbufferPass(new GBufferPass(sorter, failure))
{
    graph.add(gbufferPass);
    graph.add(new PixelMarksPass);
    graph.add(new SeenPointsPass);
    graph.add(new SceneLightMapsPass(failure, retired));
    graph.add(new SceneLightsPass);
    graph.add(new AreaMapsPass(failure, retired));
    graph.add(new AreaShadowPass);
    graph.add(new AreaRowsPass);
    graph.add(new AreaFilterPass);
    graph.add(new LightTotalsPass);
    graph.add(new AreaLightsPass);
    graph.add(new SkyShadows(failure, retired));
    graph.add(new LinksPass(retired));
    graph.add(new StillView(failure, retired));
    graph.add(new Suns);
    graph.add(new SunMaps(failure, retired));
    graph.add(new ReflectiveMapsPass(failure, retired));
    graph.add(new VirtualLightsPass);
    graph.add(new PointsPass);
    graph.add(new BouncesPass(failure));
    graph.add(new SunShadowPass);
    graph.add(new SunQuadsPass);
    graph.add(new PenumbraPass);
    graph.add(new SunFilterPass);
    graph.add(new DiffusePass);
    graph.add(new OcclusionPass);
    graph.add(new GlossyOcclusionPass);
    graph.add(new FilterRowsPass);
    graph.add(new FilterPass);
    graph.add(new SpecularPass);
    graph.add(new LobeRowsPass);
    graph.add(new CoatPass);
    graph.add(new LobesPass);
    graph.add(new BouncePass);
    graph.add(new BounceSumPass);
    graph.add(new CausticsPass);
    graph.add(new CausticRowsPass);
    graph.add(new CausticFilterPass);
    graph.add(new IndirectPass);
    graph.add(new NearLightPass);
    graph.add(new NearLightFilterPass);
    graph.add(new BackgroundPass);
    graph.add(new ResolvePass);
    graph.add(new ReflectionsPass);
    graph.add(new ReflectionFilterPass);
    graph.add(new GuidesPass);
    graph.add(new GatherPass);
    graph.add(new GatherFilterPass);
    graph.add(new LobeRaysPass);
    graph.add(new LobeRayLightPass);
    graph.add(new LobeRayFilterPass);
    graph.add(new AccumulatePass);
    graph.add(new StillErrorPass);
    graph.add(new MeterPass);
    graph.add(new AdaptationPass);
    graph.add(new DisplayPass);
    graph.add(new MotionPass);
    graph.add(new TemporalPass);
    graph.add(new CompositePass);
    graph.add(new ForwardPass);
}

}  // namespace osgEnvLight

// SPDX-License-Identifier: MIT
#include "passes/Links.h"

#include "base/Limits.h"
#include "passes/Gather.h"
#include "passes/NearLight.h"

#include <algorithm>
#include <cmath>

namespace osgEnvLight
{

namespace
{

const double reserve = 0.1;    // of the focus' radius, that the view may move: a third of what the finest grid shows about it
const int mostAboutView = 20;  // probes along an axis: they share what a texture's height allows
const double shareStep = 1.0 / 16.0;  // by which the probes' answer takes the place of the mean in a frame

double mostReflectedBy(const StaticCasters::Parts& parts)
{
    float most = 0.0f;
    for (const StaticCasters::Part& part : parts)
        for (int k = 0; k < 3; ++k) most = std::max(most, part.sent.diffuse[k] + part.sent.glossy[k]);
    return most;
}

}  // namespace

Requirement requireProbes(const FrameContext& c)
{
    Requirement probes;
    probes.unless(c.settings.bounce == Settings::BOUNCE_OFF, "switched off");
    probes.unless(c.settings.bounce == Settings::BOUNCE_MEAN, "bounce is mean");
    probes.unless(!c.decisions.occlusion.needed, "no light is blocked");
    return probes.unless(!c.decisions.atlas.needed, "without the atlas nobody knows how much of the map a surface sees");
}

Requirement LinksPass::require(const FrameContext& c) const
{
    return requireProbes(c).because("surface points and probes, made on a thread of their own");
}

void LinksPass::update(FrameContext& c)
{
    if (_lost.exchange(false)) _light.fresh = true;
    const StaticCasters& casters = c.skyMaps->still();
    if (const osg::ref_ptr<TransportScene> made = _worker.take()) accept(made);
    Wanted wanted{c.skyMaps, casters.generation(), c.settings.bounceProbes, mostOpenForRays(c), focusOf(c)};
    // A view that keeps moving gets what it is waiting for.
    if (_worker.busy() && wanted.isOfSameCasters(_wanted)) wanted.focus = _wanted.focus;
    if (!(wanted == _wanted)) makeScene(c, wanted);
    if (_isShown && _sentVersion != casters.sentVersion()) {
        _sentVersion = casters.sentVersion();
        showSurfaces(casters.parts());
    }
    keepMirrored();
    if (!_light.scene) ++_frames;
    // The first pictures show the end at once: there is nothing yet that they would jump from.
    const bool first = _frames <= 1 || c.settings.regeneration == Settings::IMMEDIATE;
    if (_light.scene) _light.share = first ? 1.0 : std::min(_light.share + shareStep, 1.0);
    _light.isOfCasters = _isShown;
    c.indirect = _light.scene && !_light.scene->empty() ? &_light : nullptr;
    if (_worker.busy() || (c.indirect && _light.isSettling())) ++c.waitingBounces;
}

// About the eye where it is amid what the view shows. Stays while the view does not come near its border.
TransportFocus LinksPass::focusOf(const FrameContext& c) const
{
    if (!c.nearSkyMaps) return {};
    const osg::BoundingSphered& shown = c.nearSkyMaps->focus();
    const osg::Vec3d eye = c.worldFromEye.getTrans();
    const osg::Vec3d center = (eye - shown.center()).length() < shown.radius() ? eye : shown.center();
    const TransportFocus& former = _wanted.focus;
    if (former.radius == shown.radius() && (center - former.center).length() < reserve * former.radius) return former;
    return {center, shown.radius()};
}

// From glossy surfaces, where the picture does not show what they meet; whether or not the view shows one. A scene that has rays
// keeps them when its last mirror is painted over: it would have to be made anew.
bool LinksPass::wantsRays(const FrameContext& c)
{
    const StaticCasters& casters = c.skyMaps->still();
    const bool isNew = _wanted.atlas != c.skyMaps || _wanted.generation != casters.generation();
    if (isNew || _mirrorsVersion != casters.sentVersion()) {
        const StaticCasters::Parts parts = casters.parts();
        const bool had = _hasMirrors && !isNew;
        _hasMirrors = had || std::any_of(parts.begin(), parts.end(),
                                         [](const StaticCasters::Part& part) { return part.sent.glossy != osg::Vec3f(); });
        _mirrorsVersion = casters.sentVersion();
    }
    return (_hasMirrors &&
            (c.settings.reflections == Settings::REFLECTIONS_SCENE || c.settings.caustics != Settings::CAUSTICS_OFF)) ||
           gathers(c.settings);
}

// As TransportScene takes it.
double LinksPass::mostOpenForRays(const FrameContext& c)
{
    return wantsRays(c) ? 1.0 : mostOpenForNearLight(c.settings);
}

void LinksPass::makeScene(const FrameContext& c, const Wanted& wanted)
{
    _isShown = _isShown && wanted.isOfSameCasters(_wanted);
    _wanted = wanted;
    _wantedParts = c.skyMaps->still().parts();
    TransportFocus view = wanted.focus;
    view.center -= c.skyMaps->origin();
    const int probes = view.radius > 0.0 ? std::min(wanted.probes, mostAboutView) : wanted.probes;
    const auto make = [parts = _wantedParts, origin = c.skyMaps->origin(), probes, mostOpen = wanted.mostOpen,
                       view](const std::atomic<bool>* stop) {
        return osg::ref_ptr<TransportScene>(new TransportScene(tracedScene(parts), origin, probes, mostOpen, view, stop));
    };
    if (c.settings.regeneration == Settings::IMMEDIATE)
        accept(make(nullptr));
    else
        _worker.post([make](const std::atomic<bool>& stop) { return make(&stop); });
}

void LinksPass::accept(const osg::ref_ptr<TransportScene>& scene)
{
    _light.scene = scene;
    _isShown = true;
    _sentVersion = 0;
    if (scene->empty()) return;
    showSurfaces(_wantedParts);
    const int probes = scene->probes();
    if (probes != _light.targets.probes) {  // else what they saw in the former scene is a beginning in this one
        retireTargets();
        _light.targets = TransportTargets(scene->columns, probes);
        _light.fresh = true;
    }
    _light.relinked = true;
    keepPointNear();
    keepCells();
}

void LinksPass::showSurfaces(const StaticCasters::Parts& parts)
{
    _light.diffuse = _light.scene->diffuse(parts);
    _light.glossy = _light.scene->glossy(parts);
    _light.polishedShare = _light.scene->polishedShare(parts);
    _light.emissions = _light.scene->emissions(parts);
    _light.surfaceColors = _light.scene->rays ? SceneRays::colors(parts) : nullptr;
    _light.mostReflected = mostReflectedBy(parts);
}

// The target of what mirrors send, while something is glossy.
void LinksPass::keepMirrored()
{
    osg::ref_ptr<osg::Texture2D>& mirrored = _light.targets.pointMirrored;
    if (_light.targets.probes == 0 || bool(_light.glossy) == bool(mirrored)) return;
    if (_light.glossy) {
        _light.targets.makePointMirrored();
        return;
    }
    _retired->add(mirrored.get());
    mirrored = nullptr;
}

// The target of what points see of others close by, while there are some.
void LinksPass::keepPointNear()
{
    TransportTargets& targets = _light.targets;
    if (bool(_light.scene->pointLinks) == bool(targets.pointNear)) return;
    if (_light.scene->pointLinks) {
        targets.makePointNear();
        return;
    }
    _retired->add(targets.pointNear.get());
    _retired->add(targets.nearTarget.get());
    targets.pointNear = nullptr;
    targets.nearTarget = nullptr;
}

// The target of what rays see of surfaces, while there are rays.
void LinksPass::keepCells()
{
    TransportTargets& targets = _light.targets;
    if (targets.cellLight) {
        _retired->add(targets.cellLight.get());
        _retired->add(targets.cellTarget.get());
    }
    targets.cellLight = nullptr;
    targets.cellTarget = nullptr;
    if (const SceneRays* rays = _light.scene->rays) targets.makeCellLight(rays->cellColumns, rays->cellRows);
}

void LinksPass::retireTargets()
{
    if (_light.targets.probes == 0) return;
    for (osg::Texture2D* t : _light.targets.textures()) _retired->add(t);
    for (osg::FrameBufferObject* f : _light.targets.frameBuffers()) _retired->add(f);
}

void LinksPass::setup(PassBuilder&, FrameContext& c)
{
    if (!c.indirect) return;
    const TransportScene& scene = *c.indirect->scene;
    c.remark(
        ", " + std::to_string(limits::POINT_SIDE * limits::POINT_SIDE) + " points, " + std::to_string(scene.count[0]) + " x " +
        std::to_string(scene.count[1]) + " x " + std::to_string(scene.count[2]) + " probes" +
        (scene.lattices > 0 ? ", and as many in each of " + counted(size_t(scene.lattices), "grid") + " about the view" : "") +
        "; 3/8 of them see the map in at most " + std::to_string(int(std::lround(100.0 * scene.openShare))) + " % of directions");
}

void LinksPass::dismiss(FrameContext& c)
{
    if (c.showsNothing && Decisions::wantsAtlas(c.settings)) return;
    _worker.discard();
    retireTargets();
    _light = {};
    _wanted = {};
    _wantedParts.clear();
    _isShown = false;
    _frames = 0;
}

std::vector<osg::Texture2D*> LinksPass::surfaceTextures() const
{
    std::vector<osg::Texture2D*> all;
    for (const auto& t : {_light.diffuse, _light.glossy, _light.emissions, _light.surfaceColors})
        if (t) all.push_back(t.get());
    return all;
}

size_t LinksPass::bytes() const
{
    if (!_light.scene) return 0;
    size_t sum = _light.scene->bytes() + _light.targets.bytes();
    for (const osg::Texture2D* t : surfaceTextures()) sum += bytesOf(*t);
    return sum;
}

void LinksPass::resizeGLObjectBuffers(unsigned maximum)
{
    _light.targets.resizeGLObjectBuffers(maximum);
    if (_light.scene) _light.scene->resizeGLObjectBuffers(maximum);
    for (osg::Texture2D* t : surfaceTextures()) t->resizeGLObjectBuffers(maximum);
}

void LinksPass::releaseGLObjects(osg::State* state) const
{
    _light.targets.releaseGLObjects(state);
    if (_light.scene) _light.scene->releaseGLObjects(state);
    for (const osg::Texture2D* t : surfaceTextures()) t->releaseGLObjects(state);
    _lost = true;
}

}  // namespace osgEnvLight

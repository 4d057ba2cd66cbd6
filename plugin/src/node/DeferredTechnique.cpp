// SPDX-License-Identifier: MIT
#include "node/DeferredTechnique.h"

#include "node/DarkMap.h"
#include "node/HostState.h"
#include "surface/AlbedoTable.h"

#include <osgEnvLight/LitScene>

#include <osg/FrameStamp>
#include <osg/Notify>
#include <osgUtil/CullVisitor>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace osgEnvLight
{

namespace
{

// A shadow map's pass and the like: the camera draws into textures, none of them colour.
bool isDepthOnly(const osg::Camera* camera)
{
    if (!camera || camera->getBufferAttachmentMap().empty()) return false;
    for (const auto& [component, attachment] : camera->getBufferAttachmentMap())
        if (component >= osg::Camera::COLOR_BUFFER) return false;
    return true;
}

unsigned contextID(osgUtil::CullVisitor& cv)
{
    return cv.getState() ? cv.getState()->getContextID() : 0;
}

}  // namespace

DeferredTechnique::DeferredTechnique()
    : _facts(new SurfaceFacts),
      _sorter(new SurfaceSorter(_facts.get())),
      _failure(new Failure),
      _settings(new Settings),
      _retired(new RetiredObjects)
{
    _library = new ShaderLibrary(_failure.get());
}

bool DeferredTechnique::cull(LitScene& node, osgUtil::CullVisitor& cv)
try {
    osgUtil::RenderBin* hostBin = cv.getCurrentRenderBin();
    osgUtil::RenderStage* host = hostBin ? hostBin->getStage() : nullptr;
    if (!host || _failure->happened(contextID(cv))) return false;
    const osg::Viewport* viewport = host->getViewport();
    if (!viewport || !(viewport->width() >= 1.0) || !(viewport->height() >= 1.0)) return false;
    if (isDepthOnly(host->getCamera()) || dynamic_cast<const StageCamera*>(host->getCamera())) return false;

    std::unique_lock<std::mutex> lock(_mutex);
    const osg::ref_ptr<const Settings> settings = currentSettings(node);
    const osg::ref_ptr<MapTextures> textures = currentTextures(node, *settings, cv);
    if (!textures) return false;
    const osg::ref_ptr<LitView> held = &view(node, cv, *host);  // its context may end
    LitView& vd = *held;
    vd.fit(int(viewport->width()), int(viewport->height()));
    GBuffer* gbuffer = gbufferOf(node, vd);
    if (!gbuffer) return false;
    FrameContext c = contextOf(node, vd, *settings, *textures, *gbuffer, cv, *host);
    const bool sunny = Decisions::wantsSunMaps(*settings) && !c.facts.mapIsBlack && !textures->suns().empty();
    if (c.facts.ownGBuffer) vd.gbufferPass->prepareFrame(c, sunny);
    lock.unlock();

    std::vector<ForwardGraph> forward;
    if (c.facts.ownGBuffer) {
        placeGround(c, vd, node, *_facts);
        const auto traverse = [&] {
            node.osg::Group::traverse(cv);
            vd.ground.cull(cv, c.worldFromEye);
        };
        c.facts.surfaces = vd.gbufferPass->cull(c, traverse, forward);
    } else {
        node.osg::Group::traverse(cv);
        c.facts.surfaces = SurfaceKinds();
        c.facts.surfaces.lobes = ~0u;  // any
        c.facts.surfaces.deferred = 1;
    }
    chooseBackground(c, forward);
    findLights(c, vd, forward, [&](const std::string& message) {
        std::lock_guard<std::mutex> guard(_mutex);
        reportOnce(message, osg::NOTICE);
    });
    const auto report = [&](const std::string& message) {
        std::lock_guard<std::mutex> guard(_mutex);
        reportOnce(message);
    };
    findAreaLights(c, vd, report);
    findCasters(c, vd, node, *_facts, sunny, report);

    lock.lock();
    const bool carries = needsCarrier(c);
    if (c.facts.mapIsBlack && c.facts.hasLamps() && settings->bounce != Settings::BOUNCE_OFF) darken(c, _darkTextures);
    light(c, vd, carries);
    for (const ForwardGraph& f : forward) f.bin->addStateGraph(f.graph);
    return true;
} catch (const std::runtime_error& error) {
    _failure->report(contextID(cv), error.what());
    return false;
}

// The application's, or the view's own; null if it does not fit the view.
GBuffer* DeferredTechnique::gbufferOf(LitScene& node, LitView& vd)
{
    GBuffer* gbuffer = node.getGBuffer() ? node.getGBuffer() : &vd.gbuffer();
    if (gbuffer->width == vd.width() && gbuffer->height == vd.height()) return gbuffer;
    reportOnce("the G-buffer is " + std::to_string(gbuffer->width) + "x" + std::to_string(gbuffer->height) +
               ", expected the view's " + std::to_string(vd.width()) + "x" + std::to_string(vd.height()) +
               "; the scene is shown unlit");
    return nullptr;
}

FrameContext DeferredTechnique::contextOf(LitScene& node, LitView& vd, const Settings& settings, MapTextures& textures,
                                          GBuffer& gbuffer, osgUtil::CullVisitor& cv, osgUtil::RenderStage& host)
{
    FrameContext c{cv,      host, vd.frame(&cv), settings,   &textures, gbuffer, *_library, vd.atlasLights, vd.viewport(),
                   nullptr, this, nullptr,       vd.number(), vd.casters};
    vd.timed = node.isTimed();
    if (vd.timed) c.timer = vd.timer.get();
    const EnvironmentMap& map = *node.getEnvironmentMap();
    c.mapFromWorld = osg::Matrixd::rotate(osg::DegreesToRadians(-map.getRotation()), 0, 0, 1);
    if (host.getInitialViewMatrix()) c.worldFromEye = osg::Matrixd::inverse(*host.getInitialViewMatrix());
    if (vd.former.viewport == vd.viewport()) c.former = &vd.former;
    c.radianceScale = textures.map().mean * map.getIntensity();
    const bool follows = settings.output == Settings::DISPLAY && settings.exposureBase != Settings::EXPOSURE_NONE;
    c.baseStops = follows ? textures.exposure() : 0.0;
    c.facts.ownGBuffer = !node.getGBuffer();
    c.facts.mapIsBlack = c.radianceScale <= 0.0;
    c.facts.sceneRadius = node.getBound().valid() ? double(node.getBound().radius()) : 0.0;
    if (c.facts.ownGBuffer) c.depth = DepthConvention::of(*cv.getCurrentStateGraph());
    c.frame.setUniforms(c.facts.sceneRadius, c.radianceScale, textures, c.worldFromEye * c.mapFromWorld, c.baseStops);
    return c;
}

void DeferredTechnique::light(FrameContext& c, LitView& vd, bool needsCarrier)
{
    if (needsCarrier) c.facts.carrier = c.textures->carrier();
    c.facts.suns = c.textures->sunShare();
    c.decisions = Decisions::make(c.facts, c.settings);
    c.albedoTable = albedoTable(c.facts.surfaces.anisotropic());
    vd.graph.run(c);
    vd.former = {c.worldFromEye, *c.cv.getProjectionMatrix(), c.viewport};
    vd.forgetUnused(c.frame);
    _waiting = c.waitingMaps + c.waitingBounces;
    _drawnSunMaps = c.drawnSunMaps;
    const bool lights = c.decisions.light.needed && c.facts.surfaces.deferred > 0;
    vd.plan = {vd.graph.report(), c.facts.surfaces, lights ? c.facts.carrier.lights : 0, c.decisions.occlusionLights,
               c.decisions.suns.needed ? c.facts.suns.count : 0};
    vd.still = c.still;
    vd.unsettled = !hasSettled(c);
    vd.seenUpdates = _updates;
    _lastView = &vd;
}

osg::ref_ptr<const Settings> DeferredTechnique::currentSettings(const LitScene& node)
{
    std::string error;
    const Settings& wanted = *node.getSettings();
    if (!wanted.valid(error)) {
        reportOnce(error + "; the last valid settings stay in force");
        return _settings;
    }
    for (const Settings::Property& p : Settings::table())
        if (p.get(wanted) != p.get(*_settings)) {
            _settings = new Settings(wanted);  // another traversal may still read the former ones
            break;
        }
    return _settings;
}

osg::ref_ptr<MapTextures> DeferredTechnique::currentTextures(const LitScene& node, const Settings& settings,
                                                             osgUtil::CullVisitor& cv)
{
    const EnvironmentMap& map = *node.getEnvironmentMap();
    if (!std::isfinite(map.getIntensity()) || map.getIntensity() < 0.0 || !std::isfinite(map.getRotation())) {
        reportOnce(
            "intensity and rotation of the environment map must be finite, intensity not negative; the scene is shown unlit");
        return nullptr;
    }
    const unsigned frame = cv.getFrameStamp() ? cv.getFrameStamp()->getFrameNumber() : _checkedFrame + 1;
    if (!_started || frame != _checkedFrame) {
        _checkedFrame = frame;
        regenerate(map.state(), settings, map.getLights());
    }
    if (_textures) _textures->use(MapOptions(settings, map.getLights()));
    return _textures;
}

void DeferredTechnique::regenerate(const MapState& state, const Settings& settings,
                                   const std::shared_ptr<const LightList>& lights)
{
    const unsigned framesUntilStill = 8;
    MapRegenerator::Result result;
    if (state != _state || !_started) {
        // Nothing to go on from before the first frame, nor from a map that could not serve: no light is older than these.
        const bool sameImage = _started && state.image == _state.image;
        const bool now = !_textures || settings.regeneration == Settings::IMMEDIATE;
        _state = state;
        _started = true;
        _stillFrames = 0;
        MapTextures::Continuation former = _textures ? _textures->continuation(sameImage) : MapTextures::Continuation();
        former.options = MapOptions(settings, lights);
        if (now) {
            _regenerator.discard();
            accept(MapRegenerator::make(state, former));
        } else {
            _regenerator.post(state, former);
        }
    } else if (++_stillFrames >= framesUntilStill && _textures && !_textures->settled() && !_regenerator.busy()) {
        _regenerator.postSettle(*_textures);
    }
    if (_regenerator.take(result)) accept(result);
}

void DeferredTechnique::accept(const MapRegenerator::Result& result)
{
    _textures = result.textures;
    if (!result.textures) reportOnce(result.error + "; the scene is shown unlit");
    if (result.textures && !result.textures->map().repairs.empty() && _repaired != _state.image) {
        _repaired = _state.image;  // a video says it once
        OSG_WARN << "osgEnvLight: " << result.textures->map().repairs << std::endl;
    }
}

LitView& DeferredTechnique::view(LitScene& node, osgUtil::CullVisitor& cv, osgUtil::RenderStage& host)
{
    for (auto it = _views.begin(); it != _views.end();) {
        const ViewData& v = *it->second;
        const bool dead = !v.identifier.valid() || (v.hasCamera && !v.camera.valid()) || (v.hasContext && !v.context.valid());
        it = dead ? _views.erase(it) : std::next(it);
    }
    osg::Referenced* identifier = cv.getIdentifier() ? static_cast<osg::Referenced*>(cv.getIdentifier()) : &cv;
    const unsigned frame = cv.getFrameStamp() ? cv.getFrameStamp()->getFrameNumber() : 0;
    // Another viewer counts its own frames.
    for (auto it = _visits.begin(); it != _visits.end();) it = it->second.cullVisitor.valid() ? std::next(it) : _visits.erase(it);
    Visit& visit = _visits[{&cv, host.getCamera()}];
    if (visit.frame != frame) visit = {&cv, frame, 0};
    osg::ref_ptr<LitView>& vd = _views[{identifier, host.getCamera(), cv.getState(), visit.count++}];
    if (!vd) {
        vd = new LitView(_failure.get(), _retired.get(), _sorter.get());
        node.addPasses(vd->graph);
        vd->identifier = identifier;
        vd->camera = host.getCamera();
        vd->hasCamera = host.getCamera() != nullptr;
        vd->context = cv.getState();
        vd->hasContext = cv.getState() != nullptr;
        vd->contextID = contextID(cv);
    }
    return *vd;
}

void DeferredTechnique::reportOnce(const std::string& message, osg::NotifySeverity severity)
{
    if (_reported.insert(message).second) OSG_NOTIFY(severity) << "osgEnvLight: " << message << std::endl;
}

void DeferredTechnique::reloadShaders()
{
    std::lock_guard<std::mutex> lock(_mutex);
    _library->reload();
    _failure->clear();
    for (auto& [key, view] : _views) view->graph.forgetPrograms();
}

bool DeferredTechnique::hasSettled(const FrameContext& c) const
{
    const bool converges = c.still && c.still->frames() < unsigned(c.settings.accumulateFrames);
    const bool waits = c.waitingMaps > 0 || c.waitingBounces > 0 || c.adapts;
    return !converges && !waits && !_regenerator.busy() && c.textures->settled();
}

void DeferredTechnique::countUpdate()
{
    std::lock_guard<std::mutex> lock(_mutex);
    ++_updates;
}

bool DeferredTechnique::unsettled() const
{
    const unsigned patience = 8;
    std::lock_guard<std::mutex> lock(_mutex);
    return std::any_of(_views.begin(), _views.end(), [&](const auto& view) {
        return view.second->unsettled && _updates - view.second->seenUpdates <= patience;
    });
}

unsigned DeferredTechnique::numViews() const
{
    std::lock_guard<std::mutex> lock(_mutex);
    return unsigned(_views.size());
}

Plan DeferredTechnique::plan() const
{
    std::lock_guard<std::mutex> lock(_mutex);
    osg::ref_ptr<LitView> view;
    if (!_lastView.lock(view)) return Plan();
    Plan plan = view->plan;
    if (!view->timed) return plan;
    for (const FrameTimer::Time& time : view->timer->finished())
        for (PassReport& report : plan.passes)
            if (report.pass == time.pass) {
                report.gpu = time.gpu;
                report.cpu = time.cpu;
            }
    return plan;
}

Average DeferredTechnique::average() const
{
    std::lock_guard<std::mutex> lock(_mutex);
    osg::ref_ptr<LitView> view;
    if (!_lastView.lock(view) || !view->still) return Average();
    const Accumulation& still = *view->still;
    return {still.frames(), still.lightCount(), still.standardError()};
}

size_t DeferredTechnique::bytes() const
{
    std::lock_guard<std::mutex> lock(_mutex);
    size_t sum = _textures ? _textures->bytes() : 0;
    for (const auto& table : _albedoTables) sum += table ? table->getImage()->getTotalSizeInBytes() : 0;
    for (const auto& [key, view] : _views) sum += view->bytes();
    return sum + _retired->bytes();
}

osg::Texture* DeferredTechnique::albedoTable(bool anisotropic)
{
    osg::ref_ptr<osg::Texture2D>& table = _albedoTables[anisotropic];
    if (!table) {
        table = new osg::Texture2D(albedoTableImage(anisotropic));
        table->setResizeNonPowerOfTwoHint(false);
        table->setInternalFormat(GL_RGB32F_ARB);
        table->setFilter(osg::Texture::MIN_FILTER, osg::Texture::LINEAR);
        table->setFilter(osg::Texture::MAG_FILTER, osg::Texture::LINEAR);
        table->setWrap(osg::Texture::WRAP_S, osg::Texture::CLAMP_TO_EDGE);
        table->setWrap(osg::Texture::WRAP_T, osg::Texture::CLAMP_TO_EDGE);
    }
    return table.get();
}

void DeferredTechnique::resizeGLObjectBuffers(unsigned maximum)
{
    std::lock_guard<std::mutex> lock(_mutex);
    _library->resizeGLObjectBuffers(maximum);
    if (_textures) _textures->resizeGLObjectBuffers(maximum);
    for (const auto& table : _albedoTables)
        if (table) table->resizeGLObjectBuffers(maximum);
    for (auto& [key, view] : _views) view->resizeGLObjectBuffers(maximum);
}

// A view that is not dropped is drawn in another context of the same number, which shares what is not a frame buffer.
template <class Condition>
void DeferredTechnique::release(osg::State* state, Condition drops) const
{
    std::lock_guard<std::mutex> lock(_mutex);
    _library->releaseGLObjects(state);
    if (_textures) _textures->releaseGLObjects(state);
    for (const auto& table : _albedoTables)
        if (table) table->releaseGLObjects(state);
    _retired->releaseGLObjects(state);
    for (auto it = _views.begin(); it != _views.end();) {
        const bool dropped = drops(*it->second);
        if (dropped) it->second->releaseGLObjects(state);
        it = dropped ? _views.erase(it) : std::next(it);
    }
    if (state)
        _failure->clear(state->getContextID());
    else
        _failure->clear();
}

void DeferredTechnique::releaseGLObjects(osg::State* state) const
{
    release(state, [&](const ViewData& view) { return !state || view.context == state; });
}

void DeferredTechnique::contextLost(unsigned contextID)
{
    const osg::ref_ptr<osg::State> state = new osg::State;
    state->setContextID(contextID);
    release(state.get(), [&](const ViewData& view) { return view.contextID == contextID; });
}

}  // namespace osgEnvLight

// SPDX-License-Identifier: MIT
#include "Directions.h"
#include "LightTransport.h"

#include <tbb/blocked_range2d.h>
#include <tbb/parallel_for.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <mutex>

namespace osgEnvLight
{

namespace
{

using Clock = std::chrono::steady_clock;

const int tile = 8;

// One pass's mean at one pixel.
struct PixelMeans {
    std::array<glm::dvec3, size_t(Layer::NUM_LAYERS)> layers{};
    double coverage = 0.0;

    glm::dvec3& operator[](Layer l) { return layers[size_t(l)]; }
};

}  // namespace

class ReferenceRun
{
  public:
    // Through a point of the image, in the scene's coordinates.
    static Ray sceneRay(const Reference& reference, double x, double y)
    {
        Ray ray = reference._camera.ray(x, y);
        ray.origin -= reference._scene.scene().origin;
        return ray;
    }

    ReferenceRun(const Reference& reference, const ReferenceOptions& options, const std::set<Layer>& layers,
                 const Reference::Observer& observer)
        : _reference(reference),
          _options(options),
          _layers(layers),
          _observer(observer),
          _classes(reference._scene, reference._camera, options.occlusionReach),
          _transport(reference._scene, reference._environment, reference._lights, options, classified() ? &_classes : nullptr),
          _result(reference._camera.width(), reference._camera.height(), layers)
    {
        _primaryKept = !options.antialias;
        for (const TriangleMesh& mesh : reference._scene.scene().meshes) _primaryKept = _primaryKept && !mesh.material.blended;
    }

    ReferenceResult run()
    {
        _start = Clock::now();
        while (!_stop && _result.samples < _options.samples) {
            const unsigned n = std::min(_options.pass, _options.samples - _result.samples);
            pass(n);
            if (_stop) break;
            _result.samples += n;
            ++_pass;
            if (_pass < 2) continue;
            _lastError = _result.relativeError(Layer::BEAUTY);
            _errorAt = _result.samples;
            // The spread of fewer passes says too little of itself.
            if (_options.error > 0.0 && _pass >= 8 && _lastError <= _options.error) break;
        }
        _result.interrupted = _stop;
        _result.seconds = std::chrono::duration<double>(Clock::now() - _start).count();
        _result.rays = _rays;
        if (_observer && !_stop) _observer({1.0, _result.samples, _lastError});
        return std::move(_result);
    }

  private:
    bool classified() const
    {
        return _layers.count(Layer::OCCLUSION_OUTSIDE) || _layers.count(Layer::OCCLUSION_HIDDEN) ||
               _layers.count(Layer::OCCLUSION_FAR);
    }

    void pass(unsigned samples)
    {
        const int width = _reference._camera.width();
        const int height = _reference._camera.height();
        std::atomic<size_t> done{0};
        tbb::parallel_for(tbb::blocked_range2d<int>(0, height, tile, 0, width, tile), [&](const tbb::blocked_range2d<int>& r) {
            if (_stop) return;
            for (int y = r.rows().begin(); y < r.rows().end(); ++y)
                for (int x = r.cols().begin(); x < r.cols().end(); ++x) store(x, y, pixel(x, y, samples));
            _rays += LightTransport::takeRays();
            done += r.rows().size() * r.cols().size();
            report(double(done) / (double(width) * height), samples);
        });
    }

    void report(double passFraction, unsigned samples)
    {
        if (!_observer) return;
        const std::unique_lock<std::mutex> lock(_observing, std::try_to_lock);
        if (!lock || Clock::now() - _reported < std::chrono::milliseconds(100)) return;
        _reported = Clock::now();
        const double taken = _result.samples + passFraction * samples;
        double fraction = taken / _options.samples;
        // The error falls as the root of the samples.
        if (_options.error > 0.0 && _lastError > 0.0)
            fraction = std::max(fraction, std::min(1.0, std::pow(_options.error / _lastError, 2.0) * taken / _errorAt));
        if (!_observer({fraction, _result.samples, _lastError})) _stop = true;
    }

    void store(int x, int y, const PixelMeans& means)
    {
        const size_t i = size_t(y) * size_t(_reference._camera.width()) + size_t(x);
        for (Layer layer : _layers) {
            ReferenceResult::Sums& s = _result._layers[size_t(layer)];
            for (int k = 0; k < 3; ++k) {
                const double v = means.layers[size_t(layer)][k];
                s.sum[3 * i + size_t(k)] += v;
                if (!s.square.empty()) s.square[3 * i + size_t(k)] += v * v;
            }
        }
        _result._coverage[i] += float(means.coverage);
        ++_result._passes[i];
    }

    // What one pixel's samples are made of. Kept from pixel to pixel: allocations would cost more than the rays.
    struct Workspace {
        std::vector<RandomPoints> random;
        // Of each look through the pixel.
        std::vector<glm::dvec2> places;
        std::vector<Ray> rays;
        std::vector<std::uint64_t> seeds;
        std::vector<SurfaceHit> hits;
        std::vector<Reflection> surfaces;  // where something is hit
        std::vector<LightTransport::Start> starts;
        LightTransport::Arrivals arrivals;
    };

    // Texture coordinates where a ray meets the plane of a hit's triangle.
    static glm::dvec2 textureAt(const Ray& ray, const SurfaceHit& hit)
    {
        SurfaceHit moved = hit;
        PlanePoint point;
        if (meetPlane(*hit.mesh, hit.triangle, ray, point)) {
            moved.u = point.u;
            moved.v = point.v;
        }
        return moved.interpolate(hit.mesh->texCoords);
    }

    glm::dvec4 colorAt(const glm::dvec2& place, const Ray& ray, const SurfaceHit& hit) const
    {
        if (!hit.mesh->material.texture) return surfaceColor(hit);
        const glm::dvec2 here = textureAt(ray, hit);
        const glm::dvec2 dx = textureAt(sceneRay(_reference, place.x + 1.0, place.y), hit) - here;
        const glm::dvec2 dy = textureAt(sceneRay(_reference, place.x, place.y + 1.0), hit) - here;
        return surfaceColor(hit, dx, dy);
    }

    PixelMeans pixel(int x, int y, unsigned samples) const
    {
        const std::uint64_t pixelSeed =
            mixBits(mixBits(mixBits(_options.seed) ^ _pass) ^ ((std::uint64_t(unsigned(y)) << 32) | unsigned(x)));
        const bool scrambled = _options.estimator == ReferenceOptions::MIS;
        thread_local Workspace w;
        w.random.clear();
        for (unsigned s = 0; s < samples; ++s) w.random.emplace_back(pixelSeed, s, scrambled);
        look(x, y, _primaryKept ? 1 : samples, pixelSeed, w);
        PixelMeans means;
        shade(pixelSeed, w, means);
        return means;
    }

    void look(int x, int y, size_t looks, std::uint64_t pixelSeed, Workspace& w) const
    {
        w.places.resize(looks);
        w.rays.resize(looks);
        w.seeds.resize(looks);
        w.hits.resize(looks);
        for (size_t i = 0; i < looks; ++i) {
            w.places[i] = glm::dvec2(x, y) + (_options.antialias ? w.random[i].square() : glm::dvec2(0.5));
            w.rays[i] = sceneRay(_reference, w.places[i].x, w.places[i].y);
            w.seeds[i] = mixBits(pixelSeed + i);
        }
        _reference._scene.nearest(w.rays.data(), looks, RayScene::CAMERA, w.seeds.data(), w.hits.data());
    }

    void shade(std::uint64_t pixelSeed, Workspace& w, PixelMeans& m) const
    {
        const size_t looks = w.rays.size(), samples = w.random.size();
        const double share = 1.0 / double(looks), weight = 1.0 / double(samples);
        w.surfaces.clear();
        w.surfaces.reserve(looks);  // the starts point at them
        w.starts.clear();
        w.arrivals.clear();
        for (size_t i = 0; i < looks; ++i) {
            const SurfaceHit& hit = w.hits[i];
            if (!hit.mesh) {
                m[Layer::BACKGROUND] += share * _reference._environment.from(w.rays[i].direction).radiance;
                continue;
            }
            const Reflection& surface = w.surfaces.emplace_back(hit, w.rays[i], colorAt(w.places[i], w.rays[i], hit));
            for (size_t s = i; s < samples; s += looks) {
                LightTransport::Start& start = w.starts.emplace_back();
                start.hit = &hit;
                start.surface = &surface;
                start.random = &w.random[s];
            }
            if (_reference._lights) _transport.addLights(hit, surface, share, w.arrivals);
            addSurface(hit, surface, share, m);
        }
        _transport.sampleDirect(w.starts, weight, w.arrivals);
        const DirectLight direct = _transport.resolve(w.arrivals);
        if (_options.paths == ReferenceOptions::FULL)
            for (size_t i = 0; i < w.starts.size(); ++i)
                m[Layer::INDIRECT] += weight * _transport.indirect(w.starts[i], mixBits(pixelSeed ^ mixBits(i)));
        m[Layer::DIFFUSE] = direct.diffuse;
        m[Layer::OCCLUSION] = direct.occlusion;
        m[Layer::SPECULAR] = direct.specular;
        m[Layer::SPECULAR_VISIBLE] = direct.specularVisible;
        m[Layer::OCCLUSION_OUTSIDE] = direct.outside;
        m[Layer::OCCLUSION_HIDDEN] = direct.hidden;
        m[Layer::OCCLUSION_FAR] = direct.far;
        m[Layer::BEAUTY] = m[Layer::BACKGROUND] + m[Layer::EMISSION] + direct.visible() + m[Layer::INDIRECT];
    }

    // What is not sampled.
    void addSurface(const SurfaceHit& hit, const Reflection& surface, double share, PixelMeans& m) const
    {
        m.coverage += share;
        m[Layer::EMISSION] += share * _transport.emitted(hit, surface);
        m[Layer::ALBEDO] += share * surface.albedo();
        m[Layer::NORMAL] += share * surface.normal();
        m[Layer::BLENDED] += hit.mesh->material.blended ? share : 0.0;
        if (_layers.count(Layer::DEPTH)) {
            const glm::dvec3 world = hit.position + _reference._scene.scene().origin;
            m[Layer::DEPTH] += share * _reference._camera.project(world).z;
        }
    }

    const Reference& _reference;
    const ReferenceOptions& _options;
    const std::set<Layer>& _layers;
    const Reference::Observer& _observer;
    const BlockerClasses _classes;
    const LightTransport _transport;
    ReferenceResult _result;
    bool _primaryKept = false;
    unsigned _pass = 0;
    double _lastError = 0.0;
    double _errorAt = 1.0;
    Clock::time_point _start;
    Clock::time_point _reported;
    std::mutex _observing;
    std::atomic<bool> _stop{false};
    std::atomic<size_t> _rays{0};
};

Reference::Reference(const RayScene& scene, const RayCamera& camera, const Environment& environment)
    : _scene(scene), _camera(camera), _environment(environment)
{
}

ReferenceResult Reference::render(const ReferenceOptions& options, const std::set<Layer>& layers, const Observer& observer) const
{
    std::set<Layer> all = layers;
    all.insert(Layer::BEAUTY);  // whose error ends the run
    return ReferenceRun(*this, options, all, observer).run();
}

Picture Reference::integrand(int x, int y, int width, bool occluded) const
{
    Picture picture(width, std::max(width / 2, 1));
    const Ray ray = ReferenceRun::sceneRay(*this, x + 0.5, y + 0.5);
    SurfaceHit hit;
    if (!_scene.nearest(ray, RayScene::CAMERA, 0, hit)) return picture;
    const Reflection surface(hit, ray, surfaceColor(hit));
    const EmitterSampler emitters(_scene.scene().emitters);
    EmitterSampler::Outlook outlook;
    emitters.look(hit.position, surface.normal(), outlook);
    std::vector<EmitterSampler::Arrival> met;
    const auto through = [&](const glm::dvec3& l, const RayEnd& end) {
        if (!occluded) return 1.0;
        if (glm::dot(l, hit.facet) <= 0.0) return 0.0;
        float share = 1.0f;
        const Ray shadow = RayScene::leave(hit, l);
        _scene.transmittance(&shadow, 1, &share, &end);
        return double(share);
    };
    for (int row = 0; row < picture.height; ++row)
        for (int column = 0; column < picture.width; ++column) {
            const double theta = pi * (1.0 - (row + 0.5) / picture.height);
            const glm::dvec3 l = aboutPole(std::cos(theta), 0.5 - (column + 0.5) / picture.width);
            glm::dvec3 radiance = _environment.from(l).radiance * through(l, RayEnd());
            emitters.meet(outlook, l, met);
            for (const auto& a : met) radiance += a.radiance * through(l, a.end());
            const glm::dvec3 f = radiance * (surface.diffuse(l) + surface.glossy(l)) * surface.cosine(l);
            float* p = picture.at(column, row);
            for (int k = 0; k < 3; ++k) p[k] = float(f[k]);
            p[3] = 1.0f;
        }
    return picture;
}

}  // namespace osgEnvLight

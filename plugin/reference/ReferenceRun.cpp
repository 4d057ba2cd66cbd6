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
    void scale(double f)
    {
        for (glm::dvec3& l : layers) l *= f;
        coverage *= f;
    }
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

    // Seen through a pixel: a surface or the background.
    struct Seen {
        Ray ray;
        bool surface = false;
        SurfaceHit hit;
        glm::dvec4 color{0, 0, 0, 0};
    };

    Seen look(double x, double y, std::uint64_t seed) const
    {
        Seen seen;
        seen.ray = sceneRay(_reference, x, y);
        seen.surface = _reference._scene.nearest(seen.ray, RayScene::CAMERA, seed, seen.hit);
        if (!seen.surface) return seen;
        glm::dvec2 dx(0.0), dy(0.0);
        if (seen.hit.mesh->material.texture) {
            const glm::dvec2 here = textureAt(seen.ray, seen.hit);
            dx = textureAt(sceneRay(_reference, x + 1.0, y), seen.hit) - here;
            dy = textureAt(sceneRay(_reference, x, y + 1.0), seen.hit) - here;
        }
        seen.color = surfaceColor(seen.hit, dx, dy);
        return seen;
    }

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

    PixelMeans pixel(int x, int y, unsigned samples) const
    {
        const std::uint64_t pixelSeed =
            mixBits(mixBits(mixBits(_options.seed) ^ _pass) ^ ((std::uint64_t(unsigned(y)) << 32) | unsigned(x)));
        const bool scrambled = _options.estimator == ReferenceOptions::MIS;
        PixelMeans means;
        if (_primaryKept) {
            const Seen seen = look(x + 0.5, y + 0.5, pixelSeed);
            thread_local std::vector<RandomPoints> points;
            points.clear();
            for (unsigned s = 0; s < samples; ++s) points.emplace_back(pixelSeed, s, scrambled);
            shade(seen, points, pixelSeed, means);
            return means;
        }
        std::vector<RandomPoints> points;
        for (unsigned s = 0; s < samples; ++s) {
            points.assign(1, RandomPoints(pixelSeed, s, scrambled));
            const glm::dvec2 offset = _options.antialias ? points[0].square() : glm::dvec2(0.5);
            const std::uint64_t seed = mixBits(pixelSeed + s);
            PixelMeans one;
            shade(look(x + offset.x, y + offset.y, seed), points, seed, one);
            for (Layer l : _layers) means[l] += one[l];
            means.coverage += one.coverage;
        }
        means.scale(1.0 / samples);
        return means;
    }

    // The mean of as many samples as there are points.
    void shade(const Seen& seen, std::vector<RandomPoints>& points, std::uint64_t seed, PixelMeans& m) const
    {
        if (!seen.surface) {
            m[Layer::BACKGROUND] = _reference._environment.from(seen.ray.direction).radiance;
            m[Layer::BEAUTY] = m[Layer::BACKGROUND];
            return;
        }
        const double weight = 1.0 / double(points.size());
        const Reflection surface(seen.hit, seen.ray, seen.color);
        thread_local LightTransport::Arrivals arrivals;
        arrivals.clear();
        for (RandomPoints& p : points) _transport.sampleDirect(surface, p, arrivals);
        for (LightTransport::Arrival& a : arrivals) {
            a.diffuse *= weight;
            a.specular *= weight;
        }
        if (_reference._lights) _transport.addLights(surface, arrivals);
        const DirectLight direct = _transport.resolve(seen.hit, arrivals);
        if (_options.paths == ReferenceOptions::FULL)
            for (size_t i = 0; i < points.size(); ++i)
                m[Layer::INDIRECT] += weight * _transport.indirect(seen.hit, surface, mixBits(seed ^ mixBits(i)), points[i]);
        m.coverage = 1.0;
        m[Layer::EMISSION] = surface.emission();
        m[Layer::DIFFUSE] = direct.diffuse;
        m[Layer::OCCLUSION] = direct.occlusion;
        m[Layer::SPECULAR] = direct.specular;
        m[Layer::SPECULAR_VISIBLE] = direct.specularVisible;
        m[Layer::OCCLUSION_OUTSIDE] = direct.outside;
        m[Layer::OCCLUSION_HIDDEN] = direct.hidden;
        m[Layer::OCCLUSION_FAR] = direct.far;
        m[Layer::BEAUTY] = surface.emission() + direct.visible() + m[Layer::INDIRECT];
        m[Layer::ALBEDO] = surface.albedo();
        m[Layer::NORMAL] = surface.normal();
        m[Layer::BLENDED] = glm::dvec3(seen.hit.mesh->material.blended ? 1.0 : 0.0);
        if (_layers.count(Layer::DEPTH)) {
            const glm::dvec3 world = seen.hit.position + _reference._scene.scene().origin;
            m[Layer::DEPTH] = glm::dvec3(_reference._camera.project(world).z);
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
    for (int row = 0; row < picture.height; ++row)
        for (int column = 0; column < picture.width; ++column) {
            const double theta = pi * (1.0 - (row + 0.5) / picture.height);
            const glm::dvec3 l = aboutPole(std::cos(theta), 0.5 - (column + 0.5) / picture.width);
            glm::dvec3 f = _environment.from(l).radiance * (surface.diffuse() + surface.glossy(l)) * surface.cosine(l);
            float through = 1.0f;
            const Ray shadow = RayScene::leave(hit, l);
            if (occluded && glm::dot(l, hit.facet) <= 0.0)
                through = 0.0f;
            else if (occluded)
                _scene.transmittance(&shadow, 1, &through);
            f *= double(through);
            float* p = picture.at(column, row);
            for (int k = 0; k < 3; ++k) p[k] = float(f[k]);
            p[3] = 1.0f;
        }
    return picture;
}

}  // namespace osgEnvLight

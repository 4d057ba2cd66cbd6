// SPDX-License-Identifier: MIT
#include <reference/RayScene>

#include "RandomNumbers.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace osgEnvLight
{

namespace
{

const unsigned packetSize = 16;  // Embree splits packets that are wider than what the processor does at once

struct Context {
    RTCIntersectContext context;
    RayScene::Kind kind = RayScene::ANY;
    const std::uint64_t* seeds = nullptr;  // by the rays' id, as what follows
    const RayEnd* ends = nullptr;          // null: infinity
    float transmittance[packetSize];

    explicit Context(RTCIntersectContextFlags flags)
    {
        rtcInitIntersectContext(&context);
        context.flags = flags;
        std::fill_n(transmittance, packetSize, 1.0f);
    }
};

// Only what places the hit in its mesh.
void placeHit(const TriangleMesh& mesh, unsigned primitive, double u, double v, SurfaceHit& hit)
{
    hit.mesh = &mesh;
    hit.triangle = mesh.triangles[primitive];
    hit.u = u;
    hit.v = v;
}

// How much of the light a point of the surface stops.
double opacity(const TriangleMesh& mesh, const RTCHit& h)
{
    SurfaceHit hit;
    placeHit(mesh, h.primID, double(h.u), double(h.v), hit);
    const SurfaceMaterial& m = mesh.material;
    const double alpha = surfaceColor(hit).a;
    if (m.alphaTest && !m.alphaPasses(alpha)) return 0.0;
    return m.blended ? glm::clamp(alpha, 0.0, 1.0) : 1.0;
}

bool seenFrom(const SurfaceMaterial& m, bool counterClockwise)
{
    const bool front = counterClockwise != m.clockwiseFront;
    return m.sides == SurfaceMaterial::SHOW_BOTH || front == (m.sides == SurfaceMaterial::SHOW_FRONT);
}

void filterNearest(const RTCFilterFunctionNArguments* a)
{
    auto& context = *reinterpret_cast<Context*>(a->context);
    const auto& mesh = *static_cast<const TriangleMesh*>(a->geometryUserPtr);
    for (unsigned i = 0; i < a->N; ++i) {
        if (a->valid[i] != -1) continue;
        const RTCRay ray = rtcGetRayFromRayN(a->ray, a->N, i);
        const RTCHit h = rtcGetHitFromHitN(a->hit, a->N, i);
        if (context.kind == RayScene::CAMERA) {
            // Embree's normal is the right-handed one of the vertices' order: against the ray, they are seen counter-clockwise.
            const float facing = h.Ng_x * ray.dir_x + h.Ng_y * ray.dir_y + h.Ng_z * ray.dir_z;
            if (!seenFrom(mesh.material, facing < 0.0f)) a->valid[i] = 0;
        }
        if (a->valid[i] == 0 || !mesh.material.perforated()) continue;
        const double o = opacity(mesh, h);
        const std::uint64_t seed = context.seeds[ray.id];
        const double random = unitInterval(mixBits(seed ^ mixBits((std::uint64_t(h.geomID) << 32) | h.primID)));
        if (!(random < o)) a->valid[i] = 0;
    }
}

void filterShadow(const RTCFilterFunctionNArguments* a)
{
    auto& context = *reinterpret_cast<Context*>(a->context);
    const auto& mesh = *static_cast<const TriangleMesh*>(a->geometryUserPtr);
    for (unsigned i = 0; i < a->N; ++i) {
        if (a->valid[i] != -1) continue;
        const RTCHit h = rtcGetHitFromHitN(a->hit, a->N, i);
        const unsigned id = RTCRayN_id(a->ray, a->N, i);
        const bool isGoal = context.ends && mesh.emitter >= 0 && context.ends[id].emitter == mesh.emitter;
        float& t = context.transmittance[id];
        if (!isGoal) t *= float(1.0 - opacity(mesh, h));
        if (isGoal || t > 0.0f) a->valid[i] = 0;
    }
}

// A float ray with its origin brought near the scene in double precision, where it starts far out.
double toEmbree(const Ray& ray, double radius, RTCRay& out, const RayEnd& end = RayEnd())
{
    const double along = -glm::dot(ray.origin, ray.direction);
    const double skipped = std::max(0.0, along - 2.0 * radius);
    const glm::dvec3 o = ray.origin + skipped * ray.direction;
    out.org_x = float(o.x);
    out.org_y = float(o.y);
    out.org_z = float(o.z);
    out.dir_x = float(ray.direction.x);
    out.dir_y = float(ray.direction.y);
    out.dir_z = float(ray.direction.z);
    out.tnear = 0.0f;
    out.tfar = float(std::max(0.0, end.distance - skipped));
    out.time = 0.0f;
    out.mask = ~0u;
    out.id = 0;
    out.flags = 0;
    return skipped;
}

// Some rays side by side.
template <class Packet>
void fill(Packet& packet, int* valid, const Ray* rays, size_t count, double radius, double* skipped, const RayEnd* ends = nullptr)
{
    for (unsigned i = 0; i < packetSize; ++i) {
        valid[i] = i < count ? -1 : 0;
        RTCRay r;
        const size_t from = std::min<size_t>(i, count - 1);
        skipped[i] = toEmbree(rays[from], radius, r, ends ? ends[from] : RayEnd());
        packet.org_x[i] = r.org_x;
        packet.org_y[i] = r.org_y;
        packet.org_z[i] = r.org_z;
        packet.dir_x[i] = r.dir_x;
        packet.dir_y[i] = r.dir_y;
        packet.dir_z[i] = r.dir_z;
        packet.tnear[i] = r.tnear;
        packet.tfar[i] = r.tfar;
        packet.time[i] = r.time;
        packet.mask[i] = r.mask;
        packet.id[i] = i;
        packet.flags[i] = 0;
    }
}

// A triangle in double precision: its first corner, the edges to the others, and their product.
struct Corners {
    glm::dvec3 a, b, c, normal;

    Corners() = default;
    Corners(const TriangleMesh& mesh, const glm::uvec3& triangle)
        : a(mesh.positions[triangle.x]),
          b(glm::dvec3(mesh.positions[triangle.y]) - a),
          c(glm::dvec3(mesh.positions[triangle.z]) - a),
          normal(glm::cross(b, c))
    {
    }

    bool meet(const Ray& ray, PlanePoint& point) const
    {
        const double facing = glm::dot(normal, ray.direction);
        if (facing == 0.0) return false;
        const glm::dvec3 o = a - ray.origin;
        const glm::dvec3 r = glm::cross(ray.direction, o);
        point = {glm::dot(normal, o) / facing, -glm::dot(r, c) / facing, glm::dot(r, b) / facing};
        return true;
    }
};

double largest(const glm::dvec3& v)
{
    return std::max(std::abs(v.x), std::max(std::abs(v.y), std::abs(v.z)));
}

// Ray and triangle in double precision; false where Embree's hit is none. Weights may leave [0,1] by what its single precision
// leaves open at an edge.
bool refine(const Ray& ray, const Corners& t, SurfaceHit& hit)
{
    PlanePoint point;
    if (!t.meet(ray, point)) return false;
    const double slack = 1e-2;
    if (!(point.distance >= 0.0) || point.u < -slack || point.v < -slack || point.u + point.v > 1.0 + slack) return false;
    hit.u = glm::clamp(point.u, 0.0, 1.0);
    hit.v = glm::clamp(point.v, 0.0, 1.0 - hit.u);
    hit.distance = point.distance;
    const glm::dvec3 inside = hit.u * t.b + hit.v * t.c;  // from the first corner
    hit.position = t.a + inside;
    hit.facet = (glm::dot(t.normal, ray.direction) > 0.0 ? -1.0 : 1.0) / glm::length(t.normal) * t.normal;
    hit.extent =
        std::max(std::max(largest(inside), largest(hit.position)), std::max(largest(inside - t.b), largest(inside - t.c)));
    return true;
}

}  // namespace

struct RayScene::Embree {
    RTCDevice device = nullptr;
    RTCScene scene = nullptr;

    ~Embree()
    {
        if (scene) rtcReleaseScene(scene);
        if (device) rtcReleaseDevice(device);
    }

    void check(const char* what) const
    {
        const RTCError error = rtcGetDeviceError(device);
        if (error == RTC_ERROR_NONE) return;
        const char* const text = error == RTC_ERROR_OUT_OF_MEMORY     ? "out of memory"
                                 : error == RTC_ERROR_UNSUPPORTED_CPU ? "this CPU is not supported"
                                                                      : "internal error";
        throw std::runtime_error(std::string("Embree: ") + what + ": " + text + " (" + std::to_string(int(error)) + ")");
    }

    void add(const TriangleMesh& mesh)
    {
        RTCGeometry g = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
        // Buffers of Embree's own: shared ones must be readable past their end.
        void* positions =
            rtcSetNewGeometryBuffer(g, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(glm::vec3), mesh.positions.size());
        void* triangles =
            rtcSetNewGeometryBuffer(g, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, sizeof(glm::uvec3), mesh.triangles.size());
        if (positions && triangles) {
            std::copy(mesh.positions.begin(), mesh.positions.end(), static_cast<glm::vec3*>(positions));
            std::copy(mesh.triangles.begin(), mesh.triangles.end(), static_cast<glm::uvec3*>(triangles));
            rtcSetGeometryUserData(g, const_cast<TriangleMesh*>(&mesh));
            const bool perforated = mesh.material.perforated();
            if (perforated || mesh.material.sides != SurfaceMaterial::SHOW_BOTH)
                rtcSetGeometryIntersectFilterFunction(g, filterNearest);
            if (perforated || mesh.emitter >= 0) rtcSetGeometryOccludedFilterFunction(g, filterShadow);
            // High quality splits triangles, and a filter would see them twice.
            rtcSetGeometryBuildQuality(g, perforated ? RTC_BUILD_QUALITY_MEDIUM : RTC_BUILD_QUALITY_HIGH);
            rtcCommitGeometry(g);
            rtcAttachGeometry(scene, g);
        }
        rtcReleaseGeometry(g);
        check("a mesh can't be added");
    }
};

RayScene::RayScene(const TriangleScene& scene) : _scene(scene), _embree(new Embree)
{
    _embree->device = rtcNewDevice(nullptr);
    if (!_embree->device) _embree->check("no device");
    _embree->scene = rtcNewScene(_embree->device);
    rtcSetSceneFlags(_embree->scene, RTC_SCENE_FLAG_ROBUST);
    const bool perforated =
        std::any_of(scene.meshes.begin(), scene.meshes.end(), [](const TriangleMesh& m) { return m.material.perforated(); });
    rtcSetSceneBuildQuality(_embree->scene, perforated ? RTC_BUILD_QUALITY_MEDIUM : RTC_BUILD_QUALITY_HIGH);
    for (const TriangleMesh& mesh : scene.meshes) _embree->add(mesh);
    rtcCommitScene(_embree->scene);
    _embree->check("the scene can't be built");
}

RayScene::~RayScene() = default;

bool RayScene::nearest(const Ray& ray, Kind kind, std::uint64_t seed, SurfaceHit& hit) const
{
    return follow(ray, kind, seed, 0.0, hit);
}

// From a distance along the ray.
bool RayScene::follow(const Ray& ray, Kind kind, std::uint64_t seed, double from, SurfaceHit& hit) const
{
    Ray rest = ray;
    // A hit that double precision does not confirm is passed; a ray along a surface may meet many.
    for (int attempt = 0; attempt < 64; ++attempt) {
        rest.origin += rest.direction * from;
        Context context(kind == CAMERA ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT);
        context.kind = kind;
        context.seeds = &seed;
        RTCRayHit rh;
        const double skipped = toEmbree(rest, _scene.radius, rh.ray);
        rh.hit.geomID = RTC_INVALID_GEOMETRY_ID;
        rtcIntersect1(_embree->scene, &context.context, &rh);
        hit.mesh = nullptr;
        if (rh.hit.geomID == RTC_INVALID_GEOMETRY_ID) return false;
        // Meshes were attached in order, so that a geometry's number is its mesh's.
        placeHit(_scene.meshes[rh.hit.geomID], rh.hit.primID, double(rh.hit.u), double(rh.hit.v), hit);
        if (refine(ray, Corners(*hit.mesh, hit.triangle), hit)) return true;
        from = beyond(skipped + double(rh.ray.tfar));
    }
    hit.mesh = nullptr;
    return false;
}

void RayScene::nearest(const Ray* rays, size_t count, Kind kind, const std::uint64_t* seeds, SurfaceHit* hits) const
{
    for (; count > 0 && count < 4; ++rays, ++seeds, ++hits, --count) nearest(*rays, kind, *seeds, *hits);
    while (count > 0) {
        const size_t n = std::min<size_t>(packetSize, count);
        Context context(kind == CAMERA ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT);
        context.kind = kind;
        context.seeds = seeds;
        RTCRayHit16 packet;
        alignas(64) int valid[packetSize];
        double skipped[packetSize];
        fill(packet.ray, valid, rays, n, _scene.radius, skipped);
        std::fill_n(packet.hit.geomID, packetSize, RTC_INVALID_GEOMETRY_ID);
        rtcIntersect16(valid, _embree->scene, &context.context, &packet);
        // Neighbours meet the same triangle more often than not.
        Corners corners;
        unsigned geometry = RTC_INVALID_GEOMETRY_ID, primitive = 0;
        for (size_t i = 0; i < n; ++i) {
            SurfaceHit& hit = hits[i];
            const RTCHit h = rtcGetHitFromHitN(reinterpret_cast<RTCHitN*>(&packet.hit), packetSize, unsigned(i));
            hit.mesh = nullptr;
            if (h.geomID == RTC_INVALID_GEOMETRY_ID) continue;
            placeHit(_scene.meshes[h.geomID], h.primID, double(h.u), double(h.v), hit);
            if (h.geomID != geometry || h.primID != primitive) corners = Corners(*hit.mesh, hit.triangle);
            geometry = h.geomID;
            primitive = h.primID;
            if (!refine(rays[i], corners, hit))
                follow(rays[i], kind, seeds[i], beyond(skipped[i] + double(packet.ray.tfar[i])), hit);
        }
        rays += n;
        seeds += n;
        hits += n;
        count -= n;
    }
}

// A little farther than a hit.
double RayScene::beyond(double distance) const
{
    return std::max(distance * (1.0 + 1e-6), 1e-12 * _scene.radius);
}

void RayScene::transmittance(const Ray* rays, size_t count, float* result, const RayEnd* ends) const
{
    if (count == 1) {
        Context context(RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT);
        context.ends = ends;
        RTCRay ray;
        toEmbree(*rays, _scene.radius, ray, ends ? *ends : RayEnd());
        rtcOccluded1(_embree->scene, &context.context, &ray);
        *result = ray.tfar < 0.0f ? 0.0f : context.transmittance[0];
        return;
    }
    for (size_t first = 0; first < count; first += packetSize) {
        const size_t n = std::min<size_t>(packetSize, count - first);
        Context context(RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT);  // from one pixel, but all over the hemisphere
        context.ends = ends ? ends + first : nullptr;
        RTCRay16 packet;
        alignas(64) int valid[packetSize];
        double skipped[packetSize];
        fill(packet, valid, rays + first, n, _scene.radius, skipped, context.ends);
        rtcOccluded16(valid, _embree->scene, &context.context, &packet);
        for (size_t i = 0; i < n; ++i) result[first + i] = packet.tfar[i] < 0.0f ? 0.0f : context.transmittance[i];
    }
}

bool meetPlane(const TriangleMesh& mesh, const glm::uvec3& triangle, const Ray& ray, PlanePoint& point)
{
    return Corners(mesh, triangle).meet(ray, point);
}

}  // namespace osgEnvLight

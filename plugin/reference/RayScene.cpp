// SPDX-License-Identifier: MIT
#include <reference/RayScene>

#include "RandomNumbers.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "glsl.h"

namespace osgEnvLight
{

namespace
{

const unsigned packetSize = 8;

struct Context {
    RTCIntersectContext context;
    RayScene::Kind kind = RayScene::ANY;
    std::uint64_t seed = 0;
    float transmittance[packetSize];

    explicit Context(RTCIntersectContextFlags flags)
    {
        rtcInitIntersectContext(&context);
        context.flags = flags;
        std::fill_n(transmittance, packetSize, 1.0f);
    }
};

SurfaceHit barycentric(const TriangleMesh& mesh, unsigned primitive, double u, double v)
{
    SurfaceHit hit;
    hit.mesh = &mesh;
    hit.triangle = mesh.triangles[primitive];
    hit.u = u;
    hit.v = v;
    return hit;
}

// How much of the light a point of the surface stops.
double opacity(const SurfaceHit& hit)
{
    const SurfaceMaterial& m = hit.mesh->material;
    const double alpha = surfaceColor(hit).a;
    if (m.alphaTest && !m.alphaPasses(alpha)) return 0.0;
    return m.blended ? glm::clamp(alpha, 0.0, 1.0) : 1.0;
}

bool seenFrom(const SurfaceMaterial& m, bool counterClockwise)
{
    const bool front = counterClockwise != m.clockwiseFront;
    return m.sides == SurfaceMaterial::SHOW_BOTH || front == (m.sides == SurfaceMaterial::SHOW_FRONT);
}

// Single rays only: RTCFilterFunctionNArguments::N is 1.
void filterNearest(const RTCFilterFunctionNArguments* a)
{
    auto& context = *reinterpret_cast<Context*>(a->context);
    const auto& mesh = *static_cast<const TriangleMesh*>(a->geometryUserPtr);
    const RTCRay ray = rtcGetRayFromRayN(a->ray, 1, 0);
    const RTCHit h = rtcGetHitFromHitN(a->hit, 1, 0);
    if (context.kind == RayScene::CAMERA) {
        // Embree's normal is the right-handed one of the vertices' order: against the ray, they are seen counter-clockwise.
        const float facing = h.Ng_x * ray.dir_x + h.Ng_y * ray.dir_y + h.Ng_z * ray.dir_z;
        if (!seenFrom(mesh.material, facing < 0.0f)) a->valid[0] = 0;
    }
    if (a->valid[0] == 0 || !mesh.material.perforated()) return;
    const double o = opacity(barycentric(mesh, h.primID, double(h.u), double(h.v)));
    const double random = unitInterval(mixBits(context.seed ^ mixBits((std::uint64_t(h.geomID) << 32) | h.primID)));
    if (!(random < o)) a->valid[0] = 0;
}

void filterShadow(const RTCFilterFunctionNArguments* a)
{
    auto& context = *reinterpret_cast<Context*>(a->context);
    const auto& mesh = *static_cast<const TriangleMesh*>(a->geometryUserPtr);
    for (unsigned i = 0; i < a->N; ++i) {
        if (a->valid[i] != -1) continue;
        const RTCHit h = rtcGetHitFromHitN(a->hit, a->N, i);
        float& t = context.transmittance[RTCRayN_id(a->ray, a->N, i)];
        t *= float(1.0 - opacity(barycentric(mesh, h.primID, double(h.u), double(h.v))));
        if (t > 0.0f) a->valid[i] = 0;
    }
}

// A float ray with its origin brought near the scene in double precision, where it starts far out.
double toEmbree(const Ray& ray, double radius, RTCRay& out)
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
    out.tfar = std::numeric_limits<float>::infinity();
    out.time = 0.0f;
    out.mask = ~0u;
    out.id = 0;
    out.flags = 0;
    return skipped;
}

// Ray and triangle in double precision; false where Embree's hit is none. Weights may leave [0,1] by what its single precision
// leaves open at an edge.
bool refine(const Ray& ray, SurfaceHit& hit)
{
    PlanePoint point;
    if (!meetPlane(*hit.mesh, hit.triangle, ray, point)) return false;
    const double slack = 1e-2;
    if (!(point.distance >= 0.0) || point.u < -slack || point.v < -slack || point.u + point.v > 1.0 + slack) return false;
    hit.u = glm::clamp(point.u, 0.0, 1.0);
    hit.v = glm::clamp(point.v, 0.0, 1.0 - hit.u);
    hit.distance = point.distance;
    const glm::dvec3 a = hit.mesh->positions[hit.triangle.x];
    const glm::dvec3 b = glm::dvec3(hit.mesh->positions[hit.triangle.y]) - a;
    const glm::dvec3 c = glm::dvec3(hit.mesh->positions[hit.triangle.z]) - a;
    hit.position = a + hit.u * b + hit.v * c;
    const glm::dvec3 n = glm::cross(b, c);
    hit.facet = (glm::dot(n, ray.direction) > 0.0 ? -1.0 : 1.0) * glm::normalize(n);
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
            if (perforated) rtcSetGeometryOccludedFilterFunction(g, filterShadow);
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
    Ray rest = ray;
    // A hit that double precision does not confirm is passed; a ray along a surface may meet many.
    for (int attempt = 0; attempt < 64; ++attempt) {
        Context context(kind == CAMERA ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT);
        context.kind = kind;
        context.seed = seed;
        RTCRayHit rh;
        const double skipped = toEmbree(rest, _scene.radius, rh.ray);
        rh.hit.geomID = RTC_INVALID_GEOMETRY_ID;
        rtcIntersect1(_embree->scene, &context.context, &rh);
        if (rh.hit.geomID == RTC_INVALID_GEOMETRY_ID) return false;
        // Meshes were attached in order, so that a geometry's number is its mesh's.
        hit = barycentric(_scene.meshes[rh.hit.geomID], rh.hit.primID, double(rh.hit.u), double(rh.hit.v));
        if (refine(ray, hit)) return true;
        const double t = (skipped + double(rh.ray.tfar)) * (1.0 + 1e-6);
        rest.origin += rest.direction * std::max(t, 1e-12 * _scene.radius);
    }
    return false;
}

void RayScene::transmittance(const Ray* rays, size_t count, float* result) const
{
    if (count == 1) {
        Context context(RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT);
        RTCRay ray;
        toEmbree(*rays, _scene.radius, ray);
        rtcOccluded1(_embree->scene, &context.context, &ray);
        *result = ray.tfar < 0.0f ? 0.0f : context.transmittance[0];
        return;
    }
    for (size_t first = 0; first < count; first += packetSize) {
        const unsigned n = unsigned(std::min<size_t>(packetSize, count - first));
        Context context(RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT);
        RTCRay8 packet;
        alignas(32) int valid[packetSize];
        for (unsigned i = 0; i < packetSize; ++i) {
            valid[i] = i < n ? -1 : 0;
            RTCRay r;
            toEmbree(rays[first + std::min(i, n - 1)], _scene.radius, r);
            packet.org_x[i] = r.org_x;
            packet.org_y[i] = r.org_y;
            packet.org_z[i] = r.org_z;
            packet.dir_x[i] = r.dir_x;
            packet.dir_y[i] = r.dir_y;
            packet.dir_z[i] = r.dir_z;
            packet.tnear[i] = 0.0f;
            packet.tfar[i] = r.tfar;
            packet.time[i] = 0.0f;
            packet.mask[i] = ~0u;
            packet.id[i] = i;
            packet.flags[i] = 0;
        }
        rtcOccluded8(valid, _embree->scene, &context.context, &packet);
        for (unsigned i = 0; i < n; ++i) result[first + i] = packet.tfar[i] < 0.0f ? 0.0f : context.transmittance[i];
    }
}

Ray RayScene::leave(const SurfaceHit& hit, const glm::dvec3& direction)
{
    double extent = 0.0;
    for (int k = 0; k < 3; ++k) {
        const glm::dvec3 corner = hit.mesh->positions[hit.triangle[k]];
        const glm::dvec3 size = glm::max(glm::abs(corner - hit.position), glm::abs(hit.position));
        extent = std::max(extent, std::max(size.x, std::max(size.y, size.z)));
    }
    // Four units in the last place of what a single-precision ray and triangle are made of.
    const double lift = std::ldexp(extent, -21);
    const double side = glm::dot(direction, hit.facet) < 0.0 ? -lift : lift;
    return {hit.position + side * hit.facet, direction};
}

bool meetPlane(const TriangleMesh& mesh, const glm::uvec3& triangle, const Ray& ray, PlanePoint& point)
{
    const glm::dvec3 a = mesh.positions[triangle.x];
    const glm::dvec3 b = glm::dvec3(mesh.positions[triangle.y]) - a;
    const glm::dvec3 c = glm::dvec3(mesh.positions[triangle.z]) - a;
    const glm::dvec3 n = glm::cross(b, c);
    const double facing = glm::dot(n, ray.direction);
    if (facing == 0.0) return false;
    const glm::dvec3 o = a - ray.origin;
    const glm::dvec3 r = glm::cross(ray.direction, o);
    point = {glm::dot(n, o) / facing, -glm::dot(r, c) / facing, glm::dot(r, b) / facing};
    return true;
}

glm::dvec4 surfaceColor(const SurfaceHit& hit, const glm::dvec2& dx, const glm::dvec2& dy)
{
    const TriangleMesh& mesh = *hit.mesh;
    const SurfaceMaterial& m = mesh.material;
    glm::dvec4 base = m.vertexColored ? hit.interpolate(mesh.colors) : m.color;
    if (m.unlit) base = glm::dvec4(glsl::srgbDecode3(glsl::vec3(base)), base.a);
    if (!m.texture) return base;
    const glm::dvec4 texel = m.texture->sample(hit.interpolate(mesh.texCoords), dx, dy);
    return m.replacedByTexture ? texel : base * texel;
}

}  // namespace osgEnvLight

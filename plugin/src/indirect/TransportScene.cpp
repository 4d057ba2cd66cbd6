// SPDX-License-Identifier: MIT
#include "indirect/TransportScene.h"

#include "base/Limits.h"
#include "indirect/PointLinks.h"
#include "indirect/Texels.h"

#include <algorithm>
#include <cmath>

#include "glsl.h"
#include "lib/sh.glsl"

namespace osgEnvLight
{

namespace
{

constexpr int pointSide = limits::POINT_SIDE;
constexpr int partSide = limits::POINT_PART_SIDE;

const float beyond = 1e30f;  // cells: no surface lies there

const float ofOthers = 0.02f;  // what a probe counts that stands for one within a body: only where there is none else

// Between probes side by side: of the medians along the three axes the middle one.
double spacingOf(const ProbeGrid::Planes& planes)
{
    std::array<double, 3> medians{};
    for (size_t k = 0; k < 3; ++k) {
        std::vector<float> gaps;
        for (size_t i = 1; i < planes[k].size(); ++i) gaps.push_back(planes[k][i] - planes[k][i - 1]);
        if (gaps.empty()) continue;
        const auto middle = gaps.begin() + std::ptrdiff_t(gaps.size() / 2);
        std::nth_element(gaps.begin(), middle, gaps.end());
        medians[k] = double(*middle);
    }
    std::sort(medians.begin(), medians.end());
    return medians[1];
}

// Of a ProbeGrid::Link, a PointLink or a point's number, as pass/pointlink.glsl reads it from 16 bits.
float linkCode(int link)
{
    return float(link + 2) / 65535.0f;
}

}  // namespace

TransportScene::TransportScene(const TracedScene& scene, const osg::Vec3d& place, int most, double mostOpen,
                               const TransportFocus& view, const std::atomic<bool>* stop)
    : origin(place), triangles(scene.triangles.size())
{
    const std::vector<SurfacePoint> points = placeSurfacePoints(scene, unsigned(pointSide * pointSide), view);
    if (points.empty()) return;
    const CasterBvh bvh(scene, stop);
    const NearestPoint nearest(points, scene, bvh, view);
    const ProbeGrid grid(scene, bvh, nearest, most, view, stop);
    const double spacing = spacingOf(grid.levels.back().planes);
    const std::vector<int> links = linkPoints(scene, bvh, points, nearest, float(spacing), stop);
    if (stop && *stop) return;
    const auto partsPerPoint = unsigned(partSide * partSide);
    const std::vector<SurfacePart> parts = placeSurfaceParts(scene, points, nearest, partsPerPoint, view);
    openShare = grid.openShare();
    if (mostOpen > 0.0 && openShare <= mostOpen && triangles <= SceneRays::mostTriangles)
        rays = new SceneRays(scene, bvh, parts, partsPerPoint);
    pointSpacing = double(nearest.spacing());
    writeParts(parts);
    writePoints(points);
    writePointLinks(links);
    writeProbes(grid);
}

void TransportScene::writePoints(const std::vector<SurfacePoint>& points)
{
    Texels places(pointSide, pointSide, 4), normals(pointSide, pointSide, 4);
    for (size_t i = 0; i < points.size(); ++i) {
        places.put(int(i), points[i].position, 1.0f);
        normals.put(int(i), points[i].normal, 1.0f);
        _surfaceOf.push_back(points[i].surface);
    }
    pointPlaces = places.texture(GL_RGBA32F_ARB);
    pointNormals = normals.texture(GL_RGBA32F_ARB);
}

void TransportScene::writePointLinks(const std::vector<int>& links)
{
    if (std::all_of(links.begin(), links.end(), [](int link) { return link == NOTHING; })) return;
    Texels texels(limits::POINT_LINKS * pointSide, pointSide, 1);
    for (size_t i = 0; i < links.size(); ++i) *texels.at(int(i)) = linkCode(links[i]);
    pointLinks = texels.texture(GL_R16);
}

void TransportScene::writeParts(const std::vector<SurfacePart>& parts)
{
    const int side = pointSide * partSide;
    Texels places(side, side, 4), normals(side, side, 4);
    for (int i = 0; i < int(parts.size()); ++i) {
        const int point = i / (partSide * partSide), part = i % (partSide * partSide);
        const int x = point % pointSide * partSide + part % partSide, y = point / pointSide * partSide + part / partSide;
        places.put(y * side + x, parts[size_t(i)].position, 1.0f);
        normals.put(y * side + x, parts[size_t(i)].normal, 1.0f);
    }
    partPlaces = places.texture(GL_RGBA32F_ARB);
    partNormals = normals.texture(GL_RGBA16F_ARB);
}

void TransportScene::writeLevels(const std::vector<ProbeGrid::Level>& levels)
{
    uniforms = new osg::StateSet;
    const auto array = [&](const char* name, osg::Uniform::Type type, int elements) {
        return uniforms->getOrCreateUniform(name, type, unsigned(elements));
    };
    const ProbeGrid::Planes& whole = levels.front().planes;
    osg::Uniform* planes = array("probePlanes", osg::Uniform::FLOAT, 3 * limits::MOST_PROBES);
    for (size_t k = 0; k < 3; ++k) {
        count[k] = int(whole[k].size());
        for (size_t i = 0; i < whole[k].size(); ++i) planes->setElement(unsigned(k * limits::MOST_PROBES + i), whole[k][i]);
    }
    array("probeCount", osg::Uniform::INT_VEC3, 1)->set(count[0], count[1], count[2]);
    uniforms->addUniform(new osg::Uniform("probeSpacing", float(spacingOf(levels.back().planes))));
    lattices = int(levels.size()) - 1;
    if (lattices == 0) return;
    osg::Uniform* places = array("probeLattices", osg::Uniform::FLOAT_VEC4, limits::PROBE_LATTICES);
    osg::Uniform* bounds = array("probeLatticeBounds", osg::Uniform::FLOAT_VEC3, 2 * limits::PROBE_LATTICES);
    for (unsigned i = 0; i < unsigned(lattices); ++i) {
        const ProbeGrid::Level& level = levels[i + 1];
        places->setElement(i, osg::Vec4f(level.planes[0][0], level.planes[1][0], level.planes[2][0], level.cell));
        osg::Vec3f low, high;
        for (int k = 0; k < 3; ++k) {
            const auto& ends = level.ends[size_t(k)];
            low[k] = ends[0] ? -beyond : 0.0f;
            high[k] = ends[1] ? beyond : float(count[size_t(k)] - 1);
        }
        bounds->setElement(2 * i, low);
        bounds->setElement(2 * i + 1, high);
    }
}

void TransportScene::writeProbes(const ProbeGrid& grid)
{
    writeLevels(grid.levels);
    const int probes = int(grid.probes());
    columns = int(std::ceil(std::sqrt(double(probes))));
    uniforms->addUniform(new osg::Uniform("probeColumns", columns));
    uniforms->addUniform(new osg::Uniform("pointSpacing", float(pointSpacing)));
    Texels places(columns, columns, 4);
    for (int i = 0; i < probes; ++i) {
        const ProbeGrid::Place& place = grid.places[size_t(i)];
        places.put(i, place.position, place.on ? place.weight : ofOthers * place.weight);
    }
    probePlaces = places.texture(GL_RGBA32F_ARB);

    const auto& all = ProbeGrid::directions();
    const int perTexel = limits::HARMONICS_TEXTURES;
    Texels links(int(all.size()), probes, 4), basis(int(all.size()), limits::PROBE_HARMONICS / perTexel, perTexel);
    for (size_t i = 0; i < grid.links.size(); ++i)
        std::transform(grid.links[i].begin(), grid.links[i].end(), links.at(int(i)), linkCode);
    for (int k = 0; k < limits::PROBE_HARMONICS; ++k)
        for (size_t i = 0; i < all.size(); ++i) {
            const double band = k < 1 ? 1.0 : k < 4 ? 2.0 / 3.0 : 0.25;  // A_l / pi [Ramamoorthi, Hanrahan 2001]
            const glsl::vec3 d(all[i].to.x(), all[i].to.y(), all[i].to.z());
            basis.at(int(i), k / perTexel)[k % perTexel] =
                float(4.0 * M_PI * double(all[i].share) * band * glsl::shBasis18(k, d));
        }
    probeLinks = links.texture(GL_RGBA16);
    probeBasis = basis.texture(GL_RGB32F_ARB);

    const int side = limits::PROBE_DEPTH_SIDE, tile = side + 2;
    Texels depths(columns * tile, columns * tile, 2);
    for (int i = 0; i < probes; ++i)
        for (int y = 0; y < tile; ++y)
            for (int x = 0; x < tile; ++x) {
                const glsl::ivec2 inner = glsl::foldedTexel(glsl::ivec2(x - 1, y - 1), side);
                const auto& depth = grid.depths[size_t((i * side + inner.y) * side + inner.x)];
                std::copy_n(depth.data(), 2, depths.at(i % columns * tile + x, i / columns * tile + y));
            }
    probeDepths = depths.texture(GL_RG32F);
    filterLinearly(*probeDepths);
}

osg::ref_ptr<osg::Texture2D> TransportScene::ofPoints(const StaticCasters::Parts& parts, osg::Vec3f SentLight::*member) const
{
    Texels texels(pointSide, pointSide, 4);
    for (size_t i = 0; i < _surfaceOf.size(); ++i)
        texels.put(int(i), parts[_surfaceOf[i]].sent.*member, isPolished(parts[_surfaceOf[i]].sent) ? 1.0f : 0.0f);
    return texels.texture(GL_RGBA32F_ARB);
}

osg::ref_ptr<osg::Texture2D> TransportScene::ofSome(const StaticCasters::Parts& parts, osg::Vec3f SentLight::*member) const
{
    const bool any =
        std::any_of(parts.begin(), parts.end(), [&](const StaticCasters::Part& p) { return p.sent.*member != osg::Vec3f(); });
    return any ? ofPoints(parts, member) : nullptr;
}

osg::ref_ptr<osg::Texture2D> TransportScene::diffuse(const StaticCasters::Parts& parts) const
{
    return ofPoints(parts, &SentLight::diffuse);
}

double TransportScene::polishedShare(const StaticCasters::Parts& parts) const
{
    const auto polished =
        std::count_if(_surfaceOf.begin(), _surfaceOf.end(), [&](unsigned s) { return isPolished(parts[s].sent); });
    return _surfaceOf.empty() ? 0.0 : double(polished) / double(_surfaceOf.size());
}

osg::ref_ptr<osg::Texture2D> TransportScene::glossy(const StaticCasters::Parts& parts) const
{
    return ofSome(parts, &SentLight::glossy);
}

osg::ref_ptr<osg::Texture2D> TransportScene::emissions(const StaticCasters::Parts& parts) const
{
    return ofSome(parts, &SentLight::emission);
}

std::vector<osg::Texture2D*> TransportScene::textures() const
{
    if (empty()) return {};
    std::vector<osg::Texture2D*> all = {pointPlaces.get(), pointNormals.get(), partPlaces.get(), partNormals.get(),
                                        probePlaces.get(), probeLinks.get(),   probeBasis.get(), probeDepths.get()};
    if (pointLinks) all.push_back(pointLinks.get());
    if (!rays) return all;
    for (osg::Texture2D* t : rays->textures()) all.push_back(t);
    return all;
}

size_t TransportScene::bytes() const
{
    size_t sum = 0;
    for (const osg::Texture2D* t : textures()) sum += t->getImage()->getTotalSizeInBytes();
    return sum;
}

void TransportScene::resizeGLObjectBuffers(unsigned maximum)
{
    for (osg::Texture2D* t : textures()) t->resizeGLObjectBuffers(maximum);
}

void TransportScene::releaseGLObjects(osg::State* state) const
{
    for (const osg::Texture2D* t : textures()) t->releaseGLObjects(state);
}

}  // namespace osgEnvLight

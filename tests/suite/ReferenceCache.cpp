// SPDX-License-Identifier: MIT
#include "ReferenceCache.h"

#include <osgDB/FileUtils>

#include <cstdio>
#include <cstring>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include <unistd.h>

namespace suite
{

using osgEnvLight::Picture;

namespace
{

const char magic[] = "envlight reference 1";

bool readFile(const std::string& name, std::string& content)
{
    std::ifstream in(name, std::ios::binary);
    std::ostringstream all;
    if (!in || !(all << in.rdbuf())) return false;
    content = all.str();
    return true;
}

std::uint64_t hashOf(const std::string& text)
{
    ContentHash hash;
    hash.text(text);
    return hash.get();
}

template <class T>
void append(std::string& out, const T* values, size_t count)
{
    out.append(reinterpret_cast<const char*>(values), count * sizeof(T));
}

template <class T>
bool take(const std::string& in, size_t& at, T* values, size_t count)
{
    if (count > (in.size() - at) / sizeof(T)) return false;
    std::memcpy(values, in.data() + at, count * sizeof(T));
    at += count * sizeof(T);
    return true;
}

// magic, key, number of pictures; width, height, pixels of each; the hash of
// all that.
std::string encoded(std::uint64_t key, const ReferenceCache::Pictures& pictures)
{
    std::string out(magic, sizeof magic);
    const std::uint64_t count = pictures.size();
    append(out, &key, 1);
    append(out, &count, 1);
    for (const Picture& p : pictures) {
        const std::int32_t size[2] = {p.width, p.height};
        append(out, size, 2);
        append(out, p.rgba.data(), p.rgba.size());
    }
    const std::uint64_t sum = hashOf(out);
    append(out, &sum, 1);
    return out;
}

bool decode(std::string in, std::uint64_t expectedKey, ReferenceCache::Pictures& pictures)
{
    std::uint64_t sum = 0, key = 0, count = 0;
    if (in.size() < sizeof magic + sizeof sum || in.compare(0, sizeof magic, magic, sizeof magic) != 0) return false;
    size_t at = in.size() - sizeof sum;
    take(in, at, &sum, 1);
    in.resize(in.size() - sizeof sum);
    at = sizeof magic;
    if (hashOf(in) != sum || !take(in, at, &key, 1) || key != expectedKey || !take(in, at, &count, 1)) return false;
    for (std::uint64_t i = 0; i < count; ++i) {
        std::int32_t size[2];
        if (!take(in, at, size, 2)) return false;
        Picture p(size[0], size[1]);
        if (!take(in, at, p.rgba.data(), p.rgba.size())) return false;
        pictures.push_back(std::move(p));
    }
    return at == in.size();
}

}  // namespace

void ContentHash::bytes(const void* data, size_t size)
{
    const auto* p = static_cast<const unsigned char*>(data);
    for (size_t i = 0; i < size; ++i) _hash = (_hash ^ p[i]) * 1099511628211u;
}

void ContentHash::text(const std::string& text)
{
    value(text.size());
    bytes(text.data(), text.size());
}

void ContentHash::camera(const osg::Matrixd& view, const osg::Matrixd& projection, int width, int height)
{
    bytes(view.ptr(), 16 * sizeof(double));
    bytes(projection.ptr(), 16 * sizeof(double));
    value(width);
    value(height);
}

void ContentHash::map(const osgEnvLight::RadianceMap& map, double rotation, double intensity)
{
    value(map.width);
    value(map.height);
    bytes(map.image->data(), map.image->getTotalSizeInBytes());
    value(rotation);
    value(intensity);
}

void ContentHash::options(const osgEnvLight::ReferenceOptions& o)
{
    value(o.paths);
    value(o.estimator);
    value(o.samples);
    value(o.error);
    value(o.pass);
    value(o.seed);
    value(o.antialias);
    value(o.occlusionReach);
}

void ContentHash::scene(const osgEnvLight::TriangleScene& scene)
{
    bytes(&scene.origin, sizeof scene.origin);
    value(scene.meshes.size());
    for (const osgEnvLight::TriangleMesh& mesh : scene.meshes) {
        material(mesh.material);
        elements(mesh.positions);
        elements(mesh.normals);
        elements(mesh.colors);
        elements(mesh.texCoords);
        elements(mesh.triangles);
        value(mesh.emitter);
    }
    value(scene.emitters.size());
    for (const osgEnvLight::Emitter& e : scene.emitters) emitter(e);
}

void ContentHash::emitter(const osgEnvLight::Emitter& e)
{
    value(e.shape);
    for (const osg::Vec3d& v : {e.center, e.u, e.v, e.normal, e.radiance}) bytes(v.ptr(), 3 * sizeof(double));
    elements(e.vertices);
    elements(e.triangles);
    value(e.twoSided);
    value(e.area);
}

void ContentHash::material(const osgEnvLight::SurfaceMaterial& m)
{
    value(m.brdf);
    bytes(&m.color, sizeof m.color);
    bytes(&m.specular, sizeof m.specular);
    bytes(&m.emission, sizeof m.emission);
    for (double d : {m.emissionScale, m.exponent, m.metalness, m.roughness, m.alphaReference}) value(d);
    for (bool b : {m.encoded, m.unlit, m.vertexColored, m.limited, m.alphaTest, m.blended, m.clockwiseFront}) value(b);
    value(m.alphaFunction);
    value(m.sides);
    value(m.textureMode);
    bytes(&m.textureColor, sizeof m.textureColor);
    value(m.texture != nullptr);
    if (!m.texture) return;
    elements(m.texture->texels());
    // Filters, wrap modes and mip levels as they act, within and beyond the
    // image, near and far.
    for (double footprint : {0.0, 0.1})
        for (int i = 0; i < 24 * 24; ++i) {
            const glm::dvec2 st(i % 24 * 0.13 - 1.0, i / 24 * 0.13 - 1.0);
            const glm::dvec4 c = m.texture->sample(st, glm::dvec2(footprint, 0.0), glm::dvec2(0.0, footprint));
            bytes(&c, sizeof c);
        }
}

void ContentHash::file(const std::string& name)
{
    std::string content;
    if (!readFile(name, content)) throw std::runtime_error(name + ": can't be read");
    text(content);
}

ReferenceCache::ReferenceCache(const std::string& folder) : _folder(folder)
{
    osgDB::makeDirectory(folder);
}

std::string ReferenceCache::fileName(std::uint64_t key) const
{
    char digits[17];
    std::snprintf(digits, sizeof digits, "%016llx", static_cast<unsigned long long>(key));
    return _folder + "/" + digits;
}

ReferenceCache::Pictures ReferenceCache::get(std::uint64_t key, const std::function<Pictures()>& make)
{
    const std::string name = fileName(key);
    Pictures pictures;
    std::string content;
    if (readFile(name, content) && decode(content, key, pictures)) return pictures;
    pictures = make();
    // Under a name of our own first: another process may be at the same.
    const std::string unfinished = name + "." + std::to_string(getpid());
    std::ofstream out(unfinished, std::ios::binary);
    out << encoded(key, pictures);
    out.close();
    if (!out || std::rename(unfinished.c_str(), name.c_str()) != 0) std::remove(unfinished.c_str());
    return pictures;
}

}  // namespace suite

// SPDX-License-Identifier: MIT
#include "Accessors.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace osgEnvLight::gltf
{

namespace
{

std::string typeName(unsigned components)
{
    if (components == 1) return "SCALAR";
    if (components <= 4) return "VEC" + std::to_string(components);
    return components == 9 ? "MAT3" : "MAT4";
}

template <class T>
double load(const unsigned char* data)
{
    T value;
    std::memcpy(&value, data, sizeof value);
    return double(value);
}

double loadComponent(int type, const unsigned char* data)
{
    switch (type) {
        case TINYGLTF_COMPONENT_TYPE_BYTE:
            return load<std::int8_t>(data);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return load<std::uint8_t>(data);
        case TINYGLTF_COMPONENT_TYPE_SHORT:
            return load<std::int16_t>(data);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return load<std::uint16_t>(data);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
            return load<std::uint32_t>(data);
        default:
            return load<float>(data);
    }
}

/** The number that a normalised integer stands for (glTF 2.0, 3.6.2.2 and 2.11). */
double normalized(int type, double c)
{
    switch (type) {
        case TINYGLTF_COMPONENT_TYPE_BYTE:
            return std::max(c / 127.0, -1.0);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return c / 255.0;
        case TINYGLTF_COMPONENT_TYPE_SHORT:
            return std::max(c / 32767.0, -1.0);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return c / 65535.0;
        default:
            return c;
    }
}

}  // namespace

/** Where the components of an accessor lie. */
struct Accessors::Elements {
    const unsigned char* data = nullptr;  // null: all are 0
    std::size_t count = 0;
    std::size_t stride = 0;
    int type = 0;
    std::size_t componentBytes = 0;
    unsigned components = 0;
    bool normalize = false;

    double component(std::size_t i, unsigned c) const
    {
        if (!data) return 0.0;
        const double value = loadComponent(type, data + i * stride + c * componentBytes);
        return normalize ? normalized(type, value) : value;
    }
};

Accessors::Accessors(const Asset& asset) : _asset(asset), _budget((std::uint64_t(16) << 20) + 64 * asset.bufferBytes()) {}

void Accessors::spend(std::uint64_t bytes, const std::string& path)
{
    if (bytes > _budget)
        _asset.fail(path, "no more data than a file of this size describes",
                    std::to_string(bytes) + " bytes of it beyond 64 times its buffers");
    _budget -= bytes;
}

unsigned Accessors::components(int accessor) const
{
    return unsigned(tinygltf::GetNumComponentsInType(std::uint32_t(_asset.model.accessors[std::size_t(accessor)].type)));
}

void Accessors::checkFits(const Elements& e, std::uint64_t available, const std::string& path) const
{
    // At most 2^31 elements of at most 252 bytes.
    const std::uint64_t needed = std::uint64_t(e.count - 1) * e.stride + e.components * e.componentBytes;
    if (needed > available) _asset.fail(path, std::to_string(needed) + " bytes in its buffer view", std::to_string(available));
}

Accessors::Elements Accessors::elements(int accessor, unsigned components, const std::string& path)
{
    const tinygltf::Accessor& a = _asset.model.accessors[std::size_t(accessor)];
    const unsigned has = this->components(accessor);
    if (components != 0 && has != components) _asset.fail(path, "an accessor of " + typeName(components), typeName(has));
    Elements e;
    e.count = a.count;
    e.type = a.componentType;
    e.componentBytes = std::size_t(tinygltf::GetComponentSizeInBytes(std::uint32_t(a.componentType)));
    e.components = has;
    e.normalize = a.normalized;
    e.stride = e.components * e.componentBytes;
    if (a.bufferView < 0) return e;
    const std::size_t stride = _asset.model.bufferViews[std::size_t(a.bufferView)].byteStride;
    if (stride != 0) e.stride = stride;
    const Asset::Range range = _asset.view(a.bufferView);
    const std::uint64_t offset = std::min<std::uint64_t>(a.byteOffset, range.size);
    e.data = range.data + offset;
    checkFits(e, range.size - offset, element("accessors", std::size_t(accessor)));
    return e;
}

void Accessors::applySparse(int accessor, const Elements& base, std::vector<double>& values)
{
    const tinygltf::Accessor& a = _asset.model.accessors[std::size_t(accessor)];
    const std::string path = element("accessors", std::size_t(accessor)) + ".sparse";
    const std::size_t count = std::size_t(a.sparse.count);
    if (count > base.count) _asset.fail(path + ".count", "at most " + std::to_string(base.count), std::to_string(count));
    const auto tight = [&](int view, int byteOffset, int type, unsigned components, const std::string& where) {
        Elements e = base;
        e.count = count;
        e.type = type;
        e.componentBytes = std::size_t(tinygltf::GetComponentSizeInBytes(std::uint32_t(type)));
        e.components = components;
        e.stride = components * e.componentBytes;
        const Asset::Range range = _asset.view(view);
        const std::uint64_t offset = std::min(std::uint64_t(byteOffset), range.size);
        e.data = range.data + offset;
        checkFits(e, range.size - offset, where);
        return e;
    };
    Elements indices =
        tight(a.sparse.indices.bufferView, a.sparse.indices.byteOffset, a.sparse.indices.componentType, 1, path + ".indices");
    indices.normalize = false;
    const Elements replaced =
        tight(a.sparse.values.bufferView, a.sparse.values.byteOffset, base.type, base.components, path + ".values");
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t at = std::size_t(indices.component(i, 0));
        if (at >= base.count)
            _asset.fail(path + ".indices", "indices below " + std::to_string(base.count),
                        std::to_string(at) + " at " + std::to_string(i));
        for (unsigned c = 0; c < base.components; ++c) values[at * base.components + c] = replaced.component(i, c);
    }
}

std::vector<double> Accessors::numbers(int accessor, unsigned components, const std::string& path)
{
    const Elements e = elements(accessor, components, path);
    spend(std::uint64_t(e.count) * e.components * sizeof(double), path);
    std::vector<double> values(e.count * e.components);
    if (e.data)
        for (std::size_t i = 0; i < e.count; ++i)
            for (unsigned c = 0; c < e.components; ++c) values[i * e.components + c] = e.component(i, c);
    if (_asset.model.accessors[std::size_t(accessor)].sparse.isSparse) applySparse(accessor, e, values);
    return values;
}

std::vector<float> Accessors::floats(int accessor, unsigned components, const std::string& path)
{
    const std::vector<double> values = numbers(accessor, components, path);
    const unsigned width = this->components(accessor);
    for (std::size_t i = 0; i < values.size(); ++i)
        if (!std::isfinite(values[i]))
            _asset.fail(path, "finite numbers",
                        (std::isnan(values[i]) ? "NaN" : "infinity") + std::string(" in element ") + std::to_string(i / width));
    return std::vector<float>(values.begin(), values.end());
}

std::vector<unsigned> Accessors::integers(int accessor, unsigned components, const std::string& path)
{
    const tinygltf::Accessor& a = _asset.model.accessors[std::size_t(accessor)];
    const bool whole = a.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE ||
                       a.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ||
                       a.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
    if (!whole || a.normalized)
        _asset.fail(path, "unsigned integers",
                    a.normalized ? "normalised ones" : "component type " + std::to_string(a.componentType));
    const std::vector<double> values = numbers(accessor, components, path);
    std::vector<unsigned> result(values.size());
    std::transform(values.begin(), values.end(), result.begin(), [](double v) { return unsigned(v); });
    return result;
}

osg::ref_ptr<osg::DrawElements> Accessors::indices(int accessor, GLenum mode, std::size_t vertices, const std::string& path)
{
    const std::vector<unsigned> values = integers(accessor, 1, path);
    const auto bad = std::find_if(values.begin(), values.end(), [&](unsigned v) { return v >= vertices; });
    if (bad != values.end())
        _asset.fail(path, "indices below " + std::to_string(vertices),
                    std::to_string(*bad) + " at " + std::to_string(bad - values.begin()));
    osg::ref_ptr<osg::DrawElements> elements;
    if (_asset.model.accessors[std::size_t(accessor)].componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT)
        elements = new osg::DrawElementsUInt(mode, values.begin(), values.end());
    else
        elements = new osg::DrawElementsUShort(mode, values.begin(), values.end());
    return elements;
}

}  // namespace osgEnvLight::gltf

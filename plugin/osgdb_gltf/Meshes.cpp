// SPDX-License-Identifier: MIT
#include "Meshes.h"

#include <osgAnimation/MorphGeometry>

#include <algorithm>
#include <array>

namespace osgEnvLight::gltf
{

namespace
{

constexpr unsigned texCoordSets = 4;

template <class Array>
osg::ref_ptr<Array> copied(const Array* array)
{
    return new Array(*array, osg::CopyOp::DEEP_COPY_ALL);
}

}  // namespace

std::string Meshes::path(int mesh, std::size_t primitive)
{
    return element(element("meshes", std::size_t(mesh)) + ".primitives", primitive);
}

bool Meshes::hasTargets(int mesh) const
{
    const std::vector<tinygltf::Primitive>& list = _asset.model.meshes[std::size_t(mesh)].primitives;
    return std::any_of(list.begin(), list.end(), [](const tinygltf::Primitive& p) { return !p.targets.empty(); });
}

osg::Geode* Meshes::geode(int mesh)
{
    osg::ref_ptr<osg::Geode>& geode = _geodes[std::size_t(mesh)];
    if (geode) return geode.get();
    geode = new osg::Geode;
    geode->setName(_asset.model.meshes[std::size_t(mesh)].name);
    for (std::size_t i = 0; i < primitives(mesh); ++i) geode->addDrawable(primitive(mesh, i, {}));
    return geode.get();
}

osg::ref_ptr<osg::Geometry> Meshes::primitive(int mesh, std::size_t primitive, const std::vector<double>& weights)
{
    const bool morphs = !_asset.model.meshes[std::size_t(mesh)].primitives[primitive].targets.empty();
    osg::ref_ptr<osg::Geometry> geometry = morphs ? new osgAnimation::MorphGeometry : new osg::Geometry;
    geometry->setUseDisplayList(false);
    geometry->setUseVertexBufferObjects(true);
    fill(*geometry, mesh, primitive);
    if (morphs) fillTargets(*geometry, mesh, primitive, weights);
    return geometry;
}

int Meshes::attribute(const tinygltf::Primitive& p, const char* name) const
{
    const auto found = p.attributes.find(name);
    return found == p.attributes.end() ? -1 : found->second;
}

int Meshes::matching(const tinygltf::Primitive& p, const char* name, std::size_t vertices, const std::string& path) const
{
    const int accessor = attribute(p, name);
    if (accessor >= 0 && _accessors.count(accessor) != vertices)
        _asset.fail(path + ".attributes." + name, std::to_string(vertices) + " elements as POSITION has",
                    std::to_string(_accessors.count(accessor)));
    return accessor;
}

void Meshes::fill(osg::Geometry& geometry, int mesh, std::size_t primitive)
{
    const tinygltf::Primitive& p = _asset.model.meshes[std::size_t(mesh)].primitives[primitive];
    const std::string where = path(mesh, primitive);
    const std::string attributes = where + ".attributes";
    const int position = attribute(p, "POSITION");
    if (position < 0) _asset.fail(attributes + ".POSITION", "an accessor of VEC3", "nothing");
    osg::Vec3Array* vertices = _accessors.vec3(position, attributes + ".POSITION");
    geometry.setVertexArray(vertices);

    const int normal = matching(p, "NORMAL", vertices->size(), where);
    if (normal >= 0) geometry.setNormalArray(_accessors.vec3(normal, attributes + ".NORMAL"));
    const int tangent = matching(p, "TANGENT", vertices->size(), where);
    if (tangent >= 0)
        geometry.setVertexAttribArray(MaterialNames::tangentAttribute, _accessors.vec4(tangent, attributes + ".TANGENT"));
    fillTextureCoordinates(geometry, p, where);
    fillColors(geometry, p, where);

    const GLenum mode = GLenum(p.mode);  // glTF's numbers are OpenGL's
    if (p.indices >= 0)
        geometry.addPrimitiveSet(_accessors.indices(p.indices, mode, vertices->size(), where + ".indices"));
    else
        geometry.addPrimitiveSet(new osg::DrawArrays(mode, 0, GLsizei(vertices->size())));
}

void Meshes::fillTextureCoordinates(osg::Geometry& geometry, const tinygltf::Primitive& p, const std::string& path)
{
    const std::size_t vertices = geometry.getVertexArray()->getNumElements();
    std::array<osg::Vec2Array*, texCoordSets> sets = {};
    for (unsigned i = 0; i < texCoordSets; ++i) {
        const std::string name = "TEXCOORD_" + std::to_string(i);
        const int accessor = matching(p, name.c_str(), vertices, path);
        if (accessor >= 0) sets[i] = _accessors.vec2(accessor, path + ".attributes." + name);
    }
    std::swap(sets[0], sets[_materials.baseTexCoord(p.material)]);
    for (unsigned i = 0; i < texCoordSets; ++i)
        if (sets[i]) geometry.setTexCoordArray(i, sets[i]);
}

void Meshes::fillColors(osg::Geometry& geometry, const tinygltf::Primitive& p, const std::string& path)
{
    const std::size_t vertices = geometry.getVertexArray()->getNumElements();
    const int accessor = matching(p, "COLOR_0", vertices, path);
    Materials::Form form;
    form.vertexColors = accessor >= 0;
    // Points and lines have no faces that could give normals.
    form.unlit = _materials.isUnlit(p.material) || (p.mode <= TINYGLTF_MODE_LINE_STRIP && !geometry.getNormalArray());
    geometry.setStateSet(_materials.stateSet(p.material, form));
    if (!form.vertexColors && !form.unlit) return;

    const osg::Vec4d base = _materials.baseColor(p.material);
    if (!form.vertexColors) {
        osg::ref_ptr<osg::Vec4Array> color = new osg::Vec4Array(osg::Array::BIND_OVERALL, 1);
        (*color)[0] = displayColor(base);
        return geometry.setColorArray(color);
    }
    const unsigned width = _accessors.components(accessor);
    const std::string where = path + ".attributes.COLOR_0";
    if (width != 3 && width != 4) _asset.fail(where, "an accessor of VEC3 or VEC4", std::to_string(width) + " components");
    const std::vector<float> values = _accessors.floats(accessor, width, where);
    osg::ref_ptr<osg::Vec4Array> colors = new osg::Vec4Array(osg::Array::BIND_PER_VERTEX, unsigned(vertices));
    for (std::size_t i = 0; i < vertices; ++i) {
        osg::Vec4d c = base;
        for (unsigned k = 0; k < width; ++k) c.ptr()[k] *= values[i * width + k];
        (*colors)[i] = displayColor(c);
    }
    geometry.setColorArray(colors);
}

void Meshes::fillTargets(osg::Geometry& geometry, int mesh, std::size_t primitive, const std::vector<double>& weights)
{
    const tinygltf::Primitive& p = _asset.model.meshes[std::size_t(mesh)].primitives[primitive];
    const std::string where = path(mesh, primitive);
    auto& morph = static_cast<osgAnimation::MorphGeometry&>(geometry);
    const auto* base = static_cast<const osg::Vec3Array*>(geometry.getVertexArray());
    const std::size_t vertices = base->size();
    _accessors.spend(vertices * sizeof(osg::Vec3) * 3, where);
    geometry.setVertexArray(copied(base));
    const auto* normals = static_cast<const osg::Vec3Array*>(geometry.getNormalArray());
    if (normals) geometry.setNormalArray(copied(normals));
    morph.setMethod(osgAnimation::MorphGeometry::RELATIVE);
    bool morphsNormals = normals != nullptr;

    for (std::size_t i = 0; i < p.targets.size(); ++i) {
        osg::ref_ptr<osg::Geometry> target = new osg::Geometry;
        const auto displacement = [&](const char* name) -> osg::ref_ptr<osg::Vec3Array> {
            const auto found = p.targets[i].find(name);
            if (found == p.targets[i].end()) return nullptr;
            const std::string of = element(where + ".targets", i) + "." + name;
            if (_accessors.count(found->second) != vertices)
                _asset.fail(of, std::to_string(vertices) + " elements as POSITION has",
                            std::to_string(_accessors.count(found->second)));
            return _accessors.vec3(found->second, of);
        };
        osg::ref_ptr<osg::Vec3Array> positions = displacement("POSITION");
        if (!positions) {
            _accessors.spend(vertices * sizeof(osg::Vec3), where);
            positions = new osg::Vec3Array(unsigned(vertices));
        }
        target->setVertexArray(positions);
        const osg::ref_ptr<osg::Vec3Array> normalChanges = displacement("NORMAL");
        target->setNormalArray(normalChanges);
        morphsNormals = morphsNormals && normalChanges;
        morph.addMorphTarget(target, i < weights.size() ? float(weights[i]) : 0.0f);
    }
    morph.setMorphNormals(morphsNormals);
}

}  // namespace osgEnvLight::gltf

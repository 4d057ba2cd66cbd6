// SPDX-License-Identifier: MIT
#include "Schema.h"

#include "base/JsonValue.h"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <vector>

namespace osgEnvLight::gltf
{

namespace
{

using nlohmann::json;

enum Kind { OBJECT, LIST, NUMBER, INTEGER, BOOLEAN, TEXT, INDEX, CHOICE };

constexpr double FLOATS = 3e38;               // uniforms and vertices are floats
constexpr double BYTES = 9007199254740992.0;  // what a double counts exactly
constexpr bool REQUIRED = true;
constexpr bool OPTIONAL = false;

/** What a property has to be. "a[].b.*" stands for every member of b in every element of the list a. */
struct Rule {
    const char* path;
    Kind kind;
    bool required = OPTIONAL;
    double low = -FLOATS;    // of numbers; of a LIST: the least number of elements
    double high = FLOATS;    // the most
    const char* words = "";  // INDEX: of which list; CHOICE: of what, separated by blanks
};

/** Whether it is a file that this reader knows. */
const Rule headerRules[] = {
    {"asset", OBJECT, REQUIRED}, {"asset.version", TEXT, REQUIRED}, {"asset.minVersion", TEXT},
    {"extensionsUsed[]", TEXT},  {"extensionsRequired[]", TEXT},
};

const Rule rules[] = {
    {"buffers[].byteLength", INTEGER, REQUIRED, 1, BYTES},
    {"buffers[].uri", TEXT},
    {"bufferViews[].buffer", INDEX, REQUIRED, 0, 0, "buffers"},
    {"bufferViews[].byteOffset", INTEGER, OPTIONAL, 0, BYTES},
    {"bufferViews[].byteLength", INTEGER, REQUIRED, 1, BYTES},
    {"bufferViews[].byteStride", INTEGER, OPTIONAL, 4, 252},

    {"accessors[].bufferView", INDEX, OPTIONAL, 0, 0, "bufferViews"},
    {"accessors[].byteOffset", INTEGER, OPTIONAL, 0, BYTES},
    {"accessors[].componentType", CHOICE, REQUIRED, 0, 0, "5120 5121 5122 5123 5125 5126"},
    {"accessors[].normalized", BOOLEAN},
    {"accessors[].count", INTEGER, REQUIRED, 1, 2147483647},
    {"accessors[].type", CHOICE, REQUIRED, 0, 0, "SCALAR VEC2 VEC3 VEC4 MAT2 MAT3 MAT4"},
    {"accessors[].sparse.count", INTEGER, REQUIRED, 1, 2147483647},
    {"accessors[].sparse.indices", OBJECT, REQUIRED},
    {"accessors[].sparse.indices.bufferView", INDEX, REQUIRED, 0, 0, "bufferViews"},
    {"accessors[].sparse.indices.byteOffset", INTEGER, OPTIONAL, 0, 2147483647},
    {"accessors[].sparse.indices.componentType", CHOICE, REQUIRED, 0, 0, "5121 5123 5125"},
    {"accessors[].sparse.values", OBJECT, REQUIRED},
    {"accessors[].sparse.values.bufferView", INDEX, REQUIRED, 0, 0, "bufferViews"},
    {"accessors[].sparse.values.byteOffset", INTEGER, OPTIONAL, 0, 2147483647},

    {"meshes[].name", TEXT},
    {"meshes[].primitives", LIST, REQUIRED, 1},
    {"meshes[].primitives[].attributes", OBJECT, REQUIRED},
    {"meshes[].primitives[].attributes.*", INDEX, OPTIONAL, 0, 0, "accessors"},
    {"meshes[].primitives[].indices", INDEX, OPTIONAL, 0, 0, "accessors"},
    {"meshes[].primitives[].material", INDEX, OPTIONAL, 0, 0, "materials"},
    {"meshes[].primitives[].mode", INTEGER, OPTIONAL, 0, 6},
    {"meshes[].primitives[].targets[].*", INDEX, OPTIONAL, 0, 0, "accessors"},
    {"meshes[].weights[]", NUMBER},

    {"scene", INDEX, OPTIONAL, 0, 0, "scenes"},
    {"scenes[].name", TEXT},
    {"scenes[].nodes[]", INDEX, OPTIONAL, 0, 0, "nodes"},
    {"nodes[].name", TEXT},
    {"nodes[].children[]", INDEX, OPTIONAL, 0, 0, "nodes"},
    {"nodes[].mesh", INDEX, OPTIONAL, 0, 0, "meshes"},
    {"nodes[].skin", INDEX, OPTIONAL, 0, 0, "skins"},
    {"nodes[].camera", INDEX, OPTIONAL, 0, 0, "cameras"},
    {"nodes[].matrix", LIST, OPTIONAL, 16, 16},
    {"nodes[].matrix[]", NUMBER},
    {"nodes[].translation", LIST, OPTIONAL, 3, 3},
    {"nodes[].translation[]", NUMBER},
    {"nodes[].rotation", LIST, OPTIONAL, 4, 4},
    {"nodes[].rotation[]", NUMBER},
    {"nodes[].scale", LIST, OPTIONAL, 3, 3},
    {"nodes[].scale[]", NUMBER},
    {"nodes[].weights[]", NUMBER},
    {"nodes[].extensions.KHR_lights_punctual.light", INDEX, REQUIRED, 0, 0, "extensions.KHR_lights_punctual.lights"},
    {"nodes[].extensions.EXT_mesh_gpu_instancing.attributes.*", INDEX, OPTIONAL, 0, 0, "accessors"},

    {"cameras[].name", TEXT},
    {"cameras[].type", CHOICE, REQUIRED, 0, 0, "perspective orthographic"},
    {"cameras[].perspective.yfov", NUMBER, REQUIRED, 1e-3, 3.1},

    {"skins[].joints", LIST, REQUIRED, 1},
    {"skins[].joints[]", INDEX, OPTIONAL, 0, 0, "nodes"},
    {"skins[].inverseBindMatrices", INDEX, OPTIONAL, 0, 0, "accessors"},
    {"animations[].name", TEXT},
    {"animations[].channels", LIST, REQUIRED, 1},
    {"animations[].channels[].sampler", INTEGER, REQUIRED, 0, 2147483647},
    {"animations[].channels[].target", OBJECT, REQUIRED},
    {"animations[].channels[].target.node", INDEX, OPTIONAL, 0, 0, "nodes"},
    {"animations[].channels[].target.path", TEXT, REQUIRED},
    {"animations[].samplers", LIST, REQUIRED, 1},
    {"animations[].samplers[].input", INDEX, REQUIRED, 0, 0, "accessors"},
    {"animations[].samplers[].output", INDEX, REQUIRED, 0, 0, "accessors"},
    {"animations[].samplers[].interpolation", CHOICE, OPTIONAL, 0, 0, "LINEAR STEP CUBICSPLINE"},

    {"images[].uri", TEXT},
    {"images[].bufferView", INDEX, OPTIONAL, 0, 0, "bufferViews"},
    {"textures[].source", INDEX, OPTIONAL, 0, 0, "images"},
    {"textures[].sampler", INDEX, OPTIONAL, 0, 0, "samplers"},
    {"samplers[].magFilter", CHOICE, OPTIONAL, 0, 0, "9728 9729"},
    {"samplers[].minFilter", CHOICE, OPTIONAL, 0, 0, "9728 9729 9984 9985 9986 9987"},
    {"samplers[].wrapS", CHOICE, OPTIONAL, 0, 0, "33071 33648 10497"},
    {"samplers[].wrapT", CHOICE, OPTIONAL, 0, 0, "33071 33648 10497"},

    {"materials[].name", TEXT},
    {"materials[].pbrMetallicRoughness", OBJECT},
    {"materials[].pbrMetallicRoughness.baseColorFactor", LIST, OPTIONAL, 4, 4},
    {"materials[].pbrMetallicRoughness.baseColorFactor[]", NUMBER, OPTIONAL, 0, 1},
    {"materials[].pbrMetallicRoughness.metallicFactor", NUMBER, OPTIONAL, 0, 1},
    {"materials[].pbrMetallicRoughness.roughnessFactor", NUMBER, OPTIONAL, 0, 1},
    {"materials[].normalTexture.scale", NUMBER},
    {"materials[].occlusionTexture.strength", NUMBER, OPTIONAL, 0, 1},
    {"materials[].emissiveFactor", LIST, OPTIONAL, 3, 3},
    {"materials[].emissiveFactor[]", NUMBER, OPTIONAL, 0, 1},
    {"materials[].alphaMode", CHOICE, OPTIONAL, 0, 0, "OPAQUE MASK BLEND"},
    {"materials[].alphaCutoff", NUMBER, OPTIONAL, 0},
    {"materials[].doubleSided", BOOLEAN},
    {"materials[].extensions", OBJECT},
    {"materials[].extensions.KHR_materials_unlit", OBJECT},
    {"materials[].extensions.KHR_materials_emissive_strength.emissiveStrength", NUMBER, OPTIONAL, 0},
    {"materials[].extensions.KHR_materials_clearcoat.clearcoatFactor", NUMBER, OPTIONAL, 0, 1},
    {"materials[].extensions.KHR_materials_clearcoat.clearcoatRoughnessFactor", NUMBER, OPTIONAL, 0, 1},
    {"materials[].extensions.KHR_materials_clearcoat.clearcoatNormalTexture.scale", NUMBER},
    {"materials[].extensions.KHR_materials_anisotropy.anisotropyStrength", NUMBER, OPTIONAL, 0, 1},
    {"materials[].extensions.KHR_materials_anisotropy.anisotropyRotation", NUMBER},
    {"materials[].extensions.KHR_materials_ior.ior", NUMBER, OPTIONAL, 0},
    {"materials[].extensions.KHR_materials_specular.specularFactor", NUMBER, OPTIONAL, 0, 1},
    {"materials[].extensions.KHR_materials_specular.specularColorFactor", LIST, OPTIONAL, 3, 3},
    {"materials[].extensions.KHR_materials_specular.specularColorFactor[]", NUMBER, OPTIONAL, 0},
    {"materials[].extensions.KHR_materials_transmission.transmissionFactor", NUMBER, OPTIONAL, 0, 1},

    {"extensions.KHR_lights_punctual.lights[].type", CHOICE, REQUIRED, 0, 0, "directional point spot"},
    {"extensions.KHR_lights_punctual.lights[].color", LIST, OPTIONAL, 3, 3},
    {"extensions.KHR_lights_punctual.lights[].color[]", NUMBER, OPTIONAL, 0},
    {"extensions.KHR_lights_punctual.lights[].intensity", NUMBER, OPTIONAL, 0},
    {"extensions.KHR_lights_punctual.lights[].range", NUMBER, OPTIONAL, 0},
    {"extensions.KHR_lights_punctual.lights[].spot", OBJECT},
    {"extensions.KHR_lights_punctual.lights[].spot.innerConeAngle", NUMBER, OPTIONAL, 0, 1.5708},
    {"extensions.KHR_lights_punctual.lights[].spot.outerConeAngle", NUMBER, OPTIONAL, 0, 1.5708},
};

/** Where a material refers to a texture, and what may be said there. */
const char* const textureUses[] = {
    "materials[].pbrMetallicRoughness.baseColorTexture",
    "materials[].pbrMetallicRoughness.metallicRoughnessTexture",
    "materials[].normalTexture",
    "materials[].occlusionTexture",
    "materials[].emissiveTexture",
    "materials[].extensions.KHR_materials_anisotropy.anisotropyTexture",
    "materials[].extensions.KHR_materials_clearcoat.clearcoatTexture",
    "materials[].extensions.KHR_materials_clearcoat.clearcoatRoughnessTexture",
    "materials[].extensions.KHR_materials_clearcoat.clearcoatNormalTexture",
};
const Rule textureRules[] = {
    {".index", INDEX, REQUIRED, 0, 0, "textures"},
    {".texCoord", INTEGER, OPTIONAL, 0, 3},
    {".extensions.KHR_texture_transform.offset", LIST, OPTIONAL, 2, 2},
    {".extensions.KHR_texture_transform.offset[]", NUMBER},
    {".extensions.KHR_texture_transform.rotation", NUMBER},
    {".extensions.KHR_texture_transform.scale", LIST, OPTIONAL, 2, 2},
    {".extensions.KHR_texture_transform.scale[]", NUMBER},
    {".extensions.KHR_texture_transform.texCoord", INTEGER, OPTIONAL, 0, 3},
};

const char* const knownExtensions[] = {
    "KHR_materials_unlit", "KHR_materials_anisotropy", "KHR_materials_emissive_strength", "KHR_materials_clearcoat",
    "KHR_materials_ior",   "KHR_materials_specular",   "KHR_materials_transmission",      "KHR_texture_transform",
    "KHR_lights_punctual", "KHR_mesh_quantization",    "EXT_mesh_gpu_instancing",
};

/** Without the decimal point of a locale. */
std::string numberText(double x)
{
    return x == std::floor(x) && std::abs(x) < 1e15 ? std::to_string(std::int64_t(x)) : json(x).dump();
}

std::string rangeText(const Rule& rule, const std::string& what)
{
    const bool low = rule.low > -FLOATS;
    const bool high = rule.high < FLOATS;
    if (low && high) return what + " from " + numberText(rule.low) + " to " + numberText(rule.high);
    return low ? what + " of at least " + numberText(rule.low) : what;
}

std::string listText(const Rule& rule)
{
    if (rule.low == rule.high) return "a list of " + numberText(rule.low) + " elements";
    return rule.low > 0 ? "a list of at least " + numberText(rule.low) + " element" : "a list";
}

std::string choiceText(const Rule& rule)
{
    std::string text = "one of ";
    for (const char* c = rule.words; *c; ++c) text += *c == ' ' ? std::string(", ") : std::string(1, *c);
    return text;
}

bool isChoice(const Rule& rule, const json& value)
{
    const std::string text = value.is_string()           ? value.get<std::string>()
                             : value.is_number_integer() ? value.dump()
                                                         : std::string();
    const std::string words = " " + std::string(rule.words) + " ";
    return !text.empty() && text.find(' ') == std::string::npos && words.find(" " + text + " ") != std::string::npos;
}

/** One rule held against the document. */
class RuleCheck
{
  public:
    RuleCheck(const json& document, const std::string& name, const Rule& rule, std::string path)
        : _document(document), _name(name), _rule(rule), _path(std::move(path))
    {
    }

    void run() const { visit(JsonValue(_document, _name, ""), _path); }

  private:
    void visit(const JsonValue& parent, std::string_view path) const
    {
        if (!parent.get().is_object()) parent.fail("an object");
        const std::size_t dot = path.find('.');
        std::string key(path.substr(0, dot));
        const std::string_view rest = dot == std::string_view::npos ? std::string_view() : path.substr(dot + 1);
        const bool list = key.size() > 2 && key.compare(key.size() - 2, 2, "[]") == 0;
        if (list) key.resize(key.size() - 2);
        if (key == "*") {
            for (const auto& member : parent.get().items()) test(parent[member.key()]);
        } else if (parent.has(key.c_str())) {
            descend(parent[key], list, rest);
        } else if (_rule.required && rest.empty() && !list) {
            parent.failMissing(key, expected());
        }
    }

    void descend(const JsonValue& value, bool list, std::string_view rest) const
    {
        if (!list) return rest.empty() ? test(value) : visit(value, rest);
        if (!value.get().is_array()) value.fail("a list");
        for (std::size_t i = 0; i < value.size(); ++i) rest.empty() ? test(value.element(i)) : visit(value.element(i), rest);
    }

    std::size_t targets() const
    {
        const json* list = &_document;
        std::string_view path = _rule.words;
        while (!path.empty()) {
            const std::size_t dot = path.find('.');
            const auto found = list->is_object() ? list->find(std::string(path.substr(0, dot))) : list->end();
            if (!list->is_object() || found == list->end()) return 0;
            list = &*found;
            path = dot == std::string_view::npos ? std::string_view() : path.substr(dot + 1);
        }
        return list->is_array() ? list->size() : 0;
    }

    std::string expected() const
    {
        switch (_rule.kind) {
            case OBJECT:
                return "an object";
            case LIST:
                return listText(_rule);
            case NUMBER:
                return rangeText(_rule, "a number");
            case INTEGER:
                return rangeText(_rule, "an integer");
            case BOOLEAN:
                return "true or false";
            case TEXT:
                return "a string";
            case INDEX:
                return "an index below " + std::to_string(targets()) + ", the number of " + _rule.words;
            case CHOICE:
                break;
        }
        return choiceText(_rule);
    }

    bool holds(const json& value) const
    {
        switch (_rule.kind) {
            case OBJECT:
                return value.is_object();
            case LIST:
                return value.is_array() && double(value.size()) >= _rule.low && double(value.size()) <= _rule.high;
            case NUMBER:
            case INTEGER:
                return (_rule.kind == NUMBER ? value.is_number() : value.is_number_integer()) &&
                       value.get<double>() >= _rule.low && value.get<double>() <= _rule.high;
            case BOOLEAN:
                return value.is_boolean();
            case TEXT:
                return value.is_string();
            case INDEX:
                return value.is_number_unsigned() && value.get<std::uint64_t>() < targets();
            case CHOICE:
                break;
        }
        return isChoice(_rule, value);
    }

    void test(const JsonValue& value) const
    {
        if (!holds(value.get())) value.fail(expected());
    }

    const json& _document;
    const std::string& _name;
    const Rule& _rule;
    std::string _path;
};

void checkVersion(const JsonValue& root)
{
    const JsonValue asset = root["asset"];
    for (const char* key : {"version", "minVersion"}) {
        if (!asset.has(key)) continue;
        const std::string version = asset[key].string();
        const bool readable = std::string(key) == "version" ? version.rfind("2.", 0) == 0 : version == "2.0";
        if (!readable) asset[key].fail("2.0");
    }
}

void checkExtensions(const JsonValue& root)
{
    if (!root.has("extensionsRequired")) return;
    const JsonValue required = root["extensionsRequired"];
    for (std::size_t i = 0; i < required.size(); ++i) {
        const std::string extension = required.element(i).string();
        const bool known =
            std::find(std::begin(knownExtensions), std::end(knownExtensions), extension) != std::end(knownExtensions);
        if (!known) required.element(i).fail("an extension that this reader knows");
    }
}

}  // namespace

void checkSchema(const json& document, const std::string& name)
{
    const JsonValue root(document, name, "");
    if (!document.is_object()) root.fail("an object");
    const auto check = [&](const Rule& rule, const std::string& path) { RuleCheck(document, name, rule, path).run(); };
    for (const Rule& rule : headerRules) check(rule, rule.path);
    checkVersion(root);
    checkExtensions(root);
    for (const Rule& rule : rules) check(rule, rule.path);
    for (const char* use : textureUses)
        for (const Rule& rule : textureRules) check(rule, std::string(use) + rule.path);
}

}  // namespace osgEnvLight::gltf

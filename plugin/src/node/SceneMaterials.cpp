// SPDX-License-Identifier: MIT
#include "node/SceneMaterials.h"

#include <osgEnvLight/Material>
#include "surface/MaterialMaps.h"
#include "surface/SurfaceState.h"

#include <osg/NodeVisitor>

#include <algorithm>
#include <set>
#include <stdexcept>

namespace osgEnvLight
{

namespace
{

using Value = JsonValue;

osg::Vec3f color(const Value& v)
{
    return osg::Vec3f(v.vector(0, 1, "three linear colour values in 0..1"));
}

// In place of a BRDF's name.
const char* const catcherName = "shadow-catcher";

// The BRDF of a material that has no more keys than those of its BRDF.
int readBrdf(const Value& v)
{
    struct Brdf {
        const char* name;
        Material::Brdf number;
        std::vector<std::string> keys;
    };
    static const Brdf all[] = {{"lambert", Material::LAMBERT, {"diffuse", "diffuseRoughness"}},
                               {"phong", Material::PHONG, {"diffuse", "specular", "exponent", "diffuseRoughness"}},
                               {"blinn-phong", Material::BLINN_PHONG, {"diffuse", "specular", "exponent", "diffuseRoughness"}},
                               {"cook-torrance",
                                Material::COOK_TORRANCE,
                                {"baseColor", "metalness", "roughness", "normals", "ior", "coat", "coatRoughness", "anisotropy",
                                 "anisotropyRotation", "eta", "kappa", "diffuseRoughness", "metalRoughMap"}},
                               {"strauss", Material::STRAUSS, {"baseColor", "metalness", "smoothness"}}};
    const std::string name = v.get().is_object() && v.has("brdf") ? v["brdf"].string() : std::string();
    if (name == catcherName) {
        v.object({"brdf"}, "a shadow catcher");
        return Material::LAMBERT;
    }
    const auto found = std::find_if(std::begin(all), std::end(all), [&](const Brdf& b) { return name == b.name; });
    if (found == std::end(all))
        v.fail(
            "an object whose brdf is \"lambert\", \"phong\", \"blinn-phong\", \"cook-torrance\", \"strauss\" or "
            "\"shadow-catcher\"");
    std::vector<std::string> keys = {"brdf", "emission", "light", "normalMap", "emissionMap", "topIsZero"};
    keys.insert(keys.end(), found->keys.begin(), found->keys.end());
    v.object(keys, "a material");
    return found->number;
}

Material::LightMode readLightMode(const Value& v)
{
    const std::pair<const char*, Material::LightMode> modes[] = {
        {"auto", Material::LIGHT_AUTO}, {"on", Material::LIGHT_ON}, {"off", Material::LIGHT_OFF}};
    const std::string text = v.get().is_string() ? v.string() : std::string();
    for (const auto& [name, mode] : modes)
        if (text == name) return mode;
    v.fail("\"auto\", \"on\" or \"off\"");
}

void readMapUnits(const Value& v, MaterialDescription& m)
{
    const std::pair<const char*, unsigned*> maps[] = {
        {"normalMap", &m.normalMap}, {"metalRoughMap", &m.metalRoughMap}, {"emissionMap", &m.emissionMap}};
    for (const auto& [key, unit] : maps) {
        if (!v.has(key)) continue;
        *unit = unsigned(v[key].number(1, SurfaceState::units - 1, "a texture unit in 1..8"));
        if (v[key].get() != *unit) v[key].fail("a texture unit in 1..8");
    }
    if (v.has("topIsZero")) m.topIsZero = v["topIsZero"].boolean();
}

// * stands for any text, or none.
bool matches(const std::string& pattern, const std::string& name)
{
    size_t p = 0, n = 0, star = std::string::npos, from = 0;
    while (n < name.size()) {
        if (p < pattern.size() && pattern[p] == '*') {
            star = p++;
            from = n;
        } else if (p < pattern.size() && pattern[p] == name[n]) {
            ++p;
            ++n;
        } else if (star != std::string::npos) {
            p = star + 1;
            n = ++from;
        } else {
            return false;
        }
    }
    return pattern.find_first_not_of('*', p) == std::string::npos;
}

size_t literals(const std::string& pattern)
{
    return pattern.size() - size_t(std::count(pattern.begin(), pattern.end(), '*'));
}

// Puts materials on the state sets whose osg::Material, or on the nodes whose own name, they are for.
class MaterialVisitor : public osg::NodeVisitor
{
  public:
    explicit MaterialVisitor(const std::vector<MaterialDescription>& materials)
        : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN), _materials(materials), _found(materials.size(), false)
    {
        setNodeMaskOverride(~0u);
    }

    void apply(osg::Node& node) override
    {
        const int own = node.getName().empty() ? -1 : find(node.getName());
        if (own >= 0) set(*node.getOrCreateStateSet(), size_t(own));
        if (osg::StateSet* s = node.getStateSet()) visit(*s);
        traverse(node);
    }

    // The first name that nothing bears, or "".
    std::string missing() const
    {
        for (size_t i = 0; i < _materials.size(); ++i)
            if (!_found[i]) return _materials[i].name;
        return std::string();
    }

    std::set<std::string> names;

  private:
    void visit(osg::StateSet& s)
    {
        const osg::StateAttribute* m = s.getAttribute(osg::StateAttribute::MATERIAL);
        if (!m || m->getName().empty()) return;
        names.insert(m->getName());
        const int i = find(m->getName());
        if (i >= 0) set(s, size_t(i));
    }

    // Of all that match the one with the most letters, so that names go before patterns; all of them count as found.
    int find(const std::string& name)
    {
        int best = -1;
        for (size_t i = 0; i < _materials.size(); ++i) {
            if (!matches(_materials[i].name, name)) continue;
            _found[i] = true;
            if (best < 0 || literals(_materials[i].name) > literals(_materials[size_t(best)].name)) best = int(i);
        }
        return best;
    }

    static void setMicrofacets(osg::StateSet& s, const MaterialDescription& m)
    {
        const auto normals = m.brdf == Material::BECKMANN ? Material::BECKMANN_NORMALS : Material::GGX_NORMALS;
        if (m.eta.x() > 0.0f) return Material::setConductor(s, m.eta, m.kappa, m.roughness, normals);
        Material::setCookTorrance(s, m.baseColor, m.metalness, m.roughness, normals);
    }

    void set(osg::StateSet& s, size_t i)
    {
        const MaterialDescription& m = _materials[i];
        if (m.brdf == Material::LAMBERT) Material::setLambert(s, m.diffuse);
        if (m.brdf == Material::PHONG) Material::setPhong(s, m.diffuse, m.specular, m.exponent);
        if (m.brdf == Material::BLINN_PHONG) Material::setBlinnPhong(s, m.diffuse, m.specular, m.exponent);
        if (m.brdf == Material::COOK_TORRANCE || m.brdf == Material::BECKMANN) setMicrofacets(s, m);
        if (m.brdf == Material::STRAUSS) Material::setStrauss(s, m.baseColor, m.smoothness, m.metalness);
        // What the model's own material had goes.
        if (m.shadowCatcher || s.getUniform(MaterialMaps::shadowCatcher)) Material::setShadowCatcher(s, m.shadowCatcher);
        if (m.diffuseRoughness > 0.0f || s.getUniform(MaterialMaps::diffuseRoughness))
            Material::setDiffuseRoughness(s, m.diffuseRoughness);
        if (m.ior != 1.5f || s.getUniform(MaterialMaps::dielectric)) Material::setDielectric(s, m.ior);
        if (m.coat > 0.0f || s.getUniform(MaterialMaps::coat)) Material::setCoat(s, m.coat, m.coatRoughness);
        if (m.anisotropy > 0.0f || s.getUniform(MaterialMaps::anisotropy))
            Material::setAnisotropy(s, m.anisotropy, m.anisotropyRotation);
        setMapUnits(s, m);
    }

    static void setMapUnits(osg::StateSet& s, const MaterialDescription& m)
    {
        if (m.emission) Material::setEmission(s, *m.emission);
        if (m.light) Material::setLight(s, *m.light);
        if (m.normalMap > 0) Material::setNormalMap(s, nullptr, 1.0f, m.topIsZero, 0, m.normalMap);
        if (m.metalRoughMap > 0) Material::setMetalRoughMap(s, nullptr, 0, m.metalRoughMap);
        if (m.emissionMap > 0) {
            if (!m.emission) Material::setEmission(s, osg::Vec3f(1, 1, 1));
            Material::setEmissionMap(s, nullptr, 0, m.emissionMap);
        }
    }

    const std::vector<MaterialDescription>& _materials;
    std::vector<bool> _found;
};

}  // namespace

MaterialDescription readMaterial(const Value& v, const std::string& name)
{
    MaterialDescription m;
    m.name = name;
    m.brdf = readBrdf(v);
    m.shadowCatcher = v["brdf"].string() == catcherName;
    if (v.has("normals")) {
        const std::string normals = v["normals"].string();
        if (normals != "ggx" && normals != "beckmann") v["normals"].fail("\"ggx\" or \"beckmann\"");
        if (normals == "beckmann") m.brdf = Material::BECKMANN;
    }
    if (v.has("diffuse")) m.diffuse = color(v["diffuse"]);
    if (v.has("specular")) m.specular = color(v["specular"]);
    if (v.has("baseColor")) m.baseColor = color(v["baseColor"]);
    if (v.has("emission")) m.emission = osg::Vec3f(v["emission"].vector(0, 1e12, "three linear colour values in 0..1e12"));
    if (v.has("light")) m.light = readLightMode(v["light"]);
    const auto read = [&v](const char* key, float& number, double low, double high, const char* expected) {
        if (v.has(key)) number = float(v[key].number(low, high, expected));
    };
    const auto readShare = [&](const char* key, float& number) { read(key, number, 0, 1, "a number in 0..1"); };
    read("exponent", m.exponent, 0, 1e6, "an exponent in 0..1000000");
    read("ior", m.ior, 1, 4, "an index of refraction in 1..4");
    read("anisotropyRotation", m.anisotropyRotation, -1e6, 1e6, "an angle in degrees");
    readShare("metalness", m.metalness);
    readShare("roughness", m.roughness);
    readShare("smoothness", m.smoothness);
    readShare("diffuseRoughness", m.diffuseRoughness);
    readShare("coat", m.coat);
    readShare("coatRoughness", m.coatRoughness);
    readShare("anisotropy", m.anisotropy);
    if (m.anisotropy > 0.0f && (m.brdf != Material::COOK_TORRANCE || m.coat > 0.0f))
        v["anisotropy"].fail("anisotropy only on a surface without a coat whose normals are \"ggx\"");
    if (v.has("eta") != v.has("kappa")) v.fail("eta with kappa: the index of refraction of a metal");
    if (v.has("eta")) {
        if (v.has("baseColor") || v.has("metalness")) v["eta"].fail("eta and kappa, or baseColor and metalness");
        if (m.coat > 0.0f || m.anisotropy > 0.0f) v["eta"].fail("eta and kappa only on a surface without a coat and anisotropy");
        m.eta = osg::Vec3f(v["eta"].vector(0.01, 100, "three numbers in 0.01..100"));
        m.kappa = osg::Vec3f(v["kappa"].vector(0, 100, "three numbers in 0..100"));
    }
    readMapUnits(v, m);
    if (m.coat > 0.0f && m.brdf != Material::COOK_TORRANCE) v["coat"].fail("a coat only on a surface whose normals are \"ggx\"");
    if (m.diffuseRoughness > 0.0f && (m.coat > 0.0f || m.anisotropy > 0.0f || v.has("eta")))
        v["diffuseRoughness"].fail("diffuseRoughness only on a surface without a coat, anisotropy and eta");
    for (int i = 0; i < 3; ++i)
        if ((m.brdf == Material::PHONG || m.brdf == Material::BLINN_PHONG) && m.diffuse[i] + m.specular[i] > 1.0f + 1e-6f)
            v.fail("diffuse + specular <= 1");
    return m;
}

void setMaterials(osg::Node& node, const std::vector<MaterialDescription>& materials, const std::string& file)
{
    MaterialVisitor visitor(materials);
    node.accept(visitor);
    const std::string missing = visitor.missing();
    if (missing.empty()) return;
    std::string list;
    for (const std::string& n : visitor.names) list += " '" + n + "'";
    throw std::runtime_error(file + ": key 'materials." + missing +
                             "': no material or node of the models has that name; materials are" +
                             (list.empty() ? std::string(" none") : list));
}

}  // namespace osgEnvLight

// SPDX-License-Identifier: MIT
// Materials of scene descriptions on the models they name.
#include <Pictures.h>
#include <SceneRenderer.h>

#include <osgEnvLight/Material>
#include <osgEnvLight/SceneDescription>

#include <osg/Material>
#include <osgDB/WriteFile>

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <functional>

#include "Blended.h"
#include "glsl.h"

namespace Materials_test
{

using osgEnvLight::LitScene;
using osgEnvLight::Material;

namespace
{

// A model of geodes with an osg::Material of each name, and the scene that gives them others.
class Materials : public testing::Test
{
  protected:
    void SetUp() override { std::filesystem::create_directories(_folder); }
    void TearDown() override { std::filesystem::remove_all(_folder); }

    osg::ref_ptr<LitScene> build(const std::vector<std::string>& names, const std::string& materials)
    {
        osg::ref_ptr<osg::Group> model = new osg::Group;
        for (const std::string& name : names) {
            const osg::ref_ptr<osg::Geode> geode = makeSphere(osg::Vec3d(), 1.0);
            osg::ref_ptr<osg::Material> material = new osg::Material;
            material->setName(name);
            geode->getOrCreateStateSet()->setAttribute(material);
            model->addChild(geode);
        }
        EXPECT_TRUE(osgDB::writeNodeFile(*model, (_folder / "model.osgb").string()));
        const std::string file = (_folder / "scene.envlight").string();
        std::ofstream(file) << "{\"model\": \"model.osgb\", \"environment\": {\"map\": \"studio\"}, \"materials\": " << materials
                            << "}";
        osgEnvLight::SceneDescription description;
        error.clear();
        if (!description.readFile(file, nullptr, error)) return nullptr;
        return description.build(nullptr, error);
    }

    // Of the geode of that number.
    static const osg::StateSet& stateSet(const LitScene& lit, unsigned i)
    {
        return *lit.getChild(0)->asGroup()->getChild(i)->getStateSet();
    }

    static float number(const osg::StateSet& s, const char* name)
    {
        float value = -1.0f;
        if (const osg::Uniform* u = s.getUniform(name)) u->get(value);
        return value;
    }

    std::string error;

  private:
    const std::filesystem::path _folder =
        std::filesystem::temp_directory_path() / ("envlight_materials_" + std::to_string(getpid()));
};

}  // namespace

TEST_F(Materials, EveryBrdfByItsName)
{
    const osg::ref_ptr<LitScene> lit =
        build({"a", "b", "c", "d", "e", "f"}, R"({"a": {"brdf": "lambert"}, "b": {"brdf": "phong", "exponent": 20},
            "c": {"brdf": "blinn-phong", "exponent": 30}, "d": {"brdf": "cook-torrance", "roughness": 0.25},
            "e": {"brdf": "cook-torrance", "normals": "beckmann", "roughness": 0.75}, "f": {"brdf": "strauss", "smoothness": 0.125}})");
    ASSERT_TRUE(lit) << error;
    const int expected[] = {Material::LAMBERT,       Material::PHONG,    Material::BLINN_PHONG,
                            Material::COOK_TORRANCE, Material::BECKMANN, Material::STRAUSS};
    for (unsigned i = 0; i < 6; ++i) EXPECT_EQ(expected[i], Material::brdfOf(stateSet(*lit, i), -1)) << i;
    EXPECT_EQ(20.0f, number(stateSet(*lit, 1), "envlightExponent"));
    EXPECT_EQ(30.0f, number(stateSet(*lit, 2), "envlightExponent"));
    EXPECT_EQ(0.25f, number(stateSet(*lit, 3), "envlightRoughness"));
    EXPECT_EQ(0.75f, number(stateSet(*lit, 4), "envlightRoughness"));
    EXPECT_EQ(0.125f, number(stateSet(*lit, 5), "envlightSmoothness"));
}

// A metal is coloured by its vertices as by the same base colour.
TEST_F(Materials, VertexColorsTakeTheBaseColorsPlace)
{
    SceneRenderer renderer(64, 64);
    const auto picture = [&](bool byVertices, bool taken) {
        const osg::ref_ptr<osg::Geode> ball = makeSphere(osg::Vec3d(), 1.0);
        Material::setCookTorrance(*ball->getOrCreateStateSet(),
                                  byVertices ? osg::Vec3f(1, 1, 1) : osg::Vec3f(0.6038f, 0.2140f, 0.0331f), 1.0f, 0.3f);
        osg::ref_ptr<osg::Vec4Array> colors = new osg::Vec4Array(osg::Array::BIND_OVERALL, 1);
        (*colors)[0] = osg::Vec4(0.8f, 0.5f, 0.2f, 1.0f);  // the base colour, encoded
        ball->getDrawable(0)->asGeometry()->setColorArray(colors);
        if (byVertices) Material::setVertexColors(*ball->getOrCreateStateSet(), taken);
        const osg::ref_ptr<LitScene> lit = makeLit(constantMap(1.0).get());
        lit->addChild(ball);
        return renderer.render(lit);
    };
    const Picture expected = picture(false, false);
    EXPECT_GT(expected.color(32, 32)[0], 0.5);
    // The base colour has four digits.
    EXPECT_LT(largestDifference(expected, picture(true, true)), 5e-4);
    EXPECT_GT(largestDifference(expected, picture(true, false)), 0.3);
}

TEST_F(Materials, PatternsGiveWayToLongerNames)
{
    const osg::ref_ptr<LitScene> lit = build({"wheel_front", "wheel_back", "wheel", "body", "w[1]*"}, R"({
        "*": {"brdf": "lambert"}, "wheel*": {"brdf": "phong"}, "*_back": {"brdf": "strauss"}, "wheel_b*k": {"brdf": "blinn-phong"},
        "w[1]*": {"brdf": "cook-torrance"}})");
    ASSERT_TRUE(lit) << error;
    EXPECT_EQ(Material::PHONG, Material::brdfOf(stateSet(*lit, 0), -1));
    EXPECT_EQ(Material::BLINN_PHONG, Material::brdfOf(stateSet(*lit, 1), -1));
    EXPECT_EQ(Material::PHONG, Material::brdfOf(stateSet(*lit, 2), -1));
    EXPECT_EQ(Material::LAMBERT, Material::brdfOf(stateSet(*lit, 3), -1));
    EXPECT_EQ(Material::COOK_TORRANCE, Material::brdfOf(stateSet(*lit, 4), -1));
}

TEST_F(Materials, APatternThatNothingMatchesIsAnError)
{
    EXPECT_FALSE(build({"wheel", "body"}, R"({"wheel*x": {"brdf": "lambert"}})"));
    EXPECT_NE(std::string::npos, error.find("'materials.wheel*x'")) << error;
    EXPECT_NE(std::string::npos, error.find("'body' 'wheel'")) << error;
}

TEST_F(Materials, CoatsAndIndicesOfRefraction)
{
    const osg::ref_ptr<LitScene> lit = build({"a", "b"}, R"({"a": {"brdf": "cook-torrance", "coat": 0.5, "coatRoughness": 0.25},
        "b": {"brdf": "cook-torrance", "ior": 2}})");
    ASSERT_TRUE(lit) << error;
    EXPECT_EQ(0.5f, number(stateSet(*lit, 0), "envlightCoat"));
    EXPECT_EQ(0.25f, number(stateSet(*lit, 0), "envlightCoatRoughness"));
    EXPECT_EQ(-1.0f, number(stateSet(*lit, 1), "envlightCoat"));
    osg::Vec3f f0;
    ASSERT_TRUE(stateSet(*lit, 1).getUniform("envlightDielectric"));
    stateSet(*lit, 1).getUniform("envlightDielectric")->get(f0);
    EXPECT_NEAR(1.0 / 9.0, f0[0], 1e-7);  // ((2 - 1) / (2 + 1))^2
    EXPECT_FALSE(build({"a"}, R"({"a": {"brdf": "cook-torrance", "normals": "beckmann", "coat": 1}})"));
    EXPECT_NE(std::string::npos, error.find("'materials.a.coat'")) << error;
    EXPECT_FALSE(build({"a"}, R"({"a": {"brdf": "cook-torrance", "ior": 0.9}})"));
    EXPECT_NE(std::string::npos, error.find("1..4")) << error;
    EXPECT_FALSE(build({"a"}, R"({"a": {"brdf": "strauss", "coat": 1}})"));
}

TEST_F(Materials, Anisotropy)
{
    const osg::ref_ptr<LitScene> lit = build(
        {"a", "b"}, R"({"a": {"brdf": "cook-torrance", "anisotropy": 0.5, "anisotropyRotation": 60}, "b": {"brdf": "phong"}})");
    ASSERT_TRUE(lit) << error;
    EXPECT_EQ(0.5f, number(stateSet(*lit, 0), "envlightAnisotropy"));
    osg::Vec2f direction;
    ASSERT_TRUE(stateSet(*lit, 0).getUniform("envlightAnisotropyDirection"));
    stateSet(*lit, 0).getUniform("envlightAnisotropyDirection")->get(direction);
    EXPECT_NEAR(0.5, direction.x(), 1e-6);
    EXPECT_NEAR(std::sqrt(0.75), direction.y(), 1e-6);
    EXPECT_EQ(-1.0f, number(stateSet(*lit, 1), "envlightAnisotropy"));
    EXPECT_FALSE(build({"a"}, R"({"a": {"brdf": "cook-torrance", "normals": "beckmann", "anisotropy": 1}})"));
    EXPECT_NE(std::string::npos, error.find("'materials.a.anisotropy'")) << error;
    EXPECT_FALSE(build({"a"}, R"({"a": {"brdf": "cook-torrance", "coat": 1, "anisotropy": 1}})"));
    EXPECT_FALSE(build({"a"}, R"({"a": {"brdf": "cook-torrance", "anisotropy": 1.5}})"));
    EXPECT_NE(std::string::npos, error.find("0..1")) << error;
}

namespace
{

// The middle of a black ball under light from everywhere: what it reflects of that.
double reflectedBy(const std::function<void(osg::StateSet&)>& set, bool forward = false)
{
    SceneRenderer renderer(32, 32);
    const osg::ref_ptr<osg::Geode> ball = makeSphere(osg::Vec3d(), 1.0, 96);
    osg::StateSet& s = *ball->getOrCreateStateSet();
    Material::setCookTorrance(s, osg::Vec3f(), 0.0f, 0.3f);
    set(s);
    if (forward) blend(s);
    const osg::ref_ptr<LitScene> lit = makeLit(constantMap(1.0).get());
    lit->getSettings()->background = osgEnvLight::Settings::BACKGROUND_OFF;
    lit->addChild(ball);
    const double middle = renderer.render(lit).color(16, 16)[1];
    EXPECT_EQ(forward ? 1u : 0u, lit->plan().surfaces.litForward);
    return middle;
}

}  // namespace

TEST_F(Materials, ADielectricReflectsByItsIndexOfRefraction)
{
    const auto of = [](float ior, float strength = 1.0f) {
        return reflectedBy([&](osg::StateSet& s) { Material::setDielectric(s, ior, strength); });
    };
    const double glass = reflectedBy([](osg::StateSet&) {});
    EXPECT_NEAR(0.04, glass, 0.001);
    EXPECT_NEAR(glass, of(1.5f), 1e-5);
    EXPECT_NEAR(1.0 / 9.0, of(2.0f), 0.002);
    EXPECT_NEAR(0.5 * glass, of(1.5f, 0.5f), 2e-4);
    EXPECT_EQ(0.0, of(1.0f));
}

namespace
{

// The middle of a plate under light from everywhere, seen that many degrees from its normal.
double reflectedAslant(const std::function<void(osg::StateSet&)>& set, double degrees, bool forward)
{
    const osg::ref_ptr<osg::Geode> plate = makeQuad(osg::Vec3d(-50, -50, 0), osg::Vec3d(100, 0, 0), osg::Vec3d(0, 100, 0));
    set(*plate->getOrCreateStateSet());
    if (forward) blend(*plate->getOrCreateStateSet());
    const osg::ref_ptr<LitScene> lit = makeLit(constantMap(1.0).get());
    lit->getSettings()->background = osgEnvLight::Settings::BACKGROUND_OFF;
    lit->addChild(plate);
    SceneRenderer renderer(32, 32);
    const double t = osg::DegreesToRadians(degrees);
    renderer.lookAt(osg::Vec3d(0, -std::sin(t), std::cos(t)) * 10.0, osg::Vec3d(), osg::Vec3d(0, 0, 1), 2.0);
    return renderer.render(lit).color(16, 16)[1];
}

}  // namespace

// A smooth metal reflects what Fresnel's equations say: within .035 for what 4 bits leave of them (fresnel_test), where Schlick's
// form is .17 off at 80 degrees. No material below inherits the metal's edges.
TEST_F(Materials, AConductorReflectsByItsIndexOfRefraction)
{
    const auto chromium = [](osg::StateSet& s) {
        Material::setConductor(s, osg::Vec3f(3.1f, 3.1f, 3.1f), osg::Vec3f(3.3f, 3.3f, 3.3f), 0.0f);
    };
    const double facing = glsl::fresnelExact(1.0, 3.1, 3.3);
    for (const bool forward : {false, true})
        for (const double degrees : {20.0, 60.0, 80.0})
            EXPECT_NEAR(glsl::fresnelExact(std::cos(osg::DegreesToRadians(degrees)), 3.1, 3.3),
                        reflectedAslant(chromium, degrees, forward), 0.04)
                << degrees << " " << forward;
    const auto replaced = [&](osg::StateSet& s) {
        chromium(s);
        Material::setCookTorrance(s, osg::Vec3f(1, 1, 1) * float(facing), 1.0f, 0.0f);
    };
    EXPECT_NEAR(glsl::fresnelSchlick(glsl::vec3(facing), std::cos(osg::DegreesToRadians(80.0))).x,
                reflectedAslant(replaced, 80.0, false), 0.005);
}

// Under an even sky white sends all on, whatever its roughness and wherever it is drawn; grey less than Lambert's, as further
// bounces between facets meet it again.
TEST_F(Materials, ARoughDiffuseLayerKeepsWhatItGets)
{
    const auto of = [](float albedo, float roughness, double degrees, bool forward) {
        return reflectedAslant(
            [&](osg::StateSet& s) {
                Material::setLambert(s, osg::Vec3f(albedo, albedo, albedo));
                Material::setDiffuseRoughness(s, roughness);
            },
            degrees, forward);
    };
    for (const bool forward : {false, true})
        for (const double degrees : {20.0, 60.0, 85.0}) {
            EXPECT_NEAR(1.0, of(1.0f, 1.0f, degrees, forward), 0.003) << degrees << " " << forward;
            const glsl::RoughDiffuse grey = glsl::roughDiffuse(glsl::vec3(0.4), 0.5);
            EXPECT_NEAR(glsl::roughDiffuseAlbedo(grey, std::cos(osg::DegreesToRadians(degrees))).x,
                        of(0.4f, 0.5f, degrees, forward), 0.002)
                << degrees << " " << forward;
        }
    EXPECT_NEAR(0.4, of(0.4f, 0.0f, 60.0, false), 0.001);
}

TEST_F(Materials, RoughDiffuseLayersOfASceneDescription)
{
    const osg::ref_ptr<LitScene> lit = build({"a"}, R"({"a": {"brdf": "lambert", "diffuseRoughness": 0.7}})");
    ASSERT_TRUE(lit) << error;
    float roughness = 0.0f;
    stateSet(*lit, 0).getUniform("envlightDiffuseRoughness")->get(roughness);
    EXPECT_FLOAT_EQ(0.7f, roughness);
    EXPECT_FALSE(build({"a"}, R"({"a": {"brdf": "lambert", "diffuseRoughness": 2}})"));
    EXPECT_NE(std::string::npos, error.find("0..1")) << error;
    EXPECT_FALSE(build({"a"}, R"({"a": {"brdf": "cook-torrance", "diffuseRoughness": 0.5, "coat": 1}})"));
    EXPECT_NE(std::string::npos, error.find("without a coat")) << error;
}

TEST_F(Materials, EmissionInASceneDescription)
{
    const osg::ref_ptr<LitScene> lit =
        build({"a"}, R"({"a": {"brdf": "lambert", "diffuse": [0, 0, 0], "emission": [1, 20, 0.5], "light": "off"}})");
    ASSERT_TRUE(lit) << error;
    osg::Vec3f emission;
    int mode = -1;
    stateSet(*lit, 0).getUniform("envlightEmission")->get(emission);
    stateSet(*lit, 0).getUniform("envlightLightMode")->get(mode);
    EXPECT_EQ(osg::Vec3f(1, 20, 0.5f), emission);
    EXPECT_EQ(int(Material::LIGHT_OFF), mode);
    EXPECT_FALSE(build({"a"}, R"({"a": {"brdf": "lambert", "emission": [1, -1, 1]}})"));
    EXPECT_NE(std::string::npos, error.find("0..1e12")) << error;
    EXPECT_FALSE(build({"a"}, R"({"a": {"brdf": "lambert", "light": "yes"}})"));
    EXPECT_NE(std::string::npos, error.find("\"auto\", \"on\" or \"off\"")) << error;
}

TEST_F(Materials, UnitsOfMapsInASceneDescription)
{
    const osg::ref_ptr<LitScene> lit = build(
        {"a"}, R"({"a": {"brdf": "cook-torrance", "normalMap": 1, "metalRoughMap": 3, "emissionMap": 5, "topIsZero": true}})");
    ASSERT_TRUE(lit) << error;
    const std::pair<const char*, int> units[] = {
        {"envlightNormalMap", 1}, {"envlightMetalRoughMap", 3}, {"envlightEmissionMap", 5}};
    for (const auto& [name, expected] : units) {
        int unit = 0;
        ASSERT_TRUE(stateSet(*lit, 0).getUniform(name)) << name;
        stateSet(*lit, 0).getUniform(name)->get(unit);
        EXPECT_EQ(expected, unit) << name;
    }
    EXPECT_EQ(-1.0f, number(stateSet(*lit, 0), "envlightNormalUp"));
    EXPECT_TRUE(stateSet(*lit, 0).getTextureAttributeList().empty()) << "the textures are the model's";
    for (const char* wrong : {"0", "9", "1.5", "true"}) {
        EXPECT_FALSE(build({"a"}, std::string(R"({"a": {"brdf": "lambert", "normalMap": )") + wrong + "}}"));
        EXPECT_NE(std::string::npos, error.find("a texture unit in 1..8")) << error;
    }
    EXPECT_FALSE(build({"a"}, R"({"a": {"brdf": "lambert", "metalRoughMap": 3}})"));
    EXPECT_NE(std::string::npos, error.find("unknown key")) << error;
}

TEST_F(Materials, ConductorsOfASceneDescription)
{
    const osg::ref_ptr<LitScene> lit = build(
        {"a"}, R"({"a": {"brdf": "cook-torrance", "eta": [0.27, 0.68, 1.32], "kappa": [3.61, 2.63, 2.29], "roughness": 0.2}})");
    ASSERT_TRUE(lit) << error;
    osg::Vec3f color;
    stateSet(*lit, 0).getUniform("envlightBaseColor")->get(color);
    EXPECT_NEAR(glsl::fresnelExact(1.0, 0.27, 3.61), color[0], 1e-6);
    EXPECT_TRUE(stateSet(*lit, 0).getUniform("envlightEdge"));
    EXPECT_FALSE(build({"a"}, R"({"a": {"brdf": "cook-torrance", "eta": [1, 1, 1]}})"));
    EXPECT_NE(std::string::npos, error.find("kappa")) << error;
    EXPECT_FALSE(build({"a"}, R"({"a": {"brdf": "cook-torrance", "eta": [1, 1, 1], "kappa": [1, 1, -1]}})"));
    EXPECT_NE(std::string::npos, error.find("0..100")) << error;
    EXPECT_FALSE(build({"a"}, R"({"a": {"brdf": "cook-torrance", "eta": [1, 1, 1], "kappa": [1, 1, 1], "metalness": 1}})"));
    EXPECT_FALSE(build({"a"}, R"({"a": {"brdf": "cook-torrance", "eta": [1, 1, 1], "kappa": [1, 1, 1], "coat": 1}})"));
}

// Over black that reflects nothing a coat is glass; where it is drawn does not matter.
TEST_F(Materials, ACoatReflectsAsGlass)
{
    const auto of = [](float strength, bool forward) {
        return reflectedBy(
            [&](osg::StateSet& s) {
                Material::setCoat(s, strength, 0.2f);
                Material::setCookTorrance(s, osg::Vec3f(), 1.0f, 0.3f);
            },
            forward);
    };
    EXPECT_EQ(0.0, of(0.0f, false));
    EXPECT_NEAR(0.04, of(1.0f, false), 0.001);
    EXPECT_NEAR(of(1.0f, false), of(1.0f, true), 0.001);
    EXPECT_NEAR(16.0 / 31.0 * of(1.0f, false), of(0.5f, false), 1e-4);  // kept to 1/31
}

// White metal gives back all that it gets, brushed or not, wherever it is drawn: within the 1 % by which the table is fitted.
TEST_F(Materials, BrushedMetalGivesBackAllThatItGets)
{
    for (const bool forward : {false, true})
        for (const float roughness : {0.0f, 0.3f, 0.8f})
            for (const float strength : {0.0f, 0.5f, 1.0f})
                EXPECT_NEAR(1.0,
                            reflectedBy(
                                [&](osg::StateSet& s) {
                                    Material::setCookTorrance(s, osg::Vec3f(1, 1, 1), 1.0f, roughness);
                                    Material::setAnisotropy(s, strength);
                                },
                                forward),
                            0.01)
                    << forward << " " << roughness << " " << strength;
}

// The pass of coats runs for coats alone.
TEST_F(Materials, WithoutACoatItsPassDoesNotRun)
{
    SceneRenderer renderer(32, 32);
    for (const float strength : {0.0f, 1.0f}) {
        const osg::ref_ptr<osg::Geode> ball = makeSphere(osg::Vec3d(), 1.0);
        Material::setCookTorrance(*ball->getOrCreateStateSet(), osg::Vec3f(1, 1, 1), 0.0f, 0.3f);
        Material::setCoat(*ball->getOrCreateStateSet(), strength);
        const osg::ref_ptr<LitScene> lit = makeLit(constantMap(1.0).get());
        lit->addChild(ball);
        renderer.render(lit);
        EXPECT_EQ(strength > 0.0f, lit->plan().surfaces.hasCoats());
        for (const auto& pass : lit->plan().passes) {
            if (pass.pass == "coat") {
                EXPECT_EQ(strength > 0.0f, pass.runs) << pass.reason;
            }
        }
    }
}

}  // namespace Materials_test

// SPDX-License-Identifier: MIT
// Every class comes back from .osgt, .osgb and .osgx as it was written, and shows the same picture.
#include <Process.h>
#include <SceneRenderer.h>

#include <osgEnvLight/Material>

#include <osgDB/ClassInterface>
#include <osgDB/ReadFile>
#include <osgDB/WriteFile>

#include <gtest/gtest.h>

#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <map>

namespace Serializers_test
{

using osgEnvLight::LitScene;
using osgEnvLight::Settings;

namespace
{

std::string temporary(const std::string& extension)
{
    return testing::TempDir() + "envlight_" + std::to_string(getpid()) + extension;
}

osg::ref_ptr<LitScene> reread(LitScene& lit, const std::string& extension)
{
    const std::string name = temporary(extension);
    EXPECT_TRUE(osgDB::writeNodeFile(lit, name));
    osg::ref_ptr<LitScene> copy = dynamic_cast<LitScene*>(osgDB::readRefNodeFile(name).get());
    unlink(name.c_str());
    return copy;
}

osg::ref_ptr<LitScene> makeScene()
{
    osg::ref_ptr<LitScene> lit = new LitScene(makeMap(64, 32, sixDirectionColor));
    lit->getEnvironmentMap()->setRotation(33.5);
    lit->getEnvironmentMap()->setIntensity(1.75);
    osg::ref_ptr<osg::Geode> a = makeSphere(osg::Vec3d(-1, 0, 0), 0.9, 64);
    osg::ref_ptr<osg::Geode> b = makeSphere(osg::Vec3d(1, 0, 0), 0.9, 64);
    osgEnvLight::Material::setCookTorrance(*a->getOrCreateStateSet(), osg::Vec3f(1, 0.8f, 0.3f), 1.0f, 0.25f);
    osgEnvLight::Material::setPhong(*b->getOrCreateStateSet(), osg::Vec3f(0.5f, 0.2f, 0.2f), osg::Vec3f(0.3f, 0.3f, 0.3f), 50.0f);
    lit->addChild(a);
    lit->addChild(b);
    return lit;
}

}  // namespace

// The files of version 0 in tests/data were written before files had a version. They read for ever.
class Version0 : public testing::TestWithParam<const char*>
{
  protected:
    static osg::ref_ptr<LitScene> read(const std::string& name)
    {
        const std::string file = std::string(ENVLIGHT_SOURCE_DIR) + "/tests/data/version0_" + name + GetParam();
        return dynamic_cast<LitScene*>(osgDB::readRefNodeFile(file).get());
    }

    // All others have the defaults that they had then.
    static void expectSettings(const LitScene& lit, std::map<std::string, std::string> values)
    {
        values.emplace("background", "on");
        values.emplace("exposureBase", "map");
        const osg::ref_ptr<const Settings> defaults = new Settings;
        for (const Settings::Property& p : Settings::table()) {
            const auto given = values.find(p.name);
            EXPECT_EQ(given == values.end() ? p.getString(*defaults) : given->second, p.getString(*lit.getSettings())) << p.name;
        }
    }
};

TEST_P(Version0, DefaultSettingsUnderTheStudio)
{
    const NotifyCatcher notify;
    const osg::ref_ptr<LitScene> lit = read("studio");
    ASSERT_TRUE(lit);
    EXPECT_EQ("", notify.text());
    EXPECT_EQ("studio", lit->getEnvironmentMap()->getMap());
    EXPECT_EQ(osgEnvLight::MapLayout::AUTO, lit->getEnvironmentMap()->getLayout());
    EXPECT_DOUBLE_EQ(112.5, lit->getEnvironmentMap()->getRotation());
    EXPECT_DOUBLE_EQ(1.75, lit->getEnvironmentMap()->getIntensity());
    EXPECT_FALSE(lit->getEnvironmentMap()->getStrict());
    expectSettings(*lit, {});
    ASSERT_EQ(1u, lit->getNumChildren());
    EXPECT_EQ("quad", lit->getChild(0)->getName());
}

TEST_P(Version0, ManySettingsUnderAMapInTheFile)
{
    const NotifyCatcher notify;
    const osg::ref_ptr<LitScene> lit = read("settings");
    ASSERT_TRUE(lit);
    EXPECT_EQ("", notify.text());
    const osgEnvLight::EnvironmentMap& map = *lit->getEnvironmentMap();
    EXPECT_EQ("", map.getMap());
    EXPECT_EQ(osgEnvLight::MapLayout::LATLONG, map.getLayout());
    EXPECT_DOUBLE_EQ(-45.0, map.getRotation());
    EXPECT_DOUBLE_EQ(0.5, map.getIntensity());
    EXPECT_TRUE(map.getStrict());
    ASSERT_TRUE(map.getImage());
    ASSERT_EQ(4, map.getImage()->s());
    ASSERT_EQ(2, map.getImage()->t());
    ASSERT_EQ(GLenum(GL_FLOAT), map.getImage()->getDataType());
    for (unsigned i = 0; i < 24; ++i) EXPECT_EQ(0.25f * float(i), reinterpret_cast<const float*>(map.getImage()->data())[i]);
    expectSettings(*lit, {{"atlasLights", "512"},         {"atlasSize", "256"},         {"specular", "off"},
                          {"lightSampler", "median-cut"}, {"lightFloor", "0.25"},       {"suns", "glossy"},
                          {"regeneration", "immediate"},  {"diffuseLights", "64"},      {"visibility", "both"},
                          {"occlusionMethod", "gtao"},    {"occlusionRadius", "0.375"}, {"filterCells", "3"},
                          {"combine", "subtract"},        {"accumulate", "on"},         {"background", "blur"},
                          {"backgroundBlur", "22.5"},     {"view", "normal"},           {"output", "linear"},
                          {"exposure", "-1.5"},           {"toneCurve", "reinhard"},    {"dither", "off"}});
    ASSERT_EQ(1u, lit->getNumChildren());
    EXPECT_EQ("quad", lit->getChild(0)->getName());
}

INSTANTIATE_TEST_SUITE_P(Serializers, Version0, testing::Values(".osgt", ".osgb"),
                         [](const auto& format) { return std::string(format.param + 1); });

class Serializers : public testing::TestWithParam<const char*>
{
};

TEST_P(Serializers, EveryPropertyComesBack)
{
    osg::ref_ptr<LitScene> lit = makeScene();
    lit->getEnvironmentMap()->setLayout(osgEnvLight::MapLayout::LATLONG);
    lit->getEnvironmentMap()->setStrict(true);
    for (const Settings::Property& p : Settings::table()) {
        // Another value than the default: the far end of the range, or the next choice.
        std::string error;
        const double value = p.get(*lit->getSettings()) == p.maximum ? p.minimum : p.maximum;
        ASSERT_TRUE(lit->getSettings()->set(p.name, value, error)) << error;
    }
    osg::ref_ptr<LitScene> copy = reread(*lit, GetParam());
    ASSERT_TRUE(copy);
    // OSG reads decimal text digit by digit: to 4 ulps
    EXPECT_DOUBLE_EQ(33.5, copy->getEnvironmentMap()->getRotation());
    EXPECT_DOUBLE_EQ(1.75, copy->getEnvironmentMap()->getIntensity());
    EXPECT_EQ(osgEnvLight::MapLayout::LATLONG, copy->getEnvironmentMap()->getLayout());
    EXPECT_TRUE(copy->getEnvironmentMap()->getStrict());
    for (const Settings::Property& p : Settings::table())
        EXPECT_EQ(p.getString(*lit->getSettings()), p.getString(*copy->getSettings())) << p.name;
}

TEST_P(Serializers, TheHomeViewComesBack)
{
    osg::ref_ptr<LitScene> lit = new LitScene;
    ASSERT_TRUE(reread(*lit, GetParam()));
    EXPECT_FALSE(reread(*lit, GetParam())->getHomeView());
    lit->setHomeView({osg::Vec3d(1.0 / 3.0, -4e-7, 1e6), osg::Vec3d(0.1, 0.2, 0.3), osg::Vec3d(0, 1, 0), 47.25});
    const NotifyCatcher notify;
    osg::ref_ptr<LitScene> copy = reread(*lit, GetParam());
    ASSERT_TRUE(copy && copy->getHomeView());
    EXPECT_EQ(lit->getHomeView()->eye, copy->getHomeView()->eye);
    EXPECT_EQ(lit->getHomeView()->target, copy->getHomeView()->target);
    EXPECT_EQ(lit->getHomeView()->up, copy->getHomeView()->up);
    EXPECT_EQ(lit->getHomeView()->fovy, copy->getHomeView()->fovy);
    EXPECT_EQ("", notify.text());
}

// What a later version adds is skipped, with all else read: in these files a name of ours is replaced by one nobody knows.
TEST_P(Serializers, AnUnknownPropertyIsOneWarning)
{
    osg::ref_ptr<LitScene> lit = makeScene();
    lit->setHomeView({osg::Vec3d(0, -4, 0), osg::Vec3d(), osg::Vec3d(0, 0, 1), 40.0});
    lit->getSettings()->atlasSize = 64;
    lit->getSettings()->exposure = 2.0f;
    lit->getSettings()->dither = false;
    for (const auto& [known, unknown] : {std::pair<std::string, std::string>{"exposure", "expozure"}, {"homeView", "homeWiev"}}) {
        const std::string name = temporary(GetParam());
        ASSERT_TRUE(osgDB::writeNodeFile(*lit, name));
        std::ifstream in(name, std::ios::binary);
        std::string bytes{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
        const size_t at = bytes.find(known);
        ASSERT_NE(std::string::npos, at);
        bytes.replace(at, known.size(), unknown);
        std::ofstream(name, std::ios::binary) << bytes;
        const NotifyCatcher notify;
        const osg::ref_ptr<LitScene> copy = dynamic_cast<LitScene*>(osgDB::readRefNodeFile(name).get());
        unlink(name.c_str());
        ASSERT_TRUE(copy);
        EXPECT_NE(std::string::npos, notify.text().find("'" + unknown + "'")) << notify.text();
        EXPECT_EQ(1, std::count(notify.text().begin(), notify.text().end(), '\n')) << notify.text();
        EXPECT_EQ(2u, copy->getNumChildren());
        EXPECT_DOUBLE_EQ(33.5, copy->getEnvironmentMap()->getRotation());
        EXPECT_EQ(64, copy->getSettings()->atlasSize);
        EXPECT_EQ(known == "exposure" ? 0.0f : 2.0f, copy->getSettings()->exposure);
        EXPECT_EQ(known != "homeView", copy->getHomeView().has_value());
        EXPECT_FALSE(copy->getSettings()->dither);
    }
}

template <class T>
void expectAccess(Settings& settings, const Settings::Property& p, T value)
{
    osgDB::ClassInterface interface;
    T read{};
    EXPECT_TRUE(interface.setProperty(&settings, p.name, value)) << p.name;
    EXPECT_EQ(double(value), p.get(settings)) << p.name;
    EXPECT_TRUE(interface.getProperty(&settings, p.name, read)) << p.name;
    EXPECT_EQ(value, read) << p.name;
}

TEST(SettingsProperties, AreAccessibleByName)
{
    osg::ref_ptr<Settings> settings = new Settings;
    for (const Settings::Property& p : Settings::table()) {
        if (std::holds_alternative<bool Settings::*>(p.member))
            expectAccess(*settings, p, p.get(*settings) == 0.0);
        else if (std::holds_alternative<int Settings::*>(p.member))
            expectAccess(*settings, p, int(p.maximum));
        else
            expectAccess(*settings, p, float(p.maximum));
    }
}

TEST_P(Serializers, TheSamePicture)
{
    SceneRenderer renderer(96, 72);
    osg::ref_ptr<LitScene> lit = makeScene();
    lit->getSettings()->bounce =
        osgEnvLight::Settings::BOUNCE_MEAN;  // which point a ray along an edge meets, the last digit decides
    lit->getSettings()->antialias = osgEnvLight::Settings::ANTIALIAS_OFF;  // and what is an edge
    const Picture before = renderer.render(lit, 2);
    osg::ref_ptr<LitScene> copy = reread(*lit, GetParam());
    ASSERT_TRUE(copy);
    // Text keeps six to nine digits of each coordinate: within 1/255 as asked, on every pixel
    EXPECT_LE(largestDifference(before, renderer.render(copy, 2)), 1.0 / 255.0);
}

TEST_P(Serializers, AMapByNameStaysAName)
{
    osg::ref_ptr<LitScene> lit = new LitScene;
    std::string error;
    ASSERT_TRUE(lit->getEnvironmentMap()->load("studio", nullptr, error)) << error;
    osg::ref_ptr<LitScene> copy = reread(*lit, GetParam());
    ASSERT_TRUE(copy);
    EXPECT_EQ("studio", copy->getEnvironmentMap()->getMap());
    ASSERT_TRUE(copy->getEnvironmentMap()->getImage());
    EXPECT_EQ(lit->getEnvironmentMap()->getImage()->s(), copy->getEnvironmentMap()->getImage()->s());
}

TEST_P(Serializers, AMapWhoseShapeNeedsItsLayoutIsReadWithIt)
{
    const TemporaryFolder folder;
    const std::string name =
        folder.write("square.hdr", "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 2 +X 2\n" + std::string(16, '\x80'));
    osg::ref_ptr<LitScene> lit = new LitScene;
    lit->getEnvironmentMap()->setLayout(osgEnvLight::MapLayout::MIRROR_BALL);
    std::string error;
    ASSERT_TRUE(lit->getEnvironmentMap()->load(name, nullptr, error)) << error;
    osg::ref_ptr<LitScene> copy = reread(*lit, GetParam());
    ASSERT_TRUE(copy);
    EXPECT_EQ(osgEnvLight::MapLayout::MIRROR_BALL, copy->getEnvironmentMap()->getLayout());
    EXPECT_EQ(name, copy->getEnvironmentMap()->getMap());
    EXPECT_TRUE(copy->getEnvironmentMap()->radiance(error)) << error;
}

INSTANTIATE_TEST_SUITE_P(Formats, Serializers, testing::Values(".osgt", ".osgb", ".osgx"),
                         [](const auto& format) { return std::string(format.param + 1); });

}  // namespace Serializers_test

// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <osgEnvLight/Settings>

#include <clocale>
#include <cmath>
#include <limits>
#include <locale>

namespace Settings_test
{

using osgEnvLight::Settings;

namespace
{

// A decimal comma and dots between thousands, whatever locales are installed.
struct Comma : std::numpunct<char> {
    char do_decimal_point() const override { return ','; }
    char do_thousands_sep() const override { return '.'; }
    std::string do_grouping() const override { return "\3"; }
};

class CommaLocale
{
  public:
    CommaLocale()
        : _before(std::locale::global(std::locale(std::locale::classic(), new Comma))), _c(std::setlocale(LC_NUMERIC, nullptr))
    {
        for (const char* name : {"de_DE.UTF-8", "de_DE.utf8", "fr_FR.UTF-8"})
            if (std::setlocale(LC_NUMERIC, name)) break;
    }
    ~CommaLocale()
    {
        std::locale::global(_before);
        std::setlocale(LC_NUMERIC, _c.c_str());
    }

  private:
    std::locale _before;
    std::string _c;
};

bool isReal(const Settings::Property& p)
{
    return std::holds_alternative<float Settings::*>(p.member);
}

// Values across the range, ends included.
std::vector<double> valuesOf(const Settings::Property& p)
{
    std::vector<double> values{p.minimum, p.maximum};
    for (double f : {0.1, 1.0 / 3.0, 0.7}) {
        const double x = p.minimum + f * (p.maximum - p.minimum);
        values.push_back(isReal(p) ? double(float(x)) : std::floor(x));
    }
    return values;
}

void expectRoundTrips()
{
    for (const Settings::Property& p : Settings::table())
        for (double value : valuesOf(p)) {
            osg::ref_ptr<Settings> a = new Settings;
            osg::ref_ptr<Settings> b = new Settings;
            std::string error;
            ASSERT_TRUE(a->set(p.name, value, error)) << error;
            const std::string text = p.getString(*a);
            ASSERT_TRUE(b->set(p.name, text, error)) << error;
            EXPECT_EQ(p.get(*b), value) << p.name << " as '" << text << "'";
            EXPECT_TRUE(error.empty());
        }
}

}  // namespace

TEST(Settings, EveryPropertyRoundTripsThroughText)
{
    expectRoundTrips();
}

TEST(Settings, TextDoesNotDependOnTheLocale)
{
    const CommaLocale comma;
    expectRoundTrips();
    osg::ref_ptr<Settings> settings = new Settings;
    std::string error;
    ASSERT_TRUE(settings->set("occlusionRadius", "0.5", error)) << error;
    EXPECT_EQ(settings->occlusionRadius, 0.5f);
    EXPECT_EQ(Settings::find("occlusionRadius")->getString(*settings), "0.5");
    EXPECT_FALSE(settings->set("occlusionRadius", "0,5", error));
    ASSERT_TRUE(settings->set("occlusionLights", 65536.0, error)) << error;
    EXPECT_EQ(Settings::find("occlusionLights")->getString(*settings), "65536");
}

TEST(Settings, DefaultsAreValid)
{
    osg::ref_ptr<Settings> settings = new Settings;
    std::string error;
    EXPECT_TRUE(settings->valid(error)) << error;
    EXPECT_EQ(settings->diffuseLights, 128);
    EXPECT_EQ(settings->occlusionLights, 512);
}

TEST(Settings, OutsideTheRangeNothingChangesAndTheRangeIsNamed)
{
    for (const Settings::Property& p : Settings::table())
        for (double value : {p.minimum - 1.0, p.maximum + 1.0, std::nan(""), std::numeric_limits<double>::infinity(),
                             -std::numeric_limits<double>::infinity()}) {
            osg::ref_ptr<Settings> settings = new Settings;
            const double before = p.get(*settings);
            std::string error;
            EXPECT_FALSE(settings->set(p.name, value, error)) << p.name << " " << value;
            EXPECT_EQ(p.get(*settings), before);
            EXPECT_NE(error.find(std::string("'") + p.name + "'"), std::string::npos) << error;
            EXPECT_NE(error.find(p.range()), std::string::npos) << error;
        }
}

TEST(Settings, RangeText)
{
    EXPECT_EQ(Settings::find("occlusionLights")->range(), "a whole number in 16..65536 lights");
    EXPECT_EQ(Settings::find("exposure")->range(), "a number in -32..32 stops");
    EXPECT_EQ(Settings::find("dither")->range(), "on | off");
    EXPECT_EQ(Settings::find("combine")->range(), "ratio | subtract");
}

TEST(Settings, WrongTextIsRefused)
{
    osg::ref_ptr<Settings> settings = new Settings;
    const std::pair<const char*, const char*> wrong[] = {{"diffuseLights", ""},
                                                         {"diffuseLights", "12.5"},
                                                         {"diffuseLights", "12 "},
                                                         {"diffuseLights", " 12"},
                                                         {"diffuseLights", "12x"},
                                                         {"diffuseLights", "nan"},
                                                         {"exposure", "inf"},
                                                         {"exposure", "1,5"},
                                                         {"exposure", "one"},
                                                         {"dither", "1"},
                                                         {"dither", "true"},
                                                         {"dither", "ON"},
                                                         {"combine", "Ratio"},
                                                         {"combine", "0"},
                                                         {"combine", ""},
                                                         {"occlusionRadius", "-1"},
                                                         {"exposure", "1e999"},
                                                         {"exposure", "+-1"},
                                                         {"diffuseLights", "99999999999999999999"}};
    for (const auto& [name, text] : wrong) {
        std::string error;
        EXPECT_FALSE(settings->set(name, text, error)) << name << " = '" << text << "'";
        EXPECT_NE(error.find(std::string("'") + text + "'"), std::string::npos) << error;
    }
}

TEST(Settings, UnknownNameListsTheKnown)
{
    osg::ref_ptr<Settings> settings = new Settings;
    for (bool number : {false, true}) {
        std::string error;
        EXPECT_FALSE(number ? settings->set("difuseLights", 3.0, error) : settings->set("difuseLights", "3", error));
        EXPECT_NE(error.find("'difuseLights'"), std::string::npos) << error;
        for (const Settings::Property& p : Settings::table()) EXPECT_NE(error.find(p.name), std::string::npos) << error;
    }
}

TEST(Settings, CopyTakesEveryProperty)
{
    for (const Settings::Property& p : Settings::table()) {
        osg::ref_ptr<Settings> settings = new Settings;
        const double other = p.get(*settings) == p.maximum ? p.minimum : p.maximum;
        p.put(*settings, other);
        EXPECT_EQ(p.get(*osg::ref_ptr<Settings>(new Settings(*settings))), other) << p.name;
    }
}

TEST(Settings, ValidFindsEveryPropertyOutOfRange)
{
    for (const Settings::Property& p : Settings::table()) {
        if (std::holds_alternative<bool Settings::*>(p.member)) continue;  // can't be out of its range
        osg::ref_ptr<Settings> settings = new Settings;
        p.put(*settings, p.maximum + 1.0);
        std::string error;
        EXPECT_FALSE(settings->valid(error)) << p.name;
        EXPECT_NE(error.find(p.name), std::string::npos) << error;
    }
}

TEST(Settings, NamesAreUnique)
{
    for (const Settings::Property& p : Settings::table()) EXPECT_EQ(Settings::find(p.name), &p);
    EXPECT_EQ(Settings::find("no such"), nullptr);
}

}  // namespace Settings_test

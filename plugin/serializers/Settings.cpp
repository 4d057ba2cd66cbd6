// SPDX-License-Identifier: MIT
#include "NamedTexts.h"

#include <osgEnvLight/Settings>

#include <osg/Notify>
#include <osgDB/ObjectWrapper>

namespace
{

using osgEnvLight::Settings;

// The properties of version 0 in the order of its table, which was the order in its files. Never to be changed.
const char* const version0Names[] = {"diffuse",
                                     "specular",
                                     "occlusion",
                                     "lightSampler",
                                     "lightWeights",
                                     "lightFloor",
                                     "lightDeal",
                                     "suns",
                                     "regeneration",
                                     "diffuseCarrier",
                                     "diffuseError",
                                     "diffuseLights",
                                     "specularSamples",
                                     "visibility",
                                     "atlasLights",
                                     "atlasSize",
                                     "atlasUpdatesPerFrame",
                                     "sunShadowSize",
                                     "nearRadius",
                                     "nearTaps",
                                     "occlusionLights",
                                     "occlusionMethod",
                                     "occlusionSlices",
                                     "occlusionTaps",
                                     "occlusionSteps",
                                     "occlusionRadius",
                                     "occlusionThickness",
                                     "filterCells",
                                     "combine",
                                     "bounce",
                                     "accumulate",
                                     "accumulateFrames",
                                     "accumulateSize",
                                     "background",
                                     "backgroundBlur",
                                     "view",
                                     "output",
                                     "exposure",
                                     "toneCurve",
                                     "dither"};

// Files leave out what has its default, so the default of the version that wrote them counts.
struct FormerDefault {
    const char* name;
    const char* text;
    int lastVersion;
};
const FormerDefault formerDefaults[] = {{"background", "on", 0}, {"exposureBase", "map", 1}};

void setOrWarn(Settings& settings, const std::string& name, const std::string& text)
{
    std::string error;
    if (!settings.set(name, text, error)) OSG_WARN << "osgEnvLight: " << error << std::endl;
}

void setFormerDefaults(Settings& settings, int version)
{
    for (const FormerDefault& former : formerDefaults)
        if (version <= former.lastVersion) setOrWarn(settings, former.name, former.text);
}

/** Reads and writes all properties, as names and texts: a file does not depend on the order or type of members. Only those that
 * differ from the default are written.*/
class AllProperties : public osgDB::BaseSerializer
{
  public:
    AllProperties() : BaseSerializer(READ_WRITE_PROPERTY) {}

    const std::string& getName() const override { return _name; }

    bool read(osgDB::InputStream& is, osg::Object& object) override
    {
        Settings& settings = static_cast<Settings&>(object);
        NamedTexts list;
        unsigned char mark = 0;
        if (is.isBinary()) {
            is >> mark;
            if (mark >= NamedTexts::binaryMark) list = NamedTexts::readBinary(is);
        } else {
            list = NamedTexts::readText(is);
        }
        setFormerDefaults(settings, list.version);
        if (list.version == 0) {
            readVersion0(is, settings, mark != 0);
            return true;
        }
        std::vector<std::string> unknown;
        for (const auto& [name, text] : list.pairs) {
            if (Settings::find(name))
                setOrWarn(settings, name, text);
            else
                unknown.push_back(name);
        }
        NamedTexts::reportUnknown("Settings", unknown);
        return true;
    }

    bool write(osgDB::OutputStream& os, const osg::Object& object) override
    {
        const Settings& settings = static_cast<const Settings&>(object);
        const osg::ref_ptr<const Settings> defaults = new Settings;
        NamedTexts list;
        for (const Settings::Property& p : Settings::table())
            if (p.get(settings) != p.get(*defaults)) list.pairs.emplace_back(p.name, p.getString(settings));
        list.write(os);
        return true;
    }

  private:
    /** Binary files of version 0 have a bool for each property, whether its text follows; the first is already read. */
    static void readVersion0(osgDB::InputStream& is, Settings& settings, bool present)
    {
        for (const char* name : version0Names) {
            if (!is.isBinary())
                present = is.matchString(name);
            else if (name != version0Names[0])
                is >> present;
            if (!present) continue;
            std::string text;
            is.readWrappedString(text);
            setOrWarn(settings, name, text);
        }
    }

    const std::string _name = "Properties";
};

/** Access to one property for scripts and editors (osgDB::ClassInterface), whose stream is one bare value. AllProperties reads
 * and writes it in files.*/
class PropertySerializer : public osgDB::BaseSerializer
{
  public:
    explicit PropertySerializer(const Settings::Property& property)
        : BaseSerializer(GET_SET_PROPERTY), _property(property), _name(property.name)
    {
    }

    const std::string& getName() const override { return _name; }

    bool get(const osg::Object& object, void* value) override
    {
        const Settings& s = static_cast<const Settings&>(object);
        std::visit([&](auto m) { *static_cast<Value<decltype(m)>*>(value) = s.*m; }, _property.member);
        return true;
    }

    bool set(osg::Object& object, void* value) override
    {
        return std::visit([&](auto m) { return set(object, *static_cast<Value<decltype(m)>*>(value)); }, _property.member);
    }

    bool read(osgDB::InputStream& is, osg::Object& object) override
    {
        return std::visit(
            [&](auto m) {
                Value<decltype(m)> value{};
                is >> value;
                return set(object, value);
            },
            _property.member);
    }

    bool write(osgDB::OutputStream& os, const osg::Object& object) override
    {
        std::visit([&](auto m) { os << static_cast<const Settings&>(object).*m; }, _property.member);
        return true;
    }

  private:
    template <class Member>
    using Value = std::decay_t<decltype(std::declval<Settings&>().*std::declval<Member>())>;

    template <class T>
    bool set(osg::Object& object, T value) const
    {
        std::string error;
        if (static_cast<Settings&>(object).set(_name, double(value), error)) return true;
        OSG_WARN << "osgEnvLight: " << error << std::endl;
        return false;
    }

    const Settings::Property& _property;
    const std::string _name;
};

osgDB::BaseSerializer::Type typeOf(const Settings::Property& p)
{
    if (std::holds_alternative<bool Settings::*>(p.member)) return osgDB::BaseSerializer::RW_BOOL;
    return std::holds_alternative<int Settings::*>(p.member) ? osgDB::BaseSerializer::RW_INT : osgDB::BaseSerializer::RW_FLOAT;
}

}  // namespace

// The macro takes the name of the class from its third argument, so that must be qualified.
REGISTER_OBJECT_WRAPPER(osgEnvLight_Settings, new osgEnvLight::Settings, osgEnvLight::Settings,
                        "osg::Object osgEnvLight::Settings")
{
    wrapper->addSerializer(new AllProperties, osgDB::BaseSerializer::RW_USER);
    for (const Settings::Property& p : Settings::table()) wrapper->addSerializer(new PropertySerializer(p), typeOf(p));
}

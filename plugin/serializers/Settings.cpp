// SPDX-License-Identifier: MIT
#include <osgEnvLight/Settings>

#include <osg/Notify>
#include <osgDB/InputStream>
#include <osgDB/ObjectWrapper>
#include <osgDB/OutputStream>

namespace
{

using osgEnvLight::Settings;

/** One property of the table, by its name and as its text: so a file does not depend on the order or type of members.
 * Written only where it differs from the default.*/
class PropertySerializer : public osgDB::BaseSerializer
{
  public:
    explicit PropertySerializer(const Settings::Property& property)
        : BaseSerializer(READ_WRITE_PROPERTY | GET_SET_PROPERTY), _property(property), _name(property.name)
    {
    }

    const std::string& getName() const override { return _name; }

    bool get(const osg::Object& object, void* value) override
    {
        const Settings& s = static_cast<const Settings&>(object);
        std::visit([&](auto m) { *static_cast<std::decay_t<decltype(s.*m)>*>(value) = s.*m; }, _property.member);
        return true;
    }

    bool set(osg::Object& object, void* value) override
    {
        Settings& s = static_cast<Settings&>(object);
        std::string error;
        return std::visit([&](auto m) { return s.set(_name, double(*static_cast<std::decay_t<decltype(s.*m)>*>(value)), error); },
                          _property.member);
    }

    bool read(osgDB::InputStream& is, osg::Object& object) override
    {
        if (is.isBinary()) {
            bool present = false;
            is >> present;
            if (!present) return true;
        } else if (!is.matchString(_name)) {
            return true;
        }
        std::string text;
        std::string error;
        is.readWrappedString(text);
        if (!static_cast<Settings&>(object).set(_name, text, error)) OSG_WARN << "osgEnvLight: " << error << std::endl;
        return true;
    }

    bool write(osgDB::OutputStream& os, const osg::Object& object) override
    {
        const Settings& s = static_cast<const Settings&>(object);
        const osg::ref_ptr<const Settings> defaults = new Settings;
        const bool present = _property.get(s) != _property.get(*defaults);
        if (os.isBinary())
            os << present;
        else if (present)
            os << os.PROPERTY(_name.c_str());
        if (!present) return true;
        os.writeWrappedString(_property.getString(s));
        if (!os.isBinary()) os << std::endl;
        return true;
    }

  private:
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
    for (const Settings::Property& p : Settings::table()) wrapper->addSerializer(new PropertySerializer(p), typeOf(p));
}

// SPDX-License-Identifier: MIT
#include <osgEnvLight/Settings>

#include <charconv>
#include <cmath>

namespace osgEnvLight
{

namespace
{

// The shortest text that reads back as the same number.
template <class T>
std::string numberText(T value)
{
    char text[32];
    const auto [end, status] = std::to_chars(text, text + sizeof(text), value);
    return std::string(text, end);
}

bool isInteger(const Settings::Property& p)
{
    return !std::holds_alternative<float Settings::*>(p.member);
}

bool inRange(const Settings::Property& p, double value)
{
    return value >= p.minimum && value <= p.maximum && (!isInteger(p) || value == std::floor(value));
}

std::string rangeError(const Settings::Property& p, const std::string& found)
{
    return std::string("setting '") + p.name + "' is " + found + ", expected " + p.range();
}

// The value that text stands for, or NaN.
double parse(const Settings::Property& p, const std::string& text)
{
    if (std::holds_alternative<bool Settings::*>(p.member)) return text == "on" ? 1.0 : text == "off" ? 0.0 : std::nan("");
    for (size_t i = 0; i < p.choices.size(); ++i)
        if (text == p.choices[i]) return double(i);
    double value = 0.0;
    auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), value);
    bool number = p.choices.empty() && status == std::errc() && end == text.data() + text.size();
    return number ? value : std::nan("");
}

}  // namespace

Settings::Settings(const Settings& other, const osg::CopyOp& copyop) : osg::Object(other, copyop), JoinedSettings(other) {}

const std::vector<Settings::Property>& Settings::table()
{
    static const std::vector<Property> all = properties();
    return all;
}

const Settings::Property* Settings::find(const std::string& name)
{
    for (const Property& p : table())
        if (name == p.name) return &p;
    return nullptr;
}

double SettingsProperty::get(const Settings& settings) const
{
    return std::visit([&](auto m) { return double(settings.*m); }, member);
}

void SettingsProperty::put(Settings& settings, double value) const
{
    std::visit([&](auto m) { settings.*m = static_cast<std::decay_t<decltype(settings.*m)>>(value); }, member);
}

std::string SettingsProperty::getString(const Settings& settings) const
{
    double value = get(settings);
    if (std::holds_alternative<bool Settings::*>(member)) return value != 0.0 ? "on" : "off";
    if (!choices.empty() && inRange(*this, value)) return choices[size_t(value)];
    return std::holds_alternative<float Settings::*>(member) ? numberText(float(value)) : numberText(value);
}

std::string SettingsProperty::range() const
{
    if (std::holds_alternative<bool Settings::*>(member)) return "on | off";
    std::string text;
    for (const char* c : choices) text += (text.empty() ? "" : " | ") + std::string(c);
    if (!text.empty()) return text;
    return (isInteger(*this) ? "a whole number in " : "a number in ") + numberText(minimum) + ".." + numberText(maximum) +
           (*unit ? std::string(" ") + unit : std::string());
}

bool Settings::set(const std::string& name, const std::string& value, std::string& error)
{
    if (name == "preset") return setPreset(value, error);
    const Property* p = find(name);
    if (p) {
        double x = parse(*p, value);
        if (inRange(*p, x)) {
            p->put(*this, x);
            return true;
        }
        error = rangeError(*p, "'" + value + "'");
        return false;
    }
    error = "no setting is named '" + name + "'; there are";
    for (const Property& known : table()) error += std::string(" ") + known.name;
    return false;
}

bool Settings::set(const std::string& name, double value, std::string& error)
{
    const Property* p = find(name);
    if (!p) return set(name, std::string(), error);
    if (!inRange(*p, value)) {
        error = rangeError(*p, numberText(value));
        return false;
    }
    p->put(*this, value);
    return true;
}

bool Settings::valid(std::string& error) const
{
    for (const Property& p : table())
        if (!inRange(p, p.get(*this))) {
            error = rangeError(p, numberText(p.get(*this)));
            return false;
        }
    return true;
}

}  // namespace osgEnvLight

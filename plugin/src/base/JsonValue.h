// SPDX-License-Identifier: MIT
// Reading JSON with errors that a user can act on. Not installed: the JSON library stays out of the nodekit's headers.
#pragma once

#include <osg/Vec3d>

#include <cmath>
#include <istream>
#include <iterator>
#include <stdexcept>
#include <string>

#include <nlohmann/json.hpp>

namespace osgEnvLight
{

/** A JSON value and the way to it, for messages. What it does not like it throws as std::runtime_error, in words that name
 * the file and the key. */
class JsonValue
{
  public:
    JsonValue(const nlohmann::json& j, std::string file, std::string path)
        : _json(j), _file(std::move(file)), _path(std::move(path))
    {
    }

    [[noreturn]] void fail(const std::string& expected) const
    {
        std::string found = _json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
        if (found.size() > 60) found = found.substr(0, 57) + "...";
        fail(expected, found);
    }

    [[noreturn]] void fail(const std::string& expected, const std::string& found) const
    {
        throw std::runtime_error(_file + ": " + (_path.empty() ? std::string("the file") : "key '" + _path + "'") +
                                 ": expected " + expected + ", found " + found);
    }

    [[noreturn]] void failMissing(const std::string& key, const std::string& expected) const
    {
        JsonValue(_json, _file, join(key)).fail(expected, "nothing");
    }

    // The members of an object, whose keys must all be known.
    void object(const std::vector<std::string>& keys, const char* what) const
    {
        if (!_json.is_object()) fail(what);
        for (const auto& [key, value] : _json.items()) {
            bool known = false;
            std::string list;
            for (const std::string& k : keys) {
                known = known || key == k;
                list += (list.empty() ? "" : ", ") + k;
            }
            if (!known) throw std::runtime_error(_file + ": unknown key '" + join(key) + "'; expected one of " + list);
        }
    }

    bool has(const char* key) const { return _json.contains(key); }
    JsonValue operator[](const std::string& key) const { return JsonValue(_json.at(key), _file, join(key)); }

    // Of a list.
    size_t size() const { return _json.size(); }
    JsonValue element(size_t i) const { return JsonValue(_json.at(i), _file, _path + "[" + std::to_string(i) + "]"); }

    std::string string() const
    {
        if (!_json.is_string()) fail("a string");
        return _json.get<std::string>();
    }

    bool boolean() const
    {
        if (!_json.is_boolean()) fail("true or false");
        return _json.get<bool>();
    }

    double number(double low, double high, const char* what) const
    {
        const double x = _json.is_number() ? _json.get<double>() : std::nan("");
        if (!(x >= low && x <= high)) fail(what);
        return x;
    }

    osg::Vec3d vector(double low, double high, const char* what) const
    {
        osg::Vec3d v;
        if (!_json.is_array() || _json.size() != 3) fail(what);
        for (int i = 0; i < 3; ++i) {
            const nlohmann::json& component = _json[size_t(i)];
            if (!component.is_number()) fail(what);
            v[i] = component.get<double>();
            if (!(v[i] >= low && v[i] <= high)) fail(what);
        }
        return v;
    }

    const nlohmann::json& get() const { return _json; }

  private:
    std::string join(const std::string& key) const { return _path.empty() ? key : _path + "." + key; }

    const nlohmann::json& _json;
    std::string _file;
    std::string _path;
};

/** Whether brackets are nested deeper than that. Not the parser's own callback, whose time grows with the square of a list. */
inline bool isNestedDeeper(const std::string& text, int limit)
{
    int depth = 0;
    bool quoted = false;
    for (size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (quoted && c == '\\')
            ++i;
        else if (c == '"')
            quoted = !quoted;
        else if (!quoted && (c == '[' || c == '{') && ++depth > limit)
            return true;
        else if (!quoted && (c == ']' || c == '}'))
            --depth;
    }
    return false;
}

/** The document, or std::runtime_error in words that name the file. */
inline nlohmann::json parseJson(std::istream& in, const std::string& name)
{
    const std::string text{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
    // Deeper than any scene needs, shallower than the stack that messages recurse on.
    if (isNestedDeeper(text, 64)) throw std::runtime_error(name + ": not valid: nested deeper than 64 levels");
    try {
        return nlohmann::json::parse(text);
    } catch (const nlohmann::json::exception& e) {  // a fault of syntax, or a number beyond a double
        const std::string what = e.what();
        const size_t at = what.find("at line");
        const size_t words = what.find("] ");
        const std::string detail = at != std::string::npos      ? " " + what.substr(at)
                                   : words != std::string::npos ? ": " + what.substr(words + 2)
                                                                : "";
        throw std::runtime_error(name + ": not valid JSON" + detail);
    }
}

}  // namespace osgEnvLight

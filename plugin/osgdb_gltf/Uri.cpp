// SPDX-License-Identifier: MIT
#include "Uri.h"

#include <osgDB/FileUtils>
#include <osgDB/fstream>

#include <algorithm>
#include <stdexcept>

namespace osgEnvLight::gltf
{

namespace
{

using Bytes = std::vector<unsigned char>;

// Not those of <cctype>, which ask the locale.
bool isLetter(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}
bool isDigit(char c)
{
    return c >= '0' && c <= '9';
}

int hexDigit(char c)
{
    if (isDigit(c)) return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    return c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
}

int base64Digit(char c)
{
    if (c >= 'A' && c <= 'Z') return c - 'A';
    if (c >= 'a' && c <= 'z') return c - 'a' + 26;
    if (isDigit(c)) return c - '0' + 52;
    return c == '+' ? 62 : c == '/' ? 63 : -1;
}

std::string percentDecoded(const std::string& text)
{
    std::string result;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const bool escape = text[i] == '%' && i + 2 < text.size() && hexDigit(text[i + 1]) >= 0 && hexDigit(text[i + 2]) >= 0;
        result += escape ? static_cast<char>(hexDigit(text[i + 1]) * 16 + hexDigit(text[i + 2])) : text[i];
        if (escape) i += 2;
    }
    return result;
}

/** "http" of "http://..."; nothing for a path. */
std::string schemeOf(const std::string& uri)
{
    const std::size_t colon = uri.find(':');
    if (colon == std::string::npos || colon == 0 || !isLetter(uri[0])) return {};
    const bool scheme = std::all_of(uri.begin(), uri.begin() + std::ptrdiff_t(colon),
                                    [](char c) { return isLetter(c) || isDigit(c) || c == '+' || c == '-' || c == '.'; });
    return scheme ? uri.substr(0, colon) : std::string();
}

Bytes dataOf(const std::string& uri, std::uint64_t least, std::uint64_t most)
{
    const std::size_t comma = uri.find(',');
    const bool base64 = comma != std::string::npos && comma >= 7 && uri.compare(comma - 7, 7, ";base64") == 0;
    if (!base64) throw std::runtime_error("a data URI that is not base64");
    std::optional<Bytes> bytes = decodeBase64(uri, comma + 1);
    if (!bytes) throw std::runtime_error("a data URI whose base64 is damaged");
    if (bytes->size() < least) throw std::runtime_error("a data URI of " + std::to_string(bytes->size()) + " bytes");
    if (bytes->size() > most) bytes->resize(most);
    return std::move(*bytes);
}

Bytes fileOf(const std::string& path, const osgDB::Options* options, std::uint64_t least, std::uint64_t most)
{
    const std::string found = osgDB::findDataFile(path, options);
    if (found.empty()) throw std::runtime_error("'" + path + "': no such file");
    // Devices and pipes may have no end.
    if (osgDB::fileType(found) != osgDB::REGULAR_FILE) throw std::runtime_error("'" + path + "', which is not a file");
    osgDB::ifstream in(found.c_str(), std::ios::in | std::ios::binary);
    in.seekg(0, std::ios::end);
    const std::streamoff size = in.tellg();
    if (!in || size < 0) throw std::runtime_error("'" + path + "', which cannot be read");
    const std::uint64_t there = static_cast<std::uint64_t>(size);
    if (there < least) throw std::runtime_error("'" + path + "' of " + std::to_string(there) + " bytes");
    if (there > most && least == 0) throw std::runtime_error("'" + path + "' of " + std::to_string(there) + " bytes");
    Bytes bytes(static_cast<std::size_t>(std::min(there, most)));
    in.seekg(0);
    in.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    if (!in) throw std::runtime_error("'" + path + "', which cannot be read");
    return bytes;
}

}  // namespace

std::optional<std::vector<unsigned char>> decodeBase64(const std::string& text, std::size_t from)
{
    std::size_t end = text.size();
    while (end > from && text[end - 1] == '=') --end;
    if ((end - from) % 4 == 1) return std::nullopt;
    Bytes bytes;
    bytes.reserve((end - from) / 4 * 3 + 2);
    unsigned bits = 0;
    int count = 0;
    for (std::size_t i = from; i < end; ++i) {
        const int digit = base64Digit(text[i]);
        if (digit < 0) return std::nullopt;
        bits = (bits << 6 | static_cast<unsigned>(digit)) & 0xffffff;
        count += 6;
        if (count < 8) continue;
        count -= 8;
        bytes.push_back(static_cast<unsigned char>(bits >> count));
    }
    return bytes;
}

std::vector<unsigned char> readUri(const std::string& uri, const osgDB::Options* options, std::uint64_t least, std::uint64_t most)
{
    const std::string scheme = schemeOf(uri);
    if (scheme == "data") return dataOf(uri, least, most);
    if (!scheme.empty() && scheme != "file") throw std::runtime_error("the scheme '" + scheme + ":'");
    const std::string path = percentDecoded(scheme.empty() ? uri : uri.substr(5));
    if (path.empty()) throw std::runtime_error("an empty URI");
    if (path[0] == '/' || path[0] == '\\' || !schemeOf(path).empty())
        throw std::runtime_error("the absolute path '" + path + "'");
    if (path.find('\0') != std::string::npos) throw std::runtime_error("a path with a zero byte");
    return fileOf(path, options, least, most);
}

}  // namespace osgEnvLight::gltf

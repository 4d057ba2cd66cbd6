// SPDX-License-Identifier: MIT
#include <osgEnvLight/EnvironmentMap>

#include <osgEnvLight/BuiltinMaps>
#include <osgEnvLight/RadianceHdr>
#include <osgEnvLight/ReadMessage>

#include <osg/Notify>
#include <osgDB/FileNameUtils>
#include <osgDB/FileUtils>
#include <osgDB/ReadFile>
#include <osgDB/fstream>

#include <algorithm>
#include <cmath>
#include <locale>
#include <sstream>

#include "glsl.h"

namespace osgEnvLight
{

namespace
{

const double negativeTolerance = 1e-4;  // of the flux: what compression leaves in real maps, and no more

std::string describe(const osg::Image& image)
{
    return image.getFileName().empty() ? std::string("environment map") : "environment map '" + image.getFileName() + "'";
}

bool isEncoded(const osg::Image& image)
{
    return image.getDataType() == GL_UNSIGNED_BYTE;
}

// Texel x of row y from the top, linear.
osg::Vec3d readTexel(const osg::Image& image, int x, int y)
{
    int t = image.getOrigin() == osg::Image::TOP_LEFT ? y : image.t() - 1 - y;
    if (image.getDataType() == GL_FLOAT && (image.getPixelFormat() == GL_RGB || image.getPixelFormat() == GL_RGBA)) {
        const float* p = reinterpret_cast<const float*>(image.data(unsigned(x), unsigned(t)));
        return osg::Vec3d(p[0], p[1], p[2]);
    }
    osg::Vec3d c;
    osg::Vec4 color = image.getColor(unsigned(x), unsigned(t));
    for (int i = 0; i < 3; ++i)
        c[i] = isEncoded(image) ? glsl::srgbDecode(double(color[unsigned(i)])) : double(color[unsigned(i)]);
    return c;
}

std::string shapeError(const osg::Image& image)
{
    int w = image.s();
    int h = image.t();
    std::string size = std::to_string(w) + "x" + std::to_string(h);
    if (w <= 0 || h <= 0 || !image.data()) return describe(image) + " is empty (" + size + ")";
    if (w != 2 * h && w != 1 && h != 1)
        return describe(image) + " is " + size + ", expected a latitude-longitude image, twice as wide as high";
    return std::string();
}

// Where sanitising first found something.
struct Findings {
    std::string firstNotFinite;
    std::string firstNegative;
    double negativeFlux = 0.0;
};

std::string percent(double x)
{
    std::ostringstream out;
    out.imbue(std::locale::classic());
    out.precision(3);
    out << 100.0 * x << " %";
    return out.str();
}

std::string texelName(int x, int y)
{
    return "pixel (" + std::to_string(x) + ", " + std::to_string(y) + ")";
}

void sanitise(osg::Vec3d& c, int x, int y, double solidAngle, RadianceMap& map, Findings& found)
{
    bool finite = std::isfinite(c[0]) && std::isfinite(c[1]) && std::isfinite(c[2]);
    if (!finite) {
        if (map.notFinite++ == 0) found.firstNotFinite = texelName(x, y);
        for (int i = 0; i < 3; ++i)
            if (!std::isfinite(c[i])) c[i] = 0.0;
    }
    double most = std::min(std::min(c[0], c[1]), c[2]);
    if (most < 0.0) {
        if (map.negative++ == 0) found.firstNegative = texelName(x, y);
        for (int i = 0; i < 3; ++i) {
            found.negativeFlux -= std::min(c[i], 0.0) * solidAngle;
            c[i] = std::max(c[i], 0.0);
        }
    }
}

osg::ref_ptr<RadianceMap> convert(const osg::Image& image, Findings& found)
{
    osg::ref_ptr<RadianceMap> map = new RadianceMap;
    map->width = image.s();
    map->height = image.t();
    map->image = new osg::Image;
    map->image->setFileName(image.getFileName());
    map->image->allocateImage(map->width, map->height, 1, GL_RGB, GL_FLOAT);
    for (int y = 0; y < map->height; ++y) {
        double solidAngle = glsl::latlongTexelSolidAngle(y, glsl::vec2(map->width, map->height));
        float* out = reinterpret_cast<float*>(map->image->data(0, unsigned(map->height - 1 - y)));
        osg::Vec3d row;
        for (int x = 0; x < map->width; ++x, out += 3) {
            osg::Vec3d c = readTexel(image, x, y);
            sanitise(c, x, y, solidAngle, *map, found);
            row += c;
            for (int i = 0; i < 3; ++i) {
                out[i] = float(c[i]);
                map->maximum = std::max(map->maximum, c[i]);
            }
        }
        map->flux += row * solidAngle;
    }
    const osg::Vec3d luminance(0.2126, 0.7152, 0.0722);
    map->mean = luminance * map->flux / (4.0 * glsl::PI);
    double flux = map->flux[0] + map->flux[1] + map->flux[2];
    map->negativeShare = flux > 0.0 ? found.negativeFlux / flux : (found.negativeFlux > 0.0 ? 1.0 : 0.0);
    return map;
}

bool isBuiltin(const std::string& name)
{
    const std::vector<std::string>& names = builtinMapNames();
    return std::find(names.begin(), names.end(), name) != names.end();
}

osg::ref_ptr<osg::Image> readHdr(const std::string& name, const osgDB::Options* options, std::string& error)
{
    std::string path = osgDB::findDataFile(name, options);
    if (path.empty() || osgDB::fileType(path) != osgDB::REGULAR_FILE) {
        error = path.empty() ? "no such file" : "not a file";
        return nullptr;
    }
    osgDB::ifstream in(path.c_str(), std::ios::binary);
    osg::ref_ptr<osg::Image> image = readRadianceHdr(in, name, error);
    if (!image && error.rfind(name + ": ", 0) == 0) error.erase(0, name.size() + 2);
    return image;
}

osg::ref_ptr<osg::Image> readAny(const std::string& name, const osgDB::Options* options, std::string& error)
{
    if (isBuiltin(name)) return createBuiltinMap(name);
    const std::string extension = osgDB::getLowerCaseFileExtension(name);
    if (extension == "hdr" || extension == "pic") return readHdr(name, options, error);
    osgDB::ReaderWriter::ReadResult result = osgDB::Registry::instance()->readImage(name, options);
    if (!result.validImage()) {
        error = readMessage(result, name);
        return nullptr;
    }
    return result.getImage();
}

}  // namespace

EnvironmentMap::EnvironmentMap(osg::Image* image)
{
    setImage(image);
}

EnvironmentMap::EnvironmentMap(const EnvironmentMap& other, const osg::CopyOp& copyop)
    : osg::Object(other, copyop),
      _map(other._map),
      _image(copyop(other._image.get())),
      _rotation(other._rotation),
      _intensity(other._intensity),
      _strict(other._strict)
{
}

bool EnvironmentMap::load(const std::string& name, const osgDB::Options* options, std::string& error)
{
    std::string reason;
    osg::ref_ptr<osg::Image> image = readAny(name, options, reason);
    if (image && !shapeError(*image).empty()) reason = shapeError(*image);
    if (!reason.empty() || !image) {
        error = "environment map '" + name + "': " + (reason.empty() ? "can't be read" : reason);
        return false;
    }
    // A file is remembered by where it was found, so that a saved scene finds it again.
    const std::string found = isBuiltin(name) ? std::string() : osgDB::findDataFile(name, options);
    _map = found.empty() ? name : found;
    image->setFileName(_map);
    _image = image;
    return true;
}

void EnvironmentMap::setImage(osg::Image* image)
{
    _image = image;
    _map = image ? image->getFileName() : "sky";
}

osg::ref_ptr<const RadianceMap> EnvironmentMap::radiance(std::string& error) const
{
    std::lock_guard<std::mutex> lock(_mutex);
    const unsigned count = _image ? _image->getModifiedCount() : 0;
    const bool current =
        (_radiance || !_error.empty()) && _madeFrom == _image.get() && _madeAtCount == count && _madeStrict == _strict;
    if (current) {
        error = _error;
        return _radiance;
    }
    osg::ref_ptr<osg::Image> image = _image ? _image : createBuiltinMap("sky");
    _madeFrom = _image.get();
    _madeAtCount = count;
    _madeStrict = _strict;
    _radiance = nullptr;
    _error = shapeError(*image);
    Findings found;
    osg::ref_ptr<RadianceMap> map = _error.empty() ? convert(*image, found) : nullptr;
    if (map && (map->notFinite > 0 || map->negativeShare > negativeTolerance)) {
        std::string report = describe(*image) + ":";
        if (map->notFinite > 0)
            report += " " + std::to_string(map->notFinite) + " texels are not finite, the first is " + found.firstNotFinite + ";";
        if (map->negativeShare > negativeTolerance)
            report += " " + std::to_string(map->negative) + " texels are negative (" + percent(map->negativeShare) +
                      " of the flux), the first is " + found.firstNegative + ";";
        if (_strict)
            _error = report + " refused, because strict is on";
        else
            OSG_WARN << "osgEnvLight: " << report << " set to 0" << std::endl;
    }
    if (_error.empty()) _radiance = map;
    error = _error;
    return _radiance;
}

}  // namespace osgEnvLight

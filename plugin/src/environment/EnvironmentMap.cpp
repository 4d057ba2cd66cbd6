// SPDX-License-Identifier: MIT
#include <osgEnvLight/EnvironmentMap>

#include <osgEnvLight/BuiltinMaps>
#include <osgEnvLight/LightFile>
#include "environment/RadianceHdr.h"
#include "base/ReadMessage.h"

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

// The image's texels, linear, y from the top. Slices are faces, whose first row is the top one.
class Source
{
  public:
    explicit Source(const osg::Image& image)
        : _image(image),
          _topFirst(image.r() > 1 || image.getOrigin() == osg::Image::TOP_LEFT),
          _encoded(image.getDataType() == GL_UNSIGNED_BYTE),
          _rowStep(image.getRowStepInBytes()),
          _sliceStep(image.getImageStepInBytes())
    {
        if (image.getDataType() == GL_FLOAT && image.getPixelFormat() == GL_RGB) _floats = 3;
        if (image.getDataType() == GL_FLOAT && image.getPixelFormat() == GL_RGBA) _floats = 4;
    }

    bool hasSlices() const { return _image.r() > 1; }

    osg::Vec3d texel(int x, int y, int slice) const
    {
        const int t = _topFirst ? y : _image.t() - 1 - y;
        if (_floats > 0) {
            // Not image.data(x, y), which works out the size of a pixel each time.
            const unsigned char* row = _image.data() + size_t(slice) * _sliceStep + size_t(t) * _rowStep;
            const float* p = reinterpret_cast<const float*>(row) + _floats * size_t(x);
            return osg::Vec3d(p[0], p[1], p[2]);
        }
        osg::Vec3d c;
        const osg::Vec4 color = _image.getColor(unsigned(x), unsigned(t), unsigned(slice));
        for (int i = 0; i < 3; ++i) c[i] = _encoded ? glsl::srgbDecode(double(color[unsigned(i)])) : double(color[unsigned(i)]);
        return c;
    }

  private:
    const osg::Image& _image;
    bool _topFirst;
    bool _encoded;
    size_t _rowStep;
    size_t _sliceStep;
    size_t _floats = 0;  // in a pixel that needs no conversion
};

// Makes layout AUTO what the image's shape means; "" or "is ..., expected ...", to follow the image's name.
std::string shapeError(const osg::Image& image, MapLayout& layout)
{
    if (image.s() <= 0 || image.t() <= 0 || !image.data())
        return "is empty (" + std::to_string(image.s()) + "x" + std::to_string(image.t()) + ")";
    return resolveMapLayout(layout, image.s(), image.t(), image.r());
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

struct Texel {
    int x;
    int y;
    int slice;
    bool ofSlices;

    std::string name() const
    {
        static const char* const faces[6] = {"+X", "-X", "+Y", "-Y", "+Z", "-Z"};
        return "pixel (" + std::to_string(x) + ", " + std::to_string(y) + ")" +
               (ofSlices ? std::string(" of face ") + faces[slice] : std::string());
    }
};

void sanitise(osg::Vec3d& c, const Texel& texel, double solidAngle, RadianceMap& map, Findings& found)
{
    bool finite = std::isfinite(c[0]) && std::isfinite(c[1]) && std::isfinite(c[2]);
    if (!finite) {
        if (map.notFinite++ == 0) found.firstNotFinite = texel.name();
        for (int i = 0; i < 3; ++i)
            if (!std::isfinite(c[i])) c[i] = 0.0;
    }
    double most = std::min(std::min(c[0], c[1]), c[2]);
    if (most < 0.0) {
        if (map.negative++ == 0) found.firstNegative = texel.name();
        for (int i = 0; i < 3; ++i) {
            found.negativeFlux -= std::min(c[i], 0.0) * solidAngle;
            c[i] = std::max(c[i], 0.0);
        }
    }
}

// Adds row y, from the top, to flux and maximum.
void measureRow(RadianceMap& map, int y, double solidAngle)
{
    const float* texel = map.texel(0, y);
    osg::Vec3d sum;
    for (int x = 0; x < map.width; ++x)
        for (int i = 0; i < 3; ++i, ++texel) {
            sum[i] += double(*texel);
            map.maximum = std::max(map.maximum, double(*texel));
        }
    map.flux += sum * solidAngle;
}

void readLatlong(const osg::Image& image, RadianceMap& map, Findings& found)
{
    const Source source(image);
    for (int y = 0; y < map.height; ++y) {
        const double solidAngle = glsl::latlongTexelSolidAngle(y, glsl::vec2(map.width, map.height));
        float* out = reinterpret_cast<float*>(map.image->data(0, unsigned(map.height - 1 - y)));
        for (int x = 0; x < map.width; ++x, out += 3) {
            osg::Vec3d c = source.texel(x, y, 0);
            sanitise(c, Texel{x, y, 0, false}, solidAngle, map, found);
            for (int i = 0; i < 3; ++i) out[i] = float(c[i]);
        }
        measureRow(map, y, solidAngle);
    }
}

void readLayout(const osg::Image& image, MapLayout layout, RadianceMap& map, Findings& found)
{
    const Source source(image);
    const auto read = [&](int x, int y, int slice, double solidAngle) {
        osg::Vec3d c = source.texel(x, y, slice);
        sanitise(c, Texel{x, y, slice, source.hasSlices()}, solidAngle, map, found);
        return c;
    };
    map.image = convertToLatlong(layout, image.s(), image.t(), read);
    map.width = map.image->s();
    map.height = map.image->t();
    for (int y = 0; y < map.height; ++y) measureRow(map, y, glsl::latlongTexelSolidAngle(y, glsl::vec2(map.width, map.height)));
}

osg::ref_ptr<RadianceMap> convert(const osg::Image& image, MapLayout layout, Findings& found)
{
    osg::ref_ptr<RadianceMap> map = new RadianceMap;
    if (layout == MapLayout::LATLONG) {
        map->width = image.s();
        map->height = image.t();
        map->image = new osg::Image;
        map->image->allocateImage(map->width, map->height, 1, GL_RGB, GL_FLOAT);
        readLatlong(image, *map, found);
    } else {
        readLayout(image, layout, *map, found);
    }
    map->image->setFileName(image.getFileName());
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

// Each plugin has its own words for such a file, none of them that it is empty.
bool isEmptyFile(const std::string& name, const osgDB::Options* options)
{
    const std::string path = osgDB::findDataFile(name, options);
    if (path.empty() || osgDB::fileType(path) != osgDB::REGULAR_FILE) return false;
    osgDB::ifstream in(path.c_str(), std::ios::binary | std::ios::ate);
    return in && in.tellg() == std::streampos(0);
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

// Of a DDS or KTX file's header: whether it is a cube map. OSG's readers give one of its faces, or nothing.
bool isCubeMap(const std::string& path, const std::string& extension)
{
    unsigned char header[140] = {};
    osgDB::ifstream in(path.c_str(), std::ios::binary);
    in.read(reinterpret_cast<char*>(header), sizeof(header));
    if (extension == "dds") {
        const bool extended = std::equal(header + 84, header + 88, "DX10");
        return (header[113] & 0x02) || (extended && (header[136] & 0x04));  // DDSCAPS2_CUBEMAP, MISC_TEXTURECUBE
    }
    return header[52] == 6 || header[55] == 6;  // numberOfFaces, in either order of the bytes
}

osg::ref_ptr<osg::Image> readTexture(const std::string& name, const osgDB::Options* options, std::string& error)
{
    const std::string extension = osgDB::getLowerCaseFileExtension(name);
    const bool isDds = extension == "dds";
    if ((isDds || extension == "ktx") && isCubeMap(osgDB::findDataFile(name, options), extension)) {
        error = "a cube map, of which OpenSceneGraph's " + extension +
                " plugin does not read the six faces; store them as a strip or cross, or as six slices";
        return nullptr;
    }
    osgDB::ReaderWriter::ReadResult result = osgDB::Registry::instance()->readImage(name, options);
    if (!result.validImage()) {
        error = readMessage(result, name);
        return nullptr;
    }
    // The plugin leaves DDS's first row, the top one, first, without saying so, or turns all slices over.
    const bool flipped = options && options->getOptionString().find("dds_flip") != std::string::npos;
    osg::ref_ptr<osg::Image> image = result.getImage();
    if (isDds && !flipped) image->setOrigin(osg::Image::TOP_LEFT);
    if (isDds && flipped && image->r() > 1) {
        image = new osg::Image(*image, osg::CopyOp::DEEP_COPY_ALL);  // it may be in osgDB's cache
        image->flipVertical();
    }
    return image;
}

osg::ref_ptr<osg::Image> readAny(const std::string& name, const osgDB::Options* options, std::string& error)
{
    if (isBuiltin(name)) return createBuiltinMap(name);
    const std::string extension = osgDB::getLowerCaseFileExtension(name);
    if (extension == "hdr" || extension == "pic") return readHdr(name, options, error);
    return readTexture(name, options, error);
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
      _layout(other._layout),
      _strict(other._strict),
      _lights(other._lights),
      _lightFile(other._lightFile)
{
}

bool EnvironmentMap::load(const std::string& name, const osgDB::Options* options, std::string& error)
{
    if (!isBuiltin(name) && isEmptyFile(name, options)) {
        error = "environment map '" + name + "' is empty (0 bytes)";
        return false;
    }
    std::string reason;
    osg::ref_ptr<osg::Image> image = readAny(name, options, reason);
    if (!image) {
        error = "environment map '" + name + "': " + (reason.empty() ? "can't be read" : reason);
        return false;
    }
    MapLayout layout = isBuiltin(name) ? MapLayout::LATLONG : _layout;
    reason = shapeError(*image, layout);
    if (!reason.empty()) {
        error = "environment map '" + name + "' " + reason;
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

void EnvironmentMap::setLights(const std::shared_ptr<const LightList>& lights)
{
    _lights = lights;
    _lightFile.clear();
}

bool EnvironmentMap::loadLights(const std::string& name, const osgDB::Options* options, std::string& error)
{
    const std::string path = osgDB::findDataFile(name, options);
    if (path.empty() || osgDB::fileType(path) != osgDB::REGULAR_FILE) {
        error = "lights '" + name + "': " + (path.empty() ? "no such file" : "not a file");
        return false;
    }
    LightFile file;
    if (!readLightFile(path, file, error)) return false;
    auto lights = std::make_shared<LightList>(file.lights);
    for (const DominantLight& sun : file.suns) lights->push_back({sun.direction, sun.flux});
    _lights = lights;
    _lightFile = path;
    return true;
}

MapState MapState::copy() const
{
    MapState own = *this;
    if (image) own.image = new osg::Image(*image, osg::CopyOp::DEEP_COPY_ALL);
    return own;
}

osg::ref_ptr<const RadianceMap> MapState::read(std::string& error) const
{
    const osg::ref_ptr<const osg::Image> source = image ? image : osg::ref_ptr<const osg::Image>(createBuiltinMap("sky"));
    MapLayout resolved = image ? layout : MapLayout::LATLONG;
    error = shapeError(*source, resolved);
    if (!error.empty()) {
        error = describe(*source) + " " + error;
        return nullptr;
    }
    Findings found;
    osg::ref_ptr<RadianceMap> map = convert(*source, resolved, found);
    if (map->notFinite == 0 && map->negativeShare <= negativeTolerance) return map;
    map->repairs = describe(*source) + ":";
    if (map->notFinite > 0)
        map->repairs +=
            " " + std::to_string(map->notFinite) + " texels are not finite, the first is " + found.firstNotFinite + ";";
    if (map->negativeShare > negativeTolerance)
        map->repairs += " " + std::to_string(map->negative) + " texels are negative (" + percent(map->negativeShare) +
                        " of the flux), the first is " + found.firstNegative + ";";
    if (strict) {
        error = map->repairs + " refused, because strict is on";
        return nullptr;
    }
    map->repairs += " set to 0";
    return map;
}

MapState EnvironmentMap::state() const
{
    return {_image, _image ? _image->getModifiedCount() : 0, isBuiltin(_map) ? MapLayout::LATLONG : _layout, _strict};
}

osg::ref_ptr<const RadianceMap> EnvironmentMap::radiance(std::string& error) const
{
    std::lock_guard<std::mutex> lock(_mutex);
    const MapState now = state();
    if ((!_radiance && _error.empty()) || now != _madeFrom) {
        _madeFrom = now;
        _radiance = now.read(_error);
        if (_radiance && !_radiance->repairs.empty()) OSG_WARN << "osgEnvLight: " << _radiance->repairs << std::endl;
    }
    error = _error;
    return _radiance;
}

}  // namespace osgEnvLight

// SPDX-License-Identifier: MIT
#include "passes/AreaTables.h"

#include "base/Limits.h"
#include "gl/TargetTexture.h"
#include "surface/EmitterTree.h"

#include <algorithm>
#include <utility>

#include "glsl.h"

namespace osgEnvLight
{

namespace
{

// u and v; of a polygon two vectors whose cross product is its area along its normal.
std::pair<osg::Vec3d, osg::Vec3d> axesOf(const Emitter& light)
{
    if (light.shape != AreaLight::POLYGON) return {light.u, light.v};
    const auto shorter = [](const osg::Vec3d& a, const osg::Vec3d& b) { return a.length2() < b.length2(); };
    const osg::Vec3d& u = *std::max_element(light.vertices.begin(), light.vertices.end(), shorter);
    return {u, (light.normal ^ u) * (light.area / u.length2())};
}

osg::ref_ptr<osg::Image> floatImage(size_t columns, size_t rows)
{
    osg::ref_ptr<osg::Image> image = new osg::Image;
    image->allocateImage(int(columns), int(rows), 1, GL_RGBA, GL_FLOAT);
    image->setInternalTextureFormat(GL_RGBA32F_ARB);
    std::fill_n(image->data(), image->getTotalSizeInBytes(), static_cast<unsigned char>(0));
    return image;
}

// Groups of rows, each of so many texels above each other, that hold so many.
size_t rowsOf(size_t count, size_t columns, size_t texels)
{
    return (count + columns - 1) / columns * texels;
}

// Where texel `row` of an entry is.
struct EntryWriter {
    osg::Image& image;
    unsigned texels;
    size_t entry;

    void operator()(unsigned row, const osg::Vec3d& rgb, double alpha) const
    {
        const auto columns = size_t(image.s());
        writeTexel(image, unsigned(entry % columns), unsigned(entry / columns) * texels + row, rgb, alpha);
    }
};

}  // namespace

bool showsPicture(const Emitter& light)
{
    return light.picture.valid();
}

osg::ref_ptr<osg::Image> areaLightImage(const std::vector<Emitter>& lights, const osg::Vec3d& origin)
{
    size_t vertices = 0;
    for (const Emitter& light : lights) vertices += light.vertices.size();
    const size_t columns = std::min<size_t>(lights.size(), limits::LIGHT_COLUMNS);
    const size_t rows = rowsOf(lights.size(), columns, limits::AREA_LIGHT_ROWS);
    const osg::ref_ptr<osg::Image> image = floatImage(columns, rows + rowsOf(vertices, columns, 1));
    size_t vertex = rows * columns;
    unsigned pictures = 0;
    for (size_t i = 0; i < lights.size(); ++i) {
        const Emitter& light = lights[i];
        const auto [u, v] = axesOf(light);
        const bool isPolygon = light.shape == AreaLight::POLYGON;
        const bool shows = light.picture && pictures < mostAreaPictures;
        const EntryWriter write{*image, limits::AREA_LIGHT_ROWS, i};
        write(0, light.center - origin, light.extent() * light.extent());
        write(1, light.radiance, light.shape + (light.twoSided ? 4 : 0) + 8 * int(light.vertices.size()));
        write(2, u, shows ? double(pictures++) : -1.0);
        write(3, v, isPolygon ? double(vertex) : light.pictureTurned ? -1.0 : 1.0);
        for (const osg::Vec3d& p : light.vertices) EntryWriter{*image, 1, vertex++}(0, p, 0.0);
    }
    return image;
}

// Most by which packDirection() turns a direction, as vectors.
const double packedError = 1.1e-3;

osg::ref_ptr<osg::Image> lightTreeImage(const std::vector<Emitter>& lights, const osg::Vec3d& origin)
{
    const std::vector<EmitterCluster> tree = emitterTree(lights);
    const osg::ref_ptr<osg::Image> image =
        floatImage(limits::LIGHT_COLUMNS, rowsOf(std::max<size_t>(tree.size(), 1), limits::LIGHT_COLUMNS, limits::CLUSTER_ROWS));
    for (size_t i = 0; i < tree.size(); ++i) {
        const EmitterCluster& c = tree[i];
        const EntryWriter write{*image, limits::CLUSTER_ROWS, i};
        write(0, c.place - origin, c.light < 0 ? double(c.next) : -1.0 - 2 * c.light - (c.back ? 1 : 0));
        write(1, c.reach, c.isRound ? -1.0 : c.spread + packedError);
        write(2, c.power, glsl::packDirection(glsl::vec3(c.axis[0], c.axis[1], c.axis[2])));
    }
    return image;
}

osg::ref_ptr<osg::Image> lightsWithPointsImage(const std::vector<unsigned char>& sides)
{
    osg::ref_ptr<osg::Image> image = new osg::Image;
    image->allocateImage(limits::LIGHT_COLUMNS, int(rowsOf(sides.size(), limits::LIGHT_COLUMNS, 1)), 1, GL_RED, GL_UNSIGNED_BYTE);
    image->setInternalTextureFormat(GL_R8);
    std::fill_n(image->data(), image->getTotalSizeInBytes(), static_cast<unsigned char>(0));
    for (size_t i = 0; i < sides.size(); ++i) image->data()[i] = sides[i] ? 255 : 0;
    return image;
}

osg::ref_ptr<osg::Texture2DArray> areaPictureTexture(const std::vector<Emitter>& lights)
{
    const auto shown = unsigned(std::count_if(lights.begin(), lights.end(), showsPicture));
    const unsigned count = std::min(shown, mostAreaPictures);
    osg::ref_ptr<osg::Texture2DArray> texture = new osg::Texture2DArray;
    texture->setTextureSize(int(EmitterPicture::side), int(EmitterPicture::side), int(count));
    texture->setInternalFormat(GL_RGB16F_ARB);
    texture->setSourceFormat(GL_RGB);
    texture->setSourceType(GL_FLOAT);
    texture->setFilter(osg::Texture::MIN_FILTER, osg::Texture::LINEAR_MIPMAP_LINEAR);
    texture->setFilter(osg::Texture::MAG_FILTER, osg::Texture::LINEAR);
    texture->setWrap(osg::Texture::WRAP_S, osg::Texture::CLAMP_TO_EDGE);
    texture->setWrap(osg::Texture::WRAP_T, osg::Texture::CLAMP_TO_EDGE);
    unsigned layer = 0;
    for (const Emitter& light : lights)
        if (light.picture && layer < count) texture->setImage(layer++, new osg::Image(light.picture->relative()));
    return texture;
}

}  // namespace osgEnvLight

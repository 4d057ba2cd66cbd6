// SPDX-License-Identifier: MIT
#include "surface/EmitterPicture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

#include "glsl.h"

namespace osgEnvLight
{

namespace
{

const unsigned side = EmitterPicture::side;

// The part of a pixel's width or height that lies in a cell, in cells.
struct Overlap {
    unsigned cell;
    double share;
};

// By pixel, of n that lie side by side over the grid.
std::vector<std::vector<Overlap>> overlaps(unsigned n)
{
    std::vector<std::vector<Overlap>> result(n);
    const double step = double(side) / n;
    for (unsigned i = 0; i < n; ++i) {
        const double from = i * step, to = std::min((i + 1) * step, double(side));
        for (auto cell = unsigned(from); cell < side && cell < to; ++cell) {
            const double share = std::min(to, cell + 1.0) - std::max(from, double(cell));
            if (share > 0.0) result[i].push_back({cell, share});
        }
    }
    return result;
}

// Reads rows of linear colours.
class ImageRows
{
  public:
    explicit ImageRows(const osg::Image& image) : _image(image), _encoded(isEncoded(image))
    {
        for (size_t i = 0; i < _decoded.size(); ++i) _decoded[i] = glsl::srgbDecode(double(i) / 255.0);
        const GLenum format = image.getPixelFormat();
        if (image.getDataType() != GL_UNSIGNED_BYTE) return;
        if (format == GL_RGB) _offsets = {0, 1, 2};
        if (format == GL_RGBA) _offsets = {0, 1, 2};
        if (format == GL_BGR) _offsets = {2, 1, 0};
        if (format == GL_BGRA) _offsets = {2, 1, 0};
    }

    void read(unsigned y, std::vector<osg::Vec3d>& row) const
    {
        const unsigned t = isTopFirst(_image) ? unsigned(_image.t()) - 1 - y : y;
        const unsigned char* bytes = _image.data(0, t);
        const size_t step = _image.getPixelSizeInBits() / 8;
        for (unsigned x = 0; x < row.size(); ++x, bytes += step)
            for (unsigned k = 0; k < 3; ++k) row[x][int(k)] = isBytes() ? _decoded[bytes[_offsets[k]]] : value(x, t, k);
    }

  private:
    bool isBytes() const { return _offsets[1] == 1; }

    double value(unsigned x, unsigned t, unsigned channel) const
    {
        const double v = double(_image.getColor(x, t)[channel]);
        return _encoded ? glsl::srgbDecode(v) : v;
    }

    const osg::Image& _image;
    bool _encoded;
    std::array<unsigned, 3> _offsets{};  // of red, green and blue in a pixel of bytes
    std::array<double, 256> _decoded;
};

std::string badPixel(const std::vector<osg::Vec3d>& row, unsigned y)
{
    for (size_t x = 0; x < row.size(); ++x)
        for (int k = 0; k < 3; ++k) {
            const double v = row[x][k];
            if (v >= 0.0 && std::isfinite(v)) continue;
            std::ostringstream out;
            out << "has an image whose pixel (" << x << ", " << y << "), from the lower left, is " << v << ", expected 0 or more";
            return out.str();
        }
    return {};
}

std::string unreadable(const osg::Image& image)
{
    if (!image.data() || image.s() < 1 || image.t() < 1) return "has an image without pixels";
    if (image.r() > 1) return "has an image with depth";
    if (image.isCompressed()) return "has a compressed image";
    return osg::Image::computeNumComponents(image.getPixelFormat()) < 1 ? "has an image of an unknown format" : "";
}

}  // namespace

bool isTopFirst(const osg::Image& image)
{
    return image.getOrigin() == osg::Image::TOP_LEFT;
}

bool isEncoded(const osg::Image& image)
{
    const GLenum type = image.getDataType();
    return type != GL_FLOAT && type != GL_HALF_FLOAT_ARB && type != GL_DOUBLE;
}

osg::ref_ptr<const EmitterPicture> EmitterPicture::create(const osg::Image& image, std::string& problem)
{
    problem = unreadable(image);
    if (!problem.empty()) return nullptr;
    const auto columns = overlaps(unsigned(image.s())), rows = overlaps(unsigned(image.t()));
    const ImageRows reader(image);
    std::vector<osg::Vec3d> pixels(columns.size()), row(side), cells(size_t(side) * side);
    for (unsigned y = 0; y < rows.size(); ++y) {
        reader.read(y, pixels);
        problem = badPixel(pixels, y);
        if (!problem.empty()) return nullptr;
        std::fill(row.begin(), row.end(), osg::Vec3d());
        for (size_t x = 0; x < pixels.size(); ++x)
            for (const Overlap& o : columns[x]) row[o.cell] += pixels[x] * o.share;
        for (const Overlap& o : rows[y])
            for (unsigned x = 0; x < side; ++x) cells[size_t(o.cell) * side + x] += row[x] * o.share;
    }
    const osg::ref_ptr<EmitterPicture> picture = new EmitterPicture;
    picture->sum(cells);
    return picture;
}

void EmitterPicture::sum(const std::vector<osg::Vec3d>& cells)
{
    const size_t corners = side + 1;
    _sums.resize(corners * corners);
    for (size_t y = 0; y < side; ++y) {
        osg::Vec3d row;
        for (size_t x = 0; x < side; ++x) {
            row += cells[y * side + x];
            _sums[(y + 1) * corners + x + 1] = _sums[y * corners + x + 1] + row;
        }
    }
    _mean = _sums.back() / (double(side) * side);
    _relative = new osg::Image;
    _relative->allocateImage(int(side), int(side), 1, GL_RGB, GL_FLOAT);
    _relative->setInternalTextureFormat(GL_RGB16F_ARB);
    for (size_t i = 0; i < cells.size(); ++i)
        for (int k = 0; k < 3; ++k)
            reinterpret_cast<float*>(_relative->data())[3 * i + size_t(k)] =
                _mean[k] > 0.0 ? float(cells[i][k] / _mean[k]) : 0.0f;
}

// Over what is to the left of x and below y, in cells.
osg::Vec3d EmitterPicture::integral(double x, double y) const
{
    const size_t corners = side + 1;
    const auto i = std::min(size_t(x), size_t(side) - 1), j = std::min(size_t(y), size_t(side) - 1);
    const double s = x - double(i), t = y - double(j);
    const osg::Vec3d* low = &_sums[j * corners + i];
    const osg::Vec3d* high = low + corners;
    return (low[0] * (1.0 - s) + low[1] * s) * (1.0 - t) + (high[0] * (1.0 - s) + high[1] * s) * t;
}

osg::Vec3d EmitterPicture::mean(const osg::Vec2d& center, const osg::Vec2d& half) const
{
    const auto inCells = [](double v) { return std::clamp(v, 0.0, 1.0) * side; };
    const double left = inCells(center[0] - half[0]), right = inCells(center[0] + half[0]);
    const double bottom = inCells(center[1] - half[1]), top = inCells(center[1] + half[1]);
    const double area = (right - left) * (top - bottom);
    if (!(area > 0.0)) return _mean;
    const osg::Vec3d sum = integral(right, top) - integral(left, top) - integral(right, bottom) + integral(left, bottom);
    return osg::Vec3d(std::max(sum[0], 0.0), std::max(sum[1], 0.0), std::max(sum[2], 0.0)) / area;
}

}  // namespace osgEnvLight

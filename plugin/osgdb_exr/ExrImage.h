// SPDX-License-Identifier: MIT
#pragma once

#include <istream>
#include <ostream>
#include <string>

#include <osg/Image>
#include <osg/ref_ptr>

namespace osgEnvLight
{

/** Read the first part of an OpenEXR file from `in`, which stands at its first byte; the rest of the stream is consumed.
 * Channels R G B, Y, or Y RY BY, each with or without A, of type half, float or uint, in scanlines or tiles (the full
 * resolution level). Deep data, other subsampling and other channels are refused; further channels are ignored.
 * The result is GL_FLOAT; GL_RGBA where there is A, GL_RGB or GL_LUMINANCE otherwise; row 0 is the bottom of the picture.
 * It covers the display window: pixels outside the data window are 0. Values are as in the file: float NaN and infinities
 * too. Y RY BY passes through half precision. A side is at most 65536 pixels, the image less than 2^32 bytes.
 * A chunk that is whole in itself but holds fewer pixels than the header promises (a damaged data window or channel type)
 * goes unnoticed by OpenEXR 3.1, which then gives arbitrary values for the rest.
 * On failure the result is null and `error` is one line that starts with `name` ("stream" when empty); otherwise `error`
 * is empty. Throws nothing; safe on several threads at once. Format: openexr.com, "OpenEXR File Layout". */
osg::ref_ptr<osg::Image> readExr(std::istream& in, const std::string& name, std::string& error);

/** Write `image` as a scanline OpenEXR file with ZIP compression, of type half if `half`, else float.
 * GL_RGB becomes R G B, GL_RGBA becomes R G B A, GL_LUMINANCE becomes Y; the type is GL_FLOAT, GL_HALF_FLOAT or
 * GL_UNSIGNED_BYTE (as value / 255: no transfer curve is undone). Half turns magnitudes from 65520 on into infinity.
 * On failure the result is false, `error` is one line, and `out` has nothing, or where `out` itself failed a part.
 * Throws nothing. */
bool writeExr(const osg::Image& image, std::ostream& out, bool half, std::string& error);

}  // namespace osgEnvLight

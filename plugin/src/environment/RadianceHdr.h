/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include <istream>
#include <string>

#include <osg/Image>
#include <osg/ref_ptr>

#include <osgEnvLight/Export>

namespace osgEnvLight
{

/** Read a Radiance picture (.hdr, .pic) from `in`, which stands at its first byte; the rest of the stream is consumed.
 * All eight orientations, flat, old and new run-length scanlines, RGBE and XYZE (converted to linear Rec.709) are read;
 * EXPOSURE and COLORCORR are divided out, so that values are the radiance the header promises; an EXPOSURE of 0, which
 * FreeImage writes where it knows none, counts as 1. A mantissa m with exponent e is m * 2^(e - 136), and zero when e is 0.
 * Values are finite; only XYZE, outside the Rec.709 gamut, makes negative ones.
 * The result is GL_RGB, GL_FLOAT, 1 to 65536 pixels a side, at most 2^28 in all; row 0 is the bottom of the picture.
 * On failure the result is null and `error` is one line that starts with `name` ("stream" when empty); otherwise `error`
 * is empty. Throws nothing. Format: G. Ward, "Real Pixels", Graphics Gems II, and Radiance's filefmts.pdf. */
OSGENVLIGHT_EXPORT osg::ref_ptr<osg::Image> readRadianceHdr(std::istream& in, const std::string& name, std::string& error);

}  // namespace osgEnvLight

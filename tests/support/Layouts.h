// SPDX-License-Identifier: MIT
// Environment images in every layout, from functions of the direction. The conventions are written out here a second
// time, so that MapLayout is not its own judge.
#pragma once

#include <osgEnvLight/MapLayout>

#include <array>
#include <ostream>
#include <string>
#include <vector>

#include "Maps.h"

namespace testmaths
{

struct LaidOut {
    osgEnvLight::MapLayout layout;
    int width;
    int height;
    int slices;

    const std::string& name() const { return osgEnvLight::mapLayoutNames()[size_t(layout)]; }
    bool isCube() const;
    int side() const;
};

std::ostream& operator<<(std::ostream& out, const LaidOut& l);

/** The crosses, the strip in a row and in a column, and six slices, of faces of this side. */
std::vector<LaidOut> cubeLayouts(int side);
/** The angular map, the mirror ball and the octahedral square. */
std::vector<LaidOut> squareLayouts(int side);

/** Direction of the centre of texel (x, y), y from the top. False where the layout has nothing. */
bool texelDirection(const LaidOut& l, int x, int y, int slice, glsl::vec3& direction);

/** RGB float; two dimensional images with row 0 at the bottom, faces with row 0 at the top. Where the layout has nothing,
 * the value outside.*/
osg::ref_ptr<osg::Image> makeImage(const LaidOut& l, const Radiance& radiance, float outside = 0.0f);

/** The three floats of texel (x, y), y from the top, of such an image. */
float* texelOf(osg::Image& image, int x, int y, int slice);

}  // namespace testmaths

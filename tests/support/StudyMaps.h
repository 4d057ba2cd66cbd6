// SPDX-License-Identifier: MIT
// The maps on which light lists are judged: four synthetic kinds, and the eight real ones that Debian's blender-data
// carries, where it is installed.
#pragma once

#include <string>

#include "Maps.h"

namespace testmaths
{

struct StudyMap {
    std::string name;
    bool real;
    osg::ref_ptr<osg::Image> image;
};

/** overcast, sun and sky, six windows, checker. */
std::vector<StudyMap> syntheticMaps(int width);

/** city courtyard forest interior night studio sunrise sunset, each texel the mean of a block of the file's 1024x512 (by
 * solid angle); none where blender-data is not installed. Needs the exr plugin on OSG's path.*/
std::vector<StudyMap> realMaps(int width);

std::vector<StudyMap> allMaps(int width);

/** The map turned: about the vertical by whole columns, then tilted about the horizontal by an angle [radians], by area
 * averages of 3 x 3 look-ups a texel.*/
osg::ref_ptr<osg::Image> turned(const osg::Image& image, double azimuth, double tilt);

}  // namespace testmaths

// SPDX-License-Identifier: MIT
// Pictures for the tests of what measures them.
#pragma once

#include <metrics/Picture>

#include <functional>

namespace testmaths
{

using PixelColour = std::function<osg::Vec3d(int x, int y)>;

/** Coverage 1 everywhere. */
inline osgEnvLight::Picture makePicture(int width, int height, const PixelColour& colour)
{
    osgEnvLight::Picture picture(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const osg::Vec3d c = colour(x, y);
            for (int k = 0; k < 3; ++k) picture.at(x, y)[k] = float(c[k]);
            picture.at(x, y)[3] = 1.0f;
        }
    return picture;
}

inline osgEnvLight::Picture makePicture(int width, int height, double red, double green, double blue)
{
    return makePicture(width, height, [=](int, int) { return osg::Vec3d(red, green, blue); });
}

inline osgEnvLight::Picture makePicture(int width, int height, double grey)
{
    return makePicture(width, height, grey, grey, grey);
}

}  // namespace testmaths

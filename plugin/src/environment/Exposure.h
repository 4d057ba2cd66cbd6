/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include <osgEnvLight/EnvironmentMap>

namespace osgEnvLight
{

/** Irradiance over pi that the whole map gives surfaces [radiance], of its brightest channel: what white ones send on. */
struct OSGENVLIGHT_EXPORT Radiosity {
    double mean = 0.0;      // over all orientations
    double greatest = 0.0;  // turned to the brightest side; from cells of 5.6 degrees, within 1 %
    static Radiosity of(const RadianceMap& map);
};

/** The exposure [stops] that a picture under the map begins with: white is shown at .63 where it receives the geometric mean
 * of both. At full light that is .63 under an even sky, .8 to 1.1 under most maps and 1.26 under a sun alone, so that an albedo
 * of .8 stays below the display's white everywhere. From the map alone, so that it does not change with what the picture
 * shows; not from the map's intensity, so that this still dims. 0 for a black map.*/
OSGENVLIGHT_EXPORT double mapExposure(const RadianceMap& map);

}  // namespace osgEnvLight

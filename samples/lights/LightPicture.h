// SPDX-License-Identifier: MIT
#pragma once

#include <osgEnvLight/EnvironmentMap>
#include <osgEnvLight/LightFile>

/** The map as a latitude-longitude picture, exposed by its own brightness, with its lights drawn on it: each a disc on the
 * sphere of its own colour, whose area grows with its flux, and the lines halfway between neighbours; suns as magenta circles of
 * their true size in a wider ring.
 * @param rotation  of the map, counter-clockwise about +Z [degrees]
 * @param file      directions as they are seen after that */
osg::ref_ptr<osg::Image> lightPicture(const osgEnvLight::RadianceMap& map, double rotation, const osgEnvLight::LightFile& file);

// SPDX-License-Identifier: MIT
#pragma once

#include <osg/Image>

#include <string>

/** Write the image through osgDB, in the format that the name ends with. Throws std::runtime_error that names the file. */
void writeImageFile(const osg::Image& image, const std::string& name);

/** The same under another name until all of it is there: a file of this name is complete, whoever reads it meanwhile. */
void writeWholeImageFile(const osg::Image& image, const std::string& name);

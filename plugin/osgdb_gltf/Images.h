// SPDX-License-Identifier: MIT
#pragma once

#include "Asset.h"

#include <osg/Image>

namespace osgEnvLight::gltf
{

/** The images of a file, each decoded once. PNG and JPEG, 8 bits a channel, by stb_image: it takes the numbers as they are, which
 * glTF asks for, where OSG's PNG reader applies gamma. Row 0 is the top of the picture, as glTF's texture coordinates count. */
class Images
{
  public:
    explicit Images(const Asset& asset) : _asset(asset), _images(asset.views.size()) {}

    osg::Image* image(int index);

  private:
    const Asset& _asset;
    std::vector<osg::ref_ptr<osg::Image>> _images;
};

}  // namespace osgEnvLight::gltf

/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include <osgEnvLight/Export>

#include <osg/Image>
#include <osg/Referenced>
#include <osg/Vec2d>
#include <osg/Vec3d>

#include <string>
#include <vector>

namespace osgEnvLight
{

/** What an image sends as a light: its linear colours, averaged over a square grid. Coordinates are OpenGL's: (0, 0) is the lower
 * left corner, (1, 1) the upper right one. It shows the image as it was when it was made, and never changes. */
class OSGENVLIGHT_EXPORT EmitterPicture : public osg::Referenced
{
  public:
    static constexpr unsigned side = 256;  // cells

    /** Images of floats are linear, others sRGB encoded.
     * @return  null if the image can't send light
     * @param problem  receives why, as a sentence's end ("has a compressed image") */
    static osg::ref_ptr<const EmitterPicture> create(const osg::Image& image, std::string& problem);

    /** Of the whole image. */
    const osg::Vec3d& mean() const { return _mean; }
    /** Over a rectangle, cut off at the image's border. */
    osg::Vec3d mean(const osg::Vec2d& center, const osg::Vec2d& half) const;
    /** The grid's colours over the mean, RGB 32F, lower row first; 0 where the mean is. */
    const osg::Image& relative() const { return *_relative; }

  protected:
    ~EmitterPicture() override = default;

  private:
    EmitterPicture() = default;
    void sum(const std::vector<osg::Vec3d>& cells);
    osg::Vec3d integral(double x, double y) const;

    osg::Vec3d _mean;
    osg::ref_ptr<osg::Image> _relative;
    std::vector<osg::Vec3d> _sums;  // of the cells to the left of a corner and below it; a corner more each way
};

/** Whether the first row of the image is its top one. */
bool isTopFirst(const osg::Image& image);
/** Whether its colours are sRGB encoded: those of all but floats are. */
OSGENVLIGHT_EXPORT bool isEncoded(const osg::Image& image);

}  // namespace osgEnvLight

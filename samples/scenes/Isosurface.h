// SPDX-License-Identifier: MIT
// A mesh of the surface where a field is zero: naive surface nets (Gibson 1998), drawn onto the surface by Newton steps.
#pragma once

#include "Mesh.h"

#include <osg/BoundingBox>

namespace scenes
{

using Field = std::function<double(const osg::Vec3d&)>;

/// The field is negative inside, and positive on the faces of the bounds. Cells are cubes of the given size.
Mesh isosurface(const Field& field, const osg::BoundingBoxd& bounds, double cell);

/// min and max with their crease rounded over about `radius`.
double smoothMin(double a, double b, double radius);
double smoothMax(double a, double b, double radius);

}  // namespace scenes

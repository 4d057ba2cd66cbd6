// SPDX-License-Identifier: MIT
#include "lights/SolidAngles.h"

#include <cmath>

#include "glsl.h"

namespace osgEnvLight
{

std::vector<double> solidAngles(const LightList& lights)
{
    const int points = 8192;
    std::vector<float> x, y, z;
    std::vector<size_t> index;
    for (size_t i = 0; i < lights.size(); ++i) {
        const osg::Vec3d& flux = lights[i].flux;
        if (!(sumOf(flux) > 0.0)) continue;
        x.push_back(float(lights[i].direction.x()));
        y.push_back(float(lights[i].direction.y()));
        z.push_back(float(lights[i].direction.z()));
        index.push_back(i);
    }
    std::vector<double> angles(lights.size(), 0.0);
    for (int k = 0; k < points && !index.empty(); ++k) {
        const double height = 1.0 - (2.0 * k + 1.0) / points;
        const double around = 2.39996322972865332 * k;
        const double radius = std::sqrt(1.0 - height * height);
        const float px = float(radius * std::cos(around)), py = float(radius * std::sin(around)), pz = float(height);
        size_t nearest = 0;
        float best = -2.0f;
        for (size_t i = 0; i < index.size(); ++i) {
            const float cosine = x[i] * px + y[i] * py + z[i] * pz;
            if (cosine > best) {
                best = cosine;
                nearest = i;
            }
        }
        angles[index[nearest]] += 4.0 * glsl::PI / points;
    }
    return angles;
}

}  // namespace osgEnvLight

// SPDX-License-Identifier: MIT
#include "lights/IrradianceMap.h"

#include "gl/TargetTexture.h"

#include <algorithm>
#include <vector>

#include "glsl.h"

namespace osgEnvLight
{

namespace
{

// The normal at the middle of a texel; beyond an edge of the octahedral square lies the same edge, turned round.
glsl::vec3 normalAt(int x, int y, int side)
{
    glsl::vec2 st((x + 0.5) / side, (y + 0.5) / side);
    if (st.x < 0.0 || st.x > 1.0) st = glsl::vec2(st.x < 0.0 ? -st.x : 2.0 - st.x, 1.0 - st.y);
    if (st.y < 0.0 || st.y > 1.0) st = glsl::vec2(1.0 - st.x, st.y < 0.0 ? -st.y : 2.0 - st.y);
    return glsl::directionFromOctahedral(st);
}

// In floats, channel by channel: the compiler makes vectors of it.
struct Lights {
    std::vector<float> x, y, z, flux[3];

    Lights(const LightList& list, double scale)
    {
        for (const DirectionalLight& l : list) {
            x.push_back(float(l.direction.x()));
            y.push_back(float(l.direction.y()));
            z.push_back(float(l.direction.z()));
            for (int k = 0; k < 3; ++k) flux[k].push_back(float(l.flux[k] * scale / glsl::PI));
        }
    }
};

}  // namespace

unsigned irradianceSide(size_t lights)
{
    return lights <= 64 ? 256 : 128;
}

osg::ref_ptr<osg::Texture2D> irradianceTexture(const LightList& list, double scale)
{
    const int side = int(irradianceSide(list.size()));
    osg::ref_ptr<osg::Image> image = new osg::Image;
    image->allocateImage(side + 2, side + 2, 1, GL_RGB, GL_FLOAT);
    image->setInternalTextureFormat(GL_RGB32F_ARB);
    const Lights lights(list, scale);
    std::vector<float> cosine(list.size());
    for (int y = 0; y < side + 2; ++y)
        for (int x = 0; x < side + 2; ++x) {
            const glsl::vec3 n = normalAt(x - 1, y - 1, side);
            const float nx = float(n.x), ny = float(n.y), nz = float(n.z);
            for (size_t i = 0; i < cosine.size(); ++i)
                cosine[i] = std::max(nx * lights.x[i] + ny * lights.y[i] + nz * lights.z[i], 0.0f);
            float* out = reinterpret_cast<float*>(image->data(unsigned(x), unsigned(y)));
            for (int k = 0; k < 3; ++k) {
                double sum = 0.0;
                for (size_t i = 0; i < cosine.size(); ++i) sum += double(cosine[i] * lights.flux[k][i]);
                out[k] = float(sum);
            }
        }
    osg::ref_ptr<osg::Texture2D> texture = targetTexture(side + 2, side + 2, GL_RGB32F_ARB);
    texture->setImage(image);
    texture->setFilter(osg::Texture::MIN_FILTER, osg::Texture::LINEAR);
    texture->setFilter(osg::Texture::MAG_FILTER, osg::Texture::LINEAR);
    return texture;
}

}  // namespace osgEnvLight

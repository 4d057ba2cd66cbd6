// SPDX-License-Identifier: MIT
// A card whose edges the picture smooths, and how far a moving picture is off its coverage.
#pragma once

#include <SceneRenderer.h>

#include <osgEnvLight/Material>

#include <cmath>
#include <vector>

namespace smoothed
{

using osgEnvLight::LitScene;
using osgEnvLight::Settings;

// A dark card below a slanted edge, in a scene whose map is behind it or not.
inline osg::ref_ptr<LitScene> card(int antialias, bool background)
{
    osg::ref_ptr<LitScene> lit = makeLit(constantMap(1.0).get());
    Settings& s = *lit->getSettings();
    s.output = Settings::DISPLAY;
    s.dither = false;
    s.occlusion = false;
    s.antialias = antialias;
    s.background = background ? Settings::BACKGROUND_ON : Settings::BACKGROUND_OFF;
    const double a = osg::DegreesToRadians(7.0);
    const osg::Vec3d x(std::cos(a), 0, std::sin(a)), z(-std::sin(a), 0, std::cos(a));
    const osg::ref_ptr<osg::Geode> quad = makeQuad(x * -10 - z * 20, x * 20, z * 20);
    osgEnvLight::Material::setLambert(*quad->getOrCreateStateSet(), osg::Vec3f(0.05f, 0.05f, 0.05f));
    lit->addChild(quad);
    return lit;
}

const int size = 64;

inline Picture draw(SceneRenderer& renderer, const osg::ref_ptr<LitScene>& lit, const osg::Vec4& clearColor, int frames)
{
    renderer.viewer().getCamera()->setClearColor(clearColor);
    renderer.lookAt(osg::Vec3d(0, -4, 0), osg::Vec3d(), osg::Vec3d(0, 0, 1), 40.0);
    return renderer.render(lit, frames);
}

inline Picture draw(const osg::ref_ptr<LitScene>& lit, const osg::Vec4& clearColor, int width = size, int frames = 2)
{
    SceneRenderer renderer(width, width);
    return draw(renderer, lit, clearColor, frames);
}

// Means over squares of pixels of a picture that is so many times as wide.
inline Picture shrunk(const Picture& large, int factor)
{
    Picture p(size, size);
    for (int y = 0; y < size * factor; ++y)
        for (int x = 0; x < size * factor; ++x)
            for (int k = 0; k < 4; ++k)
                p.rgba[size_t(4 * (y / factor * size + x / factor) + k)] +=
                    large.rgba[size_t(4 * (y * size * factor + x) + k)] / float(factor * factor);
    return p;
}

// Root mean squares of a motion's errors beside its coverage, and of how much these change from frame to frame.
struct MovingErrors {
    double error, change;
};

inline MovingErrors errorsOf(const std::vector<Picture>& shown, const std::vector<Picture>& truth)
{
    const auto frames = double(shown.size());
    double squares = 0.0, variances = 0.0;
    for (size_t i = 0; i < shown[0].rgba.size(); ++i) {
        double sum = 0.0, sum2 = 0.0;
        for (size_t k = 0; k < shown.size(); ++k) {
            const double d = double(shown[k].rgba[i]) - double(truth[k].rgba[i]);
            sum += d / frames;
            sum2 += d * d / frames;
        }
        squares += sum2;
        variances += sum2 - sum * sum;
    }
    return {std::sqrt(squares), std::sqrt(variances)};
}

}  // namespace smoothed

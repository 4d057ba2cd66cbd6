// SPDX-License-Identifier: MIT
// A card whose edges the picture smooths.
#pragma once

#include <MovingPictures.h>
#include <SceneRenderer.h>

#include <osgEnvLight/Material>

#include <cmath>
#include <functional>
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

// Before each frame of a motion.
using Step = std::function<void(SceneRenderer& renderer, int frame)>;

// Of the last frames of a motion, beside means of 8 x 8 samples a pixel.
// begin  puts what there is beside the card into a scene
// check  is called after each frame
inline MovingErrors errorsOfMotion(int antialias, const std::function<Step(LitScene&)>& begin,
                                   const std::function<void(const LitScene&, int frame)>& check = {})
{
    const int before = 12, judged = 4;
    const auto move = [&](int kind, int factor) {
        const osg::ref_ptr<LitScene> lit = card(kind, true);
        const Step step = begin(*lit);
        SceneRenderer renderer(size * factor, size * factor);
        std::vector<Picture> all;
        for (int i = 0; i < before + judged; ++i) {
            step(renderer, i);
            const Picture picture = renderer.render(lit, 1);
            if (check) check(*lit, i);
            if (i >= before) all.push_back(shrunk(picture, factor));
        }
        return all;
    };
    return errorsOf(move(antialias, 1), move(Settings::ANTIALIAS_OFF, 8));
}

}  // namespace smoothed

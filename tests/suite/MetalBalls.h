// SPDX-License-Identifier: MIT
// Seven metal balls in a ring, the scene by which S is judged, and the pixels that count.
#pragma once

#include "TracedView.h"

#include <metrics/Mask>
#include <osgEnvLight/Material>

#include <cmath>

/** Balls of radius .6 on a floor 12 wide. */
inline void addMetalBalls(osg::Group& group, const osg::Vec3f& color, float roughness)
{
    group.addChild(makeQuad(osg::Vec3d(-6, -6, 0), osg::Vec3d(12, 0, 0), osg::Vec3d(0, 12, 0)));
    for (int i = 0; i < 7; ++i) {
        const double angle = 2.0 * osg::PI * i / 6.0, r = i == 6 ? 0.0 : 1.45;
        const osg::ref_ptr<osg::Geode> ball = makeSphere(osg::Vec3d(r * std::cos(angle), r * std::sin(angle), 0.6), 0.6, 96);
        osgEnvLight::Material::setCookTorrance(*ball->getOrCreateStateSet(), color, 1.0f, roughness);
        group.addChild(ball);
    }
}

inline void lookAtMetalBalls(SceneRenderer& renderer)
{
    renderer.lookAt(osg::Vec3d(0.6, -6.2, 3.2), osg::Vec3d(0, 0, 0.5), osg::Vec3d(0, 0, 1), 34.0);
}

/** S of the scene with and without what blocks it, at the middle of pixels, and what glossyPixels() needs. */
inline osgEnvLight::ReferenceResult tracedSpecular(osgEnvLight::LitScene& lit, SceneRenderer& renderer, unsigned samples)
{
    using osgEnvLight::Layer;
    return tracedView(lit, renderer, samples,
                      {Layer::SPECULAR, Layer::SPECULAR_VISIBLE, Layer::NORMAL, Layer::DEPTH, Layer::BEAUTY}, false);
}

/** Pixels that reflect the map, without edges. */
inline osgEnvLight::Mask glossyPixels(const osgEnvLight::ReferenceResult& truth)
{
    using osgEnvLight::Layer;
    Picture glossy = truth.mean(Layer::SPECULAR), surface = truth.mean(Layer::NORMAL);
    for (size_t i = 0; i < glossy.pixels(); ++i) {
        glossy.rgba[4 * i + 3] = glossy.rgba[4 * i] + glossy.rgba[4 * i + 1] > 0.0f ? 1.0f : 0.0f;
        surface.rgba[4 * i + 3] = truth.mean(Layer::BEAUTY).rgba[4 * i + 3];
    }
    return osgEnvLight::withoutEdges(osgEnvLight::Mask::geometry(glossy), surface, truth.mean(Layer::DEPTH));
}

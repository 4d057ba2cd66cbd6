// SPDX-License-Identifier: MIT
// What larger shadow maps of osg::LightSource buy. Four balls over a floor of 8 x 8 are lit by a point light, a spot or a
// directional light. Beside the closed form it prints the tRMSE of the floor in %, and the share of its pixels that are off by
// more than a tenth. Then it prints milliseconds of a frame with these shadows, of one without, and of the first frame, and
// megabytes of textures.
//   envlight_scenelight_study [--size WIDTHxHEIGHT]
#include <osgEnvLight/Material>

#include <osg/LightSource>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <iostream>
#include <vector>

#include "SceneRenderer.h"

using osgEnvLight::LitScene;
using osgEnvLight::Material;
using osgEnvLight::Settings;

namespace
{

const osg::Vec3d balls[] = {{-1.5, 0.5, 0.6}, {0.2, -0.8, 0.5}, {1.4, 1.2, 0.8}, {0.1, 1.9, 1.4}};
const double radii[] = {0.5, 0.1, 0.7, 0.25};
const osg::Vec3d lamp(-0.8, -1.2, 3.0), sun(-0.4, -0.5, 0.77), axis(0.25, 0.35, -0.9);
const double cutoff = 45.0;
const osg::Vec3d eye(0, -7, 5);

enum Kind { POINT, SPOT, DIRECTIONAL };

osg::ref_ptr<LitScene> makeScene(Kind kind)
{
    osg::ref_ptr<LitScene> lit = makeLit(constantMap(0.0).get());
    lit->getSettings()->bounce = Settings::BOUNCE_OFF;
    lit->getSettings()->regeneration = Settings::IMMEDIATE;
    lit->addChild(makeQuad(osg::Vec3d(-4, -4, 0), osg::Vec3d(8, 0, 0), osg::Vec3d(0, 8, 0)));
    for (int i = 0; i < 4; ++i) lit->addChild(makeSphere(balls[i], radii[i], 256));
    Material::setLambert(*lit->getOrCreateStateSet(), osg::Vec3f(1, 1, 1));
    const osg::ref_ptr<osg::LightSource> source = new osg::LightSource;
    osg::Light& light = *source->getLight();
    light.setLightNum(1);
    light.setDiffuse(osg::Vec4(1, 1, 1, 1));
    light.setPosition(kind == DIRECTIONAL ? osg::Vec4(osg::Vec3(sun), 0) : osg::Vec4(osg::Vec3(lamp), 1));
    light.setDirection(osg::Vec3(axis));
    if (kind == SPOT) light.setSpotCutoff(float(cutoff));
    lit->addChild(source);
    lit->getOrCreateStateSet()->setMode(GL_LIGHT1, osg::StateAttribute::ON);
    return lit;
}

// Of the floor at a point; negative where a ball is before it.
double exactAt(Kind kind, const osg::Vec3d& on)
{
    osg::Vec3d view = eye - on, to = kind == DIRECTIONAL ? sun : lamp - on, cone = axis;
    view.normalize();
    to.normalize();
    cone.normalize();
    bool isDark = kind == SPOT && -(to * cone) < std::cos(osg::DegreesToRadians(cutoff));
    for (int i = 0; i < 4; ++i) {
        if (((balls[i] - on) ^ view).length() < radii[i] * 1.02) return -1.0;
        isDark = isDark || ((balls[i] - on) ^ to).length() < radii[i];
    }
    return isDark ? 0.0 : to[2];
}

struct Figures {
    double error = 0.0;  // tRMSE, %
    double wrong = 0.0;  // share of the floor's pixels, %
};

Figures figuresOf(const Picture& p, Kind kind, const osg::Matrixd& worldFromClip)
{
    double sum = 0.0, squares = 0.0;
    int count = 0, wrong = 0;
    for (int y = 0; y < p.height; ++y)
        for (int x = 0; x < p.width; ++x) {
            const osg::Vec3d ndc(2.0 * (x + 0.5) / p.width - 1.0, 2.0 * (y + 0.5) / p.height - 1.0, 0.5);
            const osg::Vec3d ray = ndc * worldFromClip - eye;
            const osg::Vec3d on = eye - ray * (eye[2] / ray[2]);
            if (!(ray[2] < 0.0) || std::max(std::abs(on[0]), std::abs(on[1])) > 3.98) continue;
            const double exact = exactAt(kind, on);
            if (exact < 0.0) continue;
            const double difference = p.color(x, y)[1] - exact;
            ++count;
            sum += exact;
            squares += difference * difference;
            wrong += std::abs(difference) > 0.1;
        }
    return {100.0 * std::sqrt(squares / count) / (sum / count), 100.0 * wrong / count};
}

double median(std::vector<double> values)
{
    std::nth_element(values.begin(), values.begin() + std::ptrdiff_t(values.size() / 2), values.end());
    return values[values.size() / 2];
}

}  // namespace

int main(int argc, char** argv)
{
    int width = 512, height = 512;
    if (argc == 3 && !std::strcmp(argv[1], "--size") && std::sscanf(argv[2], "%dx%d", &width, &height) == 2) {
    } else if (argc != 1) {
        std::cerr << "usage: envlight_scenelight_study [--size WIDTHxHEIGHT]\n";
        return 2;
    }
    std::printf("%dx%d\n%-12s%8s%9s%9s%9s%9s%9s%9s\n", width, height, "light", "texels", "tRMSE %", "wrong %", "ms", "ms off",
                "first ms", "MB");
    const char* names[] = {"point", "spot", "directional"};
    for (const Kind kind : {POINT, SPOT, DIRECTIONAL})
        for (const int size : {64, 128, 256, 512, 1024, 2048}) {
            const osg::ref_ptr<LitScene> lit = makeScene(kind);
            lit->getSettings()->sceneLightMapSize = size;
            SceneRenderer renderer(width, height);
            renderer.lookAt(eye, osg::Vec3d(0, 0, 0.3), osg::Vec3d(0, 0, 1), 60.0);
            const Picture p = renderer.render(lit.get(), 2);
            const osg::Camera& camera = *renderer.viewer().getCamera();
            const Figures f = figuresOf(p, kind, osg::Matrixd::inverse(camera.getViewMatrix() * camera.getProjectionMatrix()));
            const double bytes = double(lit->textureBytes());
            const double first = renderer.time(lit.get(), 1)[0];
            std::vector<double> with, without;  // in turns, so that both meet the same machine
            for (int i = 0; i < 5; ++i) {
                lit->getSettings()->sceneLightShadows = true;
                with.push_back(renderer.time(lit.get(), 3).back());
                lit->getSettings()->sceneLightShadows = false;
                without.push_back(renderer.time(lit.get(), 3).back());
            }
            std::printf("%-12s%8d%9.2f%9.2f%9.1f%9.1f%9.1f%9.1f\n", names[kind], size, f.error, f.wrong, median(with),
                        median(without), first, bytes / 1e6);
        }
    return 0;
}

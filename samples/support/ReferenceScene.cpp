// SPDX-License-Identifier: MIT
#include "ReferenceScene.h"

#include "environment/Exposure.h"

#include <metrics/Display>

#include <osgUtil/UpdateVisitor>
#include <osgViewer/View>

#include <cmath>
#include <stdexcept>

#include "glsl.h"

namespace
{

// As the passes take at most.
const unsigned maximumSuns = 8;

osg::ref_ptr<const osgEnvLight::RadianceMap> radianceOf(const osgEnvLight::LitScene& lit)
{
    std::string error;
    osg::ref_ptr<const osgEnvLight::RadianceMap> map = lit.getEnvironmentMap()->radiance(error);
    if (!map) throw std::runtime_error(error);
    return map;
}

// The exposure that a picture has before the setting's stops.
double baseStops(const osgEnvLight::LitScene& lit)
{
    const bool follows = lit.getSettings()->exposureBase != osgEnvLight::Settings::EXPOSURE_NONE;
    return follows ? osgEnvLight::mapExposure(*radianceOf(lit)) : 0.0;
}

// As pass/meter.frag, from all pixels and the diffuse layer alone.
double adaptedStops(const osgEnvLight::Picture& picture, const osgEnvLight::Picture& albedo, double base)
{
    glsl::vec2 sums(0.0);
    for (int y = 0; y < picture.height; ++y)
        for (int x = 0; x < picture.width; ++x) {
            const float* sent = picture.at(x, y);
            const float* reflected = albedo.at(x, y);
            sums += glsl::meteredLight(glsl::luminance(glsl::vec3(sent[0], sent[1], sent[2])),
                                       glsl::luminance(glsl::vec3(reflected[0], reflected[1], reflected[2])));
        }
    return sums.x > 0.0 ? glsl::meteredStops(sums, base) : 0.0;
}

}  // namespace

ReferenceScene::ReferenceScene(osgEnvLight::LitScene& lit, const SceneOptions& options) : _lit(lit)
{
    // A host's camera with the state that a host gives it. A whole Viewer would ask for a graphics context at its end.
    const osg::ref_ptr<osgViewer::View> view = new osgViewer::View;
    osg::Camera& camera = *view->getCamera();
    camera.setViewport(0, 0, options.width, options.height);
    options.setCamera(lit, camera);
    // The instants of envlight-render's two frames.
    osg::ref_ptr<osg::FrameStamp> frame = new osg::FrameStamp;
    osgUtil::UpdateVisitor update;
    for (unsigned i = 0; i < 2; ++i) {
        frame->setFrameNumber(i);
        frame->setReferenceTime(i / 30.0);
        frame->setSimulationTime(i / 30.0);
        update.setFrameStamp(frame);
        update.setTraversalNumber(i);
        lit.accept(update);
    }
    const osgEnvLight::Settings& settings = *lit.getSettings();
    osgEnvLight::SceneReading reading;
    reading.linearColors = settings.materialColors == osgEnvLight::Settings::COLORS_LINEAR;
    if (!reading.linearColors && settings.output == osgEnvLight::Settings::DISPLAY)
        reading.emissionScale = std::exp2(-baseStops(lit));
    reading.sceneLights = settings.sceneLights != osgEnvLight::Settings::SCENE_LIGHTS_OFF;
    if (settings.emissiveMeshes) reading.leastLamp = radianceOf(lit)->mean * lit.getEnvironmentMap()->getIntensity();
    _triangles = osgEnvLight::flattenScene(lit, camera, frame, reading);
    if (settings.ground != osgEnvLight::Settings::GROUND_OFF)
        _triangles.leftOut.push_back("the setting ground: nothing is below the scene but the map");
    _rays = std::make_unique<osgEnvLight::RayScene>(_triangles);
    _camera = std::make_unique<osgEnvLight::RayCamera>(camera, lit.getBound());
    const osgEnvLight::EnvironmentMap& map = *lit.getEnvironmentMap();
    _environment = std::make_unique<osgEnvLight::MapEnvironment>(*radianceOf(lit), map.getRotation(), map.getIntensity());
    makeReference();
}

void ReferenceScene::makeReference()
{
    _reference = std::make_unique<osgEnvLight::Reference>(*_rays, *_camera, *_environment);
}

void ReferenceScene::keepSuns()
{
    const osgEnvLight::EnvironmentMap& map = *_lit.getEnvironmentMap();
    const osgEnvLight::SunSplit split = osgEnvLight::splitSuns(*radianceOf(_lit), maximumSuns);
    _environment = std::make_unique<osgEnvLight::SunEnvironment>(split.suns, map.getRotation(), map.getIntensity());
    _triangles.emitters.clear();
    _triangles.pointLights.clear();
    makeReference();
}

void ReferenceScene::setLights(const osgEnvLight::LightFile& file)
{
    const osgEnvLight::EnvironmentMap& map = *_lit.getEnvironmentMap();
    const osg::Matrixd worldFromMap = osg::Matrixd::rotate(osg::DegreesToRadians(map.getRotation()), 0, 0, 1);
    auto add = [&](const osg::Vec3d& direction, const osg::Vec3d& flux) {
        _lights.push_back({osg::Matrixd::transform3x3(direction, worldFromMap), flux * map.getIntensity()});
    };
    for (const auto& light : file.lights) add(light.direction, light.flux);
    for (const auto& sun : file.suns) add(sun.direction, sun.flux);
    _reference->setLights(&_lights);
}

void ReferenceScene::encodeNormal(float* normal) const
{
    const double angle = osg::DegreesToRadians(_lit.getEnvironmentMap()->getRotation());
    const osg::Vec3d n = osg::Vec3f(normal[0], normal[1], normal[2]);
    const osg::Vec3d inMap = osg::Matrixd::transform3x3(n, osg::Matrixd::rotate(-angle, 0, 0, 1));
    for (int k = 0; k < 3; ++k) normal[k] = float(0.5 * inMap[k] + 0.5);
}

bool ReferenceScene::adapts() const
{
    return _lit.getSettings()->exposureBase == osgEnvLight::Settings::EXPOSURE_PICTURE;
}

osg::ref_ptr<osg::Image> ReferenceScene::displayed(const osgEnvLight::Picture& picture, const osgEnvLight::Picture* albedo) const
{
    const osgEnvLight::Settings& s = *_lit.getSettings();
    const double base = baseStops(_lit);
    const double stops = double(s.exposure) + base + (albedo ? adaptedStops(picture, *albedo, base) : 0.0);
    osgEnvLight::Picture encoded = picture;
    for (int y = 0; y < picture.height; ++y)
        for (int x = 0; x < picture.width; ++x) {
            const osg::Vec3d color = picture.color(x, y) * std::exp2(stops);
            glsl::vec3 c = glsl::max(glsl::vec3(color.x(), color.y(), color.z()), 0.0);
            if (s.toneCurve == osgEnvLight::Settings::REINHARD) c = glsl::toneReinhard(c);
            if (s.toneCurve == osgEnvLight::Settings::NEUTRAL) c = glsl::toneNeutral(c);
            if (s.toneCurve == osgEnvLight::Settings::SHOULDER) c = glsl::toneShoulder(c);
            c = glsl::srgbEncode3(glsl::clamp(c, 0.0, 1.0));
            for (int k = 0; k < 3; ++k) encoded.at(x, y)[k] = float(c[k]);
        }
    return osgEnvLight::eightBit(encoded);
}

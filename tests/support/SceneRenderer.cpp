// SPDX-License-Identifier: MIT
#include "SceneRenderer.h"

#include "gl/TargetTexture.h"

#include <osg/Geometry>

#include <algorithm>
#include <chrono>
#include <cmath>

double rootMeanSquare(const Picture& a, const Picture& b)
{
    double sum = 0.0;
    for (int y = 0; y < a.height; ++y)
        for (int x = 0; x < a.width; ++x) sum += (a.color(x, y) - b.color(x, y)).length2();
    return std::sqrt(sum / (3.0 * a.width * a.height));
}

double largestDifference(const Picture& a, const Picture& b)
{
    double largest = 0.0;
    for (size_t i = 0; i < a.rgba.size(); ++i) largest = std::max(largest, double(std::abs(a.rgba[i] - b.rgba[i])));
    return largest;
}

SceneRenderer::SceneRenderer(int width, int height) : _width(width), _height(height)
{
    _viewer.setThreadingModel(osgViewer::ViewerBase::SingleThreaded);
    _viewer.setUseConfigureAffinity(false);  // else this process would run on one processor
    _window = _viewer.setUpViewerAsEmbeddedInWindow(0, 0, width, height);
    osg::Camera& camera = *_viewer.getCamera();
    camera.setClearColor(osg::Vec4(0, 0, 0, 0));
    camera.setRenderTargetImplementation(osg::Camera::FRAME_BUFFER_OBJECT);
    attachImage(width, height);
    _window->getState()->setCheckForGLErrors(osg::State::ONCE_PER_ATTRIBUTE);
    lookAt(osg::Vec3d(0, -4, 0), osg::Vec3d());
}

void SceneRenderer::attachImage(int width, int height)
{
    _image = new osg::Image;
    _image->allocateImage(width, height, 1, GL_RGBA, GL_FLOAT);
    _image->setInternalTextureFormat(GL_RGBA32F_ARB);
    _viewer.getCamera()->detach(osg::Camera::COLOR_BUFFER);
    _viewer.getCamera()->attach(osg::Camera::COLOR_BUFFER, _image.get());
    _viewer.getCamera()->dirtyAttachmentMap();
}

void SceneRenderer::lookAt(const osg::Vec3d& eye, const osg::Vec3d& target, const osg::Vec3d& up, double fovy)
{
    _viewer.getCamera()->setProjectionMatrixAsPerspective(fovy, double(_width) / _height, 1.0, 10000.0);
    _viewer.getCamera()->setViewMatrixAsLookAt(eye, target, up);
}

osg::Vec2d SceneRenderer::pixelOf(const osg::Vec3d& point) const
{
    const osg::Camera& camera = *_viewer.getCamera();
    const osg::Vec3d window = point * camera.getViewMatrix() * camera.getProjectionMatrix() * osg::Matrixd::translate(1, 1, 1) *
                              osg::Matrixd::scale(0.5 * _width, 0.5 * _height, 0.5);
    return osg::Vec2d(window.x(), window.y());
}

Picture SceneRenderer::render(osg::Node* scene, int frames)
{
    if (_viewer.getSceneData() != scene) _viewer.setSceneData(scene);
    const osg::Viewport& viewport = *_viewer.getCamera()->getViewport();
    const int width = int(viewport.width());
    const int height = int(viewport.height());
    const bool empty = width < 1 || height < 1;  // OSG itself crashes on an image of no pixels
    if (!empty && (width != _image->s() || height != _image->t())) attachImage(width, height);
    for (int i = 0; i < frames; ++i) _viewer.frame(_time += 1.0 / 30.0);
    Picture picture(width, height);
    const float* p = reinterpret_cast<const float*>(_image->data());
    if (!empty) std::copy_n(p, picture.rgba.size(), picture.rgba.begin());
    return picture;
}

std::vector<double> SceneRenderer::time(osg::Node* scene, int frames)
{
    if (_image) {
        _image = nullptr;
        _window->getState()->setCheckForGLErrors(osg::State::NEVER_CHECK_GL_ERRORS);
        _viewer.getCamera()->detach(osg::Camera::COLOR_BUFFER);
        _viewer.getCamera()->attach(osg::Camera::COLOR_BUFFER, osgEnvLight::targetTexture(_width, _height, GL_RGBA8).get());
        _viewer.getCamera()->dirtyAttachmentMap();
    }
    if (_viewer.getSceneData() != scene) _viewer.setSceneData(scene);
    std::vector<double> milliseconds;
    for (int i = 0; i < frames; ++i) {
        const auto start = std::chrono::steady_clock::now();
        _viewer.frame(_time += 1.0 / 30.0);
        glFinish();
        milliseconds.push_back(std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());
    }
    return milliseconds;
}

Statistics ofGeometry(const Picture& picture)
{
    Statistics s;
    for (int y = 0; y < picture.height; ++y)
        for (int x = 0; x < picture.width; ++x) {
            if (!(picture.alpha(x, y) > 0.5f)) continue;
            for (int k = 0; k < 3; ++k) {
                const double v = picture.color(x, y)[k];
                s.least = std::min(s.least, v);
                s.most = std::max(s.most, v);
                s.mean += v;
            }
            ++s.pixels;
        }
    s.mean /= 3.0 * std::max(s.pixels, 1);
    return s;
}

osg::ref_ptr<osg::Image> constantMap(double radiance)
{
    return makeMap(64, 32, [&](const osg::Vec3d&) { return osg::Vec3d(radiance, radiance, radiance); });
}

osg::ref_ptr<osg::Image> lopsidedMap(const osg::Vec3d& sky, const osg::Vec3d& lobe)
{
    return makeMap(64, 32, [&](const osg::Vec3d& d) {
        return sky + lobe * std::pow(std::max(d * osg::Vec3d(0.6, -0.64, 0.48), 0.0), 12.0);
    });
}

osg::Vec3d sixDirectionColor(const osg::Vec3d& d)
{
    const double x = std::abs(d.x());
    const double y = std::abs(d.y());
    const double z = std::abs(d.z());
    if (x >= y && x >= z) return d.x() > 0 ? osg::Vec3d(1, 0, 0) : osg::Vec3d(0, 1, 1);
    if (y >= z) return d.y() > 0 ? osg::Vec3d(0, 1, 0) : osg::Vec3d(1, 0, 1);
    return d.z() > 0 ? osg::Vec3d(0, 0, 1) : osg::Vec3d(1, 1, 0);
}

namespace
{

osg::ref_ptr<osg::Geode> makeGeode(osg::Vec3Array* vertices, osg::Vec3Array* normals, osg::DrawElementsUInt* triangles)
{
    osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
    geometry->setUseDisplayList(false);
    geometry->setUseVertexBufferObjects(true);
    geometry->setVertexArray(vertices);
    geometry->setNormalArray(normals, osg::Array::BIND_PER_VERTEX);
    geometry->addPrimitiveSet(triangles);
    osg::ref_ptr<osg::Geode> geode = new osg::Geode;
    geode->addDrawable(geometry);
    geode->getOrCreateStateSet();
    return geode;
}

void addQuad(osg::Vec3Array& vertices, osg::Vec3Array& normals, osg::DrawElementsUInt& triangles, const osg::Vec3d& corner,
             const osg::Vec3d& a, const osg::Vec3d& b)
{
    osg::Vec3d n = a ^ b;
    n.normalize();
    const unsigned base = unsigned(vertices.size());
    for (const osg::Vec3d& v : {corner, corner + a, corner + a + b, corner + b}) {
        vertices.push_back(v);
        normals.push_back(n);
    }
    for (unsigned i : {0u, 1u, 2u, 0u, 2u, 3u}) triangles.push_back(base + i);
}

}  // namespace

osg::ref_ptr<osg::Geode> makeSphere(const osg::Vec3d& center, double radius, int segments)
{
    osg::ref_ptr<osg::Vec3Array> vertices = new osg::Vec3Array;
    osg::ref_ptr<osg::Vec3Array> normals = new osg::Vec3Array;
    osg::ref_ptr<osg::DrawElementsUInt> triangles = new osg::DrawElementsUInt(GL_TRIANGLES);
    const int rows = segments / 2;
    for (int j = 0; j <= rows; ++j)
        for (int i = 0; i <= segments; ++i) {
            const double theta = osg::PI * j / rows;
            const double phi = 2.0 * osg::PI * i / segments;
            const osg::Vec3d n(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta));
            vertices->push_back(center + n * radius);
            normals->push_back(n);
        }
    for (int j = 0; j < rows; ++j)
        for (int i = 0; i < segments; ++i) {
            const unsigned a = unsigned(j * (segments + 1) + i);
            const unsigned b = a + unsigned(segments) + 1;
            for (unsigned k : {a, b, b + 1, a, b + 1, a + 1}) triangles->push_back(k);
        }
    return makeGeode(vertices.get(), normals.get(), triangles.get());
}

osg::ref_ptr<osg::Geode> makeQuad(const osg::Vec3d& corner, const osg::Vec3d& a, const osg::Vec3d& b)
{
    osg::ref_ptr<osg::Vec3Array> vertices = new osg::Vec3Array;
    osg::ref_ptr<osg::Vec3Array> normals = new osg::Vec3Array;
    osg::ref_ptr<osg::DrawElementsUInt> triangles = new osg::DrawElementsUInt(GL_TRIANGLES);
    addQuad(*vertices, *normals, *triangles, corner, a, b);
    return makeGeode(vertices.get(), normals.get(), triangles.get());
}

osg::ref_ptr<osg::Geode> makeBox(const osg::Vec3d& low, const osg::Vec3d& high)
{
    osg::ref_ptr<osg::Vec3Array> vertices = new osg::Vec3Array;
    osg::ref_ptr<osg::Vec3Array> normals = new osg::Vec3Array;
    osg::ref_ptr<osg::DrawElementsUInt> triangles = new osg::DrawElementsUInt(GL_TRIANGLES);
    const osg::Vec3d d = high - low;
    const osg::Vec3d x(d.x(), 0, 0);
    const osg::Vec3d y(0, d.y(), 0);
    const osg::Vec3d z(0, 0, d.z());
    addQuad(*vertices, *normals, *triangles, low, y, x);
    addQuad(*vertices, *normals, *triangles, low + z, x, y);
    addQuad(*vertices, *normals, *triangles, low, x, z);
    addQuad(*vertices, *normals, *triangles, low + y, z, x);
    addQuad(*vertices, *normals, *triangles, low, z, y);
    addQuad(*vertices, *normals, *triangles, low + x, y, z);
    return makeGeode(vertices.get(), normals.get(), triangles.get());
}

osg::ref_ptr<osgEnvLight::LitScene> makeLit(osg::Image* map)
{
    osg::ref_ptr<osgEnvLight::LitScene> lit = new osgEnvLight::LitScene(map);
    lit->getSettings()->output = osgEnvLight::Settings::LINEAR;
    lit->getSettings()->bounce = osgEnvLight::Settings::BOUNCE_MEAN;
    return lit;
}

class NotifyCatcher::Handler : public osg::NotifyHandler
{
  public:
    void notify(osg::NotifySeverity severity, const char* message) override
    {
        if (severity <= osg::NOTICE) text += message;
    }
    std::string text;
};

NotifyCatcher::NotifyCatcher() : _former(osg::getNotifyHandler()), _handler(new Handler)
{
    osg::setNotifyHandler(_handler.get());
}

NotifyCatcher::~NotifyCatcher()
{
    osg::setNotifyHandler(_former.get());
}

const std::string& NotifyCatcher::text() const
{
    return _handler->text;
}

void NotifyCatcher::clear()
{
    _handler->text.clear();
}

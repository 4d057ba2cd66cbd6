// SPDX-License-Identifier: MIT
#include <osgEnvLight/AreaLight>

#include <osgEnvLight/Material>
#include "surface/AreaLightPlace.h"
#include "surface/Axes.h"
#include "surface/EmitterMesh.h"
#include "surface/EmitterPicture.h"
#include "surface/MaterialMaps.h"

#include <osg/CullFace>
#include <osg/FrontFace>
#include <osg/Transform>
#include <osgUtil/CullVisitor>

#include <cmath>

#include "glsl.h"

namespace osgEnvLight
{

namespace
{

// A surface that reflects nothing.
osg::ref_ptr<osg::StateSet> blackState(bool bothSides)
{
    osg::ref_ptr<osg::StateSet> stateSet = new osg::StateSet;
    Material::setLambert(*stateSet, osg::Vec3f());
    stateSet->setAttribute(new osg::CullFace(osg::CullFace::BACK));
    stateSet->setMode(GL_CULL_FACE, bothSides ? osg::StateAttribute::OFF : osg::StateAttribute::ON);
    return stateSet;
}

// A copy whose colours are encoded: maps of emission are.
osg::ref_ptr<osg::Image> encoded(const osg::Image& image)
{
    osg::ref_ptr<osg::Image> copy = new osg::Image;
    copy->allocateImage(image.s(), image.t(), 1, GL_RGB, GL_FLOAT);
    copy->setInternalTextureFormat(GL_RGB16F_ARB);
    float* out = reinterpret_cast<float*>(copy->data());
    for (unsigned y = 0; y < unsigned(image.t()); ++y)
        for (unsigned x = 0; x < unsigned(image.s()); ++x)
            for (unsigned k = 0; k < 3; ++k) *out++ = float(glsl::srgbEncode(double(image.getColor(x, y)[k])));
    return copy;
}

}  // namespace

AreaLight::AreaLight() : _u(0.5, 0, 0), _v(0, 0.5, 0), _emission(1, 1, 1), _place(new AreaLightPlace(this))
{
    setCullingActive(false);  // it lights what is in the view from without
}

AreaLight::AreaLight(const AreaLight& other, const osg::CopyOp& copyop)
    : osg::Node(other, copyop),
      _shape(other._shape),
      _center(other._center),
      _u(other._u),
      _v(other._v),
      _vertices(static_cast<osg::Vec3Array*>(copyop(other._vertices.get()))),
      _quantity(other._quantity),
      _emission(other._emission),
      _image(static_cast<osg::Image*>(copyop(other._image.get()))),
      _twoSided(other._twoSided),
      _visible(other._visible),
      _place(new AreaLightPlace(this))
{
    setCullingActive(false);
    if (_image && _image->requiresUpdateCall()) setNumChildrenRequiringUpdateTraversal(1);
}

AreaLight::~AreaLight() = default;

void AreaLight::setRectangle(const osg::Vec3d& center, const osg::Vec3d& u, const osg::Vec3d& v)
{
    _shape = RECTANGLE;
    _center = center;
    _u = u;
    _v = v;
    changed();
}

void AreaLight::setDisc(const osg::Vec3d& center, const osg::Vec3d& normal, double radius)
{
    osg::Vec3d n = normal;
    n.normalize();
    _shape = DISC;
    _center = center;
    _u = besides(n) * std::abs(radius);
    _v = n ^ _u;
    changed();
}

void AreaLight::setSphere(const osg::Vec3d& center, double radius)
{
    _shape = SPHERE;
    _center = center;
    _u = osg::Vec3d(radius, 0, 0);
    _v = osg::Vec3d();
    changed();
}

void AreaLight::setPolygon(const osg::Vec3Array& vertices)
{
    _shape = POLYGON;
    setVertices(new osg::Vec3Array(vertices));
}

void AreaLight::setShape(Shape shape)
{
    _shape = shape;
    changed();
}

void AreaLight::setCenter(const osg::Vec3d& center)
{
    _center = center;
    changed();
}

void AreaLight::setU(const osg::Vec3d& u)
{
    _u = u;
    changed();
}

void AreaLight::setV(const osg::Vec3d& v)
{
    _v = v;
    changed();
}

void AreaLight::setVertices(osg::Vec3Array* vertices)
{
    _vertices = vertices;
    changed();
}

void AreaLight::setEmission(Quantity quantity, const osg::Vec3f& emission)
{
    _quantity = quantity;
    _emission = emission;
}

void AreaLight::setImage(osg::Image* image)
{
    const bool updated = _image && _image->requiresUpdateCall(), updates = image && image->requiresUpdateCall();
    if (updated != updates)
        setNumChildrenRequiringUpdateTraversal(updates ? getNumChildrenRequiringUpdateTraversal() + 1
                                                       : getNumChildrenRequiringUpdateTraversal() - 1);
    {
        const std::lock_guard<std::mutex> lock(_pictureMutex);
        _image = image;
        _picture = nullptr;
        _pictureProblem.clear();
    }
    changed();
}

// Made anew when the image has changed.
osg::ref_ptr<const EmitterPicture> AreaLight::picture(std::string& problem) const
{
    const std::lock_guard<std::mutex> lock(_pictureMutex);
    if (!_image) return nullptr;
    const bool made = _picture || !_pictureProblem.empty();
    if (!made || _pictureChanges != _image->getModifiedCount()) {
        _pictureChanges = _image->getModifiedCount();
        _picture = EmitterPicture::create(*_image, _pictureProblem);
    }
    problem = _pictureProblem;
    return _picture;
}

void AreaLight::setTwoSided(bool on)
{
    _twoSided = on;
    changed();
}

void AreaLight::changed()
{
    const std::lock_guard<std::mutex> lock(_mutex);
    _surfaceMade = false;
    _surface = Surface();  // a draw traversal that still draws the old one holds it
    _texture = nullptr;
    dirtyBound();
}

void AreaLight::traverse(osg::NodeVisitor& nv)
{
    osgUtil::CullVisitor* cv = nv.asCullVisitor();
    if (cv && cv->getCurrentRenderBin() && cv->getModelViewMatrix()) cv->addPositionedAttribute(cv->getModelViewMatrix(), _place);
    if (nv.getVisitorType() == osg::NodeVisitor::UPDATE_VISITOR && _image && _image->requiresUpdateCall()) _image->update(&nv);
    if (!_visible) return;
    if (cv) return draw(*cv);
    const Surface made = surface();
    if (made.lit) made.lit->accept(nv);
    if (made.back) made.back->accept(nv);
}

void AreaLight::draw(osgUtil::CullVisitor& cv)
{
    const Surface made = surface();
    if (!made.lit) return;
    osg::Vec3f radiance = _emission;
    if (_quantity == FLUX || _image) {
        Emitter placed;
        if (!placeEmitter(*this, osg::computeLocalToWorld(cv.getNodePath()), placed).empty()) return;
        radiance = osg::Vec3f(placed.picture ? placed.tint : placed.radiance);
    }
    const bool mirrored = mirrors(*cv.getModelViewMatrix());
    for (osg::Geometry* side : {made.lit.get(), made.back.get()}) {
        if (!side) continue;
        const bool lit = side == made.lit;
        const osg::ref_ptr<osg::StateSet> state = drawState(lit ? radiance : osg::Vec3f(), mirrored, lit);
        cv.pushStateSet(state);
        side->accept(cv);
        cv.popStateSet();
    }
}

AreaLight::Surface AreaLight::surface()
{
    const std::lock_guard<std::mutex> lock(_mutex);
    if (_surfaceMade) return _surface;
    _surfaceMade = true;
    Emitter own;
    if (!placeEmitter(*this, osg::Matrixd(), own).empty()) return _surface;
    _surface.lit = makeEmitterMesh(own);
    _surface.lit->setStateSet(blackState(own.twoSided));
    if (own.shape != SPHERE && !own.twoSided) {
        _surface.back = makeEmitterBack(own);
        _surface.back->setStateSet(blackState(false));
    }
    for (osg::Geometry* side : {_surface.lit.get(), _surface.back.get()}) {
        if (!side) continue;
        side->setUserData(_place);
        side->setName(getName());
    }
    return _surface;
}

// An image of floats is copied whenever it changes.
osg::ref_ptr<osg::Texture2D> AreaLight::texture()
{
    if (!_image || _shape != RECTANGLE) return nullptr;
    if (_texture && (isEncoded(*_image) || _textureChanges == _image->getModifiedCount())) return _texture;
    _textureChanges = _image->getModifiedCount();
    _texture = new osg::Texture2D(isEncoded(*_image) ? _image : encoded(*_image));
    _texture->setResizeNonPowerOfTwoHint(false);
    _texture->setWrap(osg::Texture::WRAP_S, osg::Texture::CLAMP_TO_EDGE);
    _texture->setWrap(osg::Texture::WRAP_T, osg::Texture::CLAMP_TO_EDGE);
    return _texture;
}

// They are made, not changed: a draw traversal may still use the ones before.
osg::ref_ptr<osg::StateSet> AreaLight::drawState(const osg::Vec3f& radiance, bool mirrored, bool shows)
{
    const std::lock_guard<std::mutex> lock(_mutex);
    const osg::ref_ptr<osg::Texture2D> shown = shows ? texture() : nullptr;
    for (const DrawState& state : _drawStates)
        if (state.radiance == radiance && state.mirrored == mirrored && state.texture == shown) return state.stateSet;
    const size_t kept = 8;  // of a light whose radiance changes all the time
    if (_drawStates.size() == kept) _drawStates.erase(_drawStates.begin());
    osg::ref_ptr<osg::StateSet> stateSet = new osg::StateSet;
    stateSet->addUniform(new osg::Uniform(MaterialMaps::light, radiance));
    stateSet->setAttribute(new osg::FrontFace(mirrored ? osg::FrontFace::CLOCKWISE : osg::FrontFace::COUNTER_CLOCKWISE));
    if (shown) {
        Material::setEmissionMap(*stateSet, shown);
        if (isTopFirst(*_image))
            stateSet->addUniform(new osg::Uniform((std::string(MaterialMaps::emissionMap) + "Transform").c_str(),
                                                  osg::Matrix3(1, 0, 0, 0, -1, 0, 0, 1, 1)));
    }
    _drawStates.push_back({radiance, mirrored, shown, stateSet});
    return stateSet;
}

osg::BoundingSphere AreaLight::computeBound() const
{
    Emitter own;
    if (!placeEmitter(*this, osg::Matrixd(), own).empty()) return {};
    return osg::BoundingSphere(own.center, float(own.extent()));
}

void AreaLight::resizeGLObjectBuffers(unsigned maximum)
{
    osg::Node::resizeGLObjectBuffers(maximum);
    const std::lock_guard<std::mutex> lock(_mutex);
    if (_surface.lit) _surface.lit->resizeGLObjectBuffers(maximum);
    if (_surface.back) _surface.back->resizeGLObjectBuffers(maximum);
    for (const DrawState& state : _drawStates) state.stateSet->resizeGLObjectBuffers(maximum);
}

void AreaLight::releaseGLObjects(osg::State* state) const
{
    osg::Node::releaseGLObjects(state);
    const std::lock_guard<std::mutex> lock(_mutex);
    if (_surface.lit) _surface.lit->releaseGLObjects(state);
    if (_surface.back) _surface.back->releaseGLObjects(state);
    for (const DrawState& drawn : _drawStates) drawn.stateSet->releaseGLObjects(state);
}

}  // namespace osgEnvLight

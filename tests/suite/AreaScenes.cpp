// SPDX-License-Identifier: MIT
#include "AreaScenes.h"

#include <osgEnvLight/AreaLight>
#include <osgEnvLight/Material>

#include <osg/MatrixTransform>

#include <cmath>
#include <stdexcept>

using osgEnvLight::AreaLight;
using osgEnvLight::LitScene;
using osgEnvLight::Material;
using osgEnvLight::Settings;

namespace suite
{

const char* const areaScenes[8] = {"table", "room", "grille", "strips", "many", "city", "stripes", "screen"};

namespace
{

using osg::Vec3d;

// A box by its middle, turned about z.
osg::ref_ptr<osg::Node> turnedBox(const Vec3d& middle, const Vec3d& size, double angle = 0.0)
{
    osg::ref_ptr<osg::MatrixTransform> place =
        new osg::MatrixTransform(osg::Matrixd::rotate(angle, Vec3d(0, 0, 1)) * osg::Matrixd::translate(middle));
    place->addChild(makeBox(-size * 0.5, size * 0.5));
    return place;
}

// A closed cylinder that stands on a point.
osg::ref_ptr<osg::Geode> pole(const Vec3d& foot, double radius, double height)
{
    const int sides = 14;
    osg::ref_ptr<osg::Vec3Array> vertices = new osg::Vec3Array, normals = new osg::Vec3Array;
    osg::ref_ptr<osg::DrawElementsUShort> triangles = new osg::DrawElementsUShort(GL_TRIANGLES);
    const auto add = [&](const Vec3d& p, const Vec3d& n) {
        vertices->push_back(foot + p);
        normals->push_back(n);
        triangles->push_back(GLushort(vertices->size() - 1));
    };
    for (int i = 0; i < sides; ++i) {
        Vec3d n[2];
        for (int k = 0; k < 2; ++k) n[k].set(std::cos(2 * osg::PI * (i + k) / sides), std::sin(2 * osg::PI * (i + k) / sides), 0);
        const Vec3d up(0, 0, height), a = n[0] * radius, b = n[1] * radius;
        const std::pair<Vec3d, Vec3d> corners[] = {{a, n[0]}, {b, n[1]},      {b + up, n[1]},
                                                   {a, n[0]}, {b + up, n[1]}, {a + up, n[0]}};
        for (const auto& [p, normal] : corners) add(p, normal);
        for (const Vec3d& p : {up, a + up, b + up}) add(p, Vec3d(0, 0, 1));
        for (const Vec3d& p : {Vec3d(), b, a}) add(p, Vec3d(0, 0, -1));
    }
    osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
    geometry->setVertexArray(vertices);
    geometry->setNormalArray(normals, osg::Array::BIND_PER_VERTEX);
    geometry->addPrimitiveSet(triangles);
    osg::ref_ptr<osg::Geode> geode = new osg::Geode;
    geode->addDrawable(geometry);
    return geode;
}

// Stripes of unlike colours and widths, dark ones between them, and a white disc.
osg::ref_ptr<osg::Image> makePicture()
{
    const int width = 160, height = 90;
    osg::ref_ptr<osg::Image> image = new osg::Image;
    image->allocateImage(width, height, 1, GL_RGB, GL_UNSIGNED_BYTE);
    const unsigned char colors[6][3] = {{255, 40, 20}, {10, 10, 10}, {30, 220, 60}, {40, 60, 255}, {10, 10, 10}, {255, 210, 60}};
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const bool disc = (x - 120) * (x - 120) + (y - 60) * (y - 60) < 400;
            const unsigned char* color = colors[x * x * 6 / (width * width)];
            for (int k = 0; k < 3; ++k) image->data(unsigned(x), unsigned(y))[k] = disc ? 255 : color[k];
        }
    return image;
}

void addLight(LitScene& lit, AreaLight::Shape shape, const Vec3d& center, const Vec3d& u, const Vec3d& v,
              const osg::Vec3f& radiance)
{
    const osg::ref_ptr<AreaLight> light = new AreaLight;
    light->setRectangle(center, u, v);
    light->setShape(shape);
    light->setRadiance(radiance);
    light->setVisible(false);
    lit.addChild(light);
}

void addFloor(LitScene& lit, double half)
{
    lit.addChild(makeQuad(Vec3d(-half, -half, 0), Vec3d(2 * half, 0, 0), Vec3d(0, 2 * half, 0)));
}

void addTable(LitScene& lit, SceneRenderer& renderer)
{
    addFloor(lit, 3);
    for (int i = 0; i < 7; ++i) {
        const double h = 0.25 + 0.18 * ((i * 5) % 7);
        lit.addChild(turnedBox(Vec3d(-1.8 + 0.6 * i, 0.15 * ((i * 3) % 4 - 1), 0.5 * h), Vec3d(0.3, 0.3, h), 0.3 * i));
    }
    addLight(lit, AreaLight::RECTANGLE, Vec3d(0.3, -0.2, 3), Vec3d(1, 0, 0), Vec3d(0, -0.5, 0), osg::Vec3f(10, 10, 10));
    renderer.lookAt(Vec3d(1.5, -4.2, 3), Vec3d(0, 0, 0.3), Vec3d(0, 0, 1), 50);
}

void addRoom(LitScene& lit, SceneRenderer& renderer)
{
    const double x = 3, y = 2.5, z = 2.8;
    lit.addChild(makeQuad(Vec3d(-x, -y, 0), Vec3d(2 * x, 0, 0), Vec3d(0, 2 * y, 0)));
    lit.addChild(makeQuad(Vec3d(-x, -y, z), Vec3d(0, 2 * y, 0), Vec3d(2 * x, 0, 0)));
    lit.addChild(makeQuad(Vec3d(-x, -y, 0), Vec3d(0, 2 * y, 0), Vec3d(0, 0, z)));
    lit.addChild(makeQuad(Vec3d(x, -y, 0), Vec3d(0, 0, z), Vec3d(0, 2 * y, 0)));
    lit.addChild(makeQuad(Vec3d(-x, y, 0), Vec3d(2 * x, 0, 0), Vec3d(0, 0, z)));
    lit.addChild(makeQuad(Vec3d(-x, -y, 0), Vec3d(0, 0, z), Vec3d(2 * x, 0, 0)));
    lit.addChild(makeBox(Vec3d(-0.9, -0.3, 0.7), Vec3d(0.7, 0.7, 0.76)));
    for (int k = 0; k < 4; ++k) {
        const double left = k & 1 ? 0.6 : -0.85, front = k & 2 ? 0.6 : -0.25;
        lit.addChild(makeBox(Vec3d(left, front, 0), Vec3d(left + 0.06, front + 0.06, 0.7)));
    }
    const std::pair<Vec3d, Vec3d> boxes[] = {{Vec3d(-0.5, 0.1, 0.76), Vec3d(-0.2, 0.4, 1.05)},
                                             {Vec3d(0.2, 0, 0.76), Vec3d(0.3, 0.1, 1.2)},
                                             {Vec3d(1.2, 1.9, 0), Vec3d(2.2, 2.5, 1.8)},
                                             {Vec3d(1.2, -1.2, 0), Vec3d(1.7, -0.7, 0.45)},
                                             {Vec3d(1.65, -1.2, 0.45), Vec3d(1.7, -0.7, 0.9)}};
    for (const auto& [low, high] : boxes) lit.addChild(makeBox(low, high));
    for (int k = 0; k < 3; ++k) lit.addChild(makeBox(Vec3d(-2.2, 2.2, 0.5 + 0.5 * k), Vec3d(-0.9, 2.5, 0.54 + 0.5 * k)));
    lit.addChild(makeSphere(Vec3d(-1.7, 1.1, 0.3), 0.3, 48));
    addLight(lit, AreaLight::RECTANGLE, Vec3d(-2.97, 0.3, 1.5), Vec3d(0, 0.9, 0), Vec3d(0, 0, 0.6), osg::Vec3f(10, 10, 10));
    renderer.lookAt(Vec3d(2.4, -2.2, 2.0), Vec3d(-0.5, 0.7, 0.7), Vec3d(0, 0, 1), 75);
}

void addGrille(LitScene& lit, SceneRenderer& renderer)
{
    addFloor(lit, 4);
    lit.addChild(makeQuad(Vec3d(-4, 2.2, 0), Vec3d(8, 0, 0), Vec3d(0, 0, 3)));
    for (int i = 0; i < 17; ++i) lit.addChild(pole(Vec3d(-1.6 + 0.2 * i, 0, 0), 0.03, 1.6));
    lit.addChild(turnedBox(Vec3d(0, 0, 1.62), Vec3d(3.4, 0.06, 0.06)));
    lit.addChild(turnedBox(Vec3d(0.9, 1.3, 0.3), Vec3d(0.5, 0.5, 0.6), 0.4));
    // Turned to the wall and a little down.
    addLight(lit, AreaLight::DISC, Vec3d(0.2, -1.8, 1.4), Vec3d(-0.5, 0, 0), Vec3d(0, 0.15, 0.477), osg::Vec3f(12, 12, 12));
    renderer.lookAt(Vec3d(-2.6, -2.6, 2.4), Vec3d(0.1, 0.8, 0.5), Vec3d(0, 0, 1), 55);
}

void addStrips(LitScene& lit, SceneRenderer& renderer)
{
    const float roughness[3] = {0.1f, 0.3f, 0.6f};
    for (int k = 0; k < 3; ++k) {
        const osg::ref_ptr<osg::Geode> strip = makeQuad(Vec3d(-3 + 2 * k, -3, 0), Vec3d(2, 0, 0), Vec3d(0, 5, 0));
        Material::setCookTorrance(*strip->getOrCreateStateSet(), osg::Vec3f(1, 1, 1), 1.0f, roughness[k]);
        lit.addChild(strip);
        lit.addChild(turnedBox(Vec3d(-2.2 + 2 * k, 0.3, 0.25), Vec3d(0.3, 0.3, 0.5), 0.5 * k));
        lit.addChild(pole(Vec3d(-1.6 + 2 * k, 0.9, 0), 0.05, 1.1));
        lit.addChild(makeSphere(Vec3d(-2.0 + 2 * k, -0.6, 0.18), 0.18, 48));
    }
    addLight(lit, AreaLight::RECTANGLE, Vec3d(0, 1.7, 0.95), Vec3d(2.4, 0, 0), Vec3d(0, 0, 0.75), osg::Vec3f(4, 4, 4));
    renderer.lookAt(Vec3d(0, -4.6, 1.9), Vec3d(0, 0.2, 0.1), Vec3d(0, 0, 1), 48);
}

void addMany(LitScene& lit, SceneRenderer& renderer)
{
    addFloor(lit, 4);
    lit.addChild(makeQuad(Vec3d(-4, 4, 0), Vec3d(8, 0, 0), Vec3d(0, 0, 3)));
    lit.addChild(makeQuad(Vec3d(-4, -4, 0), Vec3d(0, 8, 0), Vec3d(0, 0, 3)));
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
            lit.addChild(turnedBox(Vec3d(-2 + 2 * i, -2 + 2 * j, 0.5), Vec3d(0.5, 0.5, 0.4 + 0.6 * ((i + 2 * j) % 3)), 0.4 * i));
            lit.addChild(pole(Vec3d(-1 + 2 * i, -1 + 2 * j, 0), 0.09, 2.6));
        }
    for (int i = 0; i < 16; ++i) {
        const double hue = std::fmod(i * 0.618, 1.0), glow = std::fmod(i * 0.755, 1.0);
        const osg::Vec3f radiance(Vec3d(0.4 + 1.6 * hue, 0.9, 0.4 + 1.6 * (1 - hue)) * (4 + 14 * glow * glow));
        addLight(lit, AreaLight::RECTANGLE, Vec3d(-3 + 2 * (i % 4), -3 + 2 * (i / 4), 2.9), Vec3d(0.35, 0, 0), Vec3d(0, -0.2, 0),
                 radiance);
    }
    renderer.lookAt(Vec3d(3.6, -3.7, 2.3), Vec3d(-0.4, 0.3, 0.5), Vec3d(0, 0, 1), 60);
}

// 64 houses, lamps along the streets between them and signs on their walls: 832 lights, seen from where one walks.
void addCity(LitScene& lit, SceneRenderer& renderer)
{
    const int side = 8;
    const double pitch = 12, house = 7;
    lit.addChild(makeQuad(Vec3d(-10, -10, 0), Vec3d(side * pitch + 20, 0, 0), Vec3d(0, side * pitch + 20, 0)));
    const auto lamp = [&](double x, double y) {
        addLight(lit, AreaLight::DISC, Vec3d(x, y, 4), Vec3d(0.12, 0, 0), Vec3d(0, -0.12, 0), osg::Vec3f(900, 700, 400));
        lit.addChild(makeBox(Vec3d(x - 0.05, y + 0.15, 0), Vec3d(x + 0.05, y + 0.25, 4)));
    };
    for (int i = 0; i < side * side; ++i) {
        const double x = i % side * pitch, y = i / side * pitch, height = 4 + 8 * std::fmod(i * 0.618, 1.0);
        lit.addChild(makeBox(Vec3d(x, y, 0), Vec3d(x + house, y + house, height)));
        for (int k = 0; k < 3; ++k) {
            lamp(x + 1 + 3 * k, y - 1);
            lamp(x - 1, y + 2.5 + 3 * k);
        }
        for (int k = 0; k < 7; ++k) {
            const double along = 0.6 + 0.85 * k, up = 1 + 2.5 * std::fmod((i + k) * 0.755, 1.0), hue = std::fmod(k * 0.618, 1.0);
            const osg::Vec3f radiance(float(3 + 12 * hue), 4, float(15 - 12 * hue));
            if (k % 2)
                addLight(lit, AreaLight::RECTANGLE, Vec3d(x + along, y - 0.05, up), Vec3d(0.4, 0, 0), Vec3d(0, 0, 0.25),
                         radiance);
            else
                addLight(lit, AreaLight::RECTANGLE, Vec3d(x - 0.05, y + along, up), Vec3d(0, -0.4, 0), Vec3d(0, 0, 0.25),
                         radiance);
        }
    }
    renderer.lookAt(Vec3d(45.5, 20, 1.7), Vec3d(44.5, 40, 2.5), Vec3d(0, 0, 1), 60);
}

}  // namespace

osg::ref_ptr<LitScene> makeAreaScene(const std::string& name, SceneRenderer& renderer)
{
    osg::ref_ptr<LitScene> lit = makeLit(constantMap(0.0).get());
    Material::setLambert(*lit->getOrCreateStateSet(), osg::Vec3f(1, 1, 1));
    lit->getSettings()->bounce = Settings::BOUNCE_OFF;
    lit->getSettings()->regeneration = Settings::IMMEDIATE;
    if (name == "table")
        addTable(*lit, renderer);
    else if (name == "room")
        addRoom(*lit, renderer);
    else if (name == "grille")
        addGrille(*lit, renderer);
    else if (name == "strips")
        addStrips(*lit, renderer);
    else if (name == "many")
        addMany(*lit, renderer);
    else if (name == "city")
        addCity(*lit, renderer);
    else if (name == "stripes")
        addTable(*lit, renderer);
    else if (name == "screen")
        addStrips(*lit, renderer);
    else
        throw std::runtime_error("no scene of area lights is named '" + name + "'");
    if (name == "stripes" || name == "screen")
        static_cast<AreaLight&>(*lit->getChild(lit->getNumChildren() - 1)).setImage(makePicture());
    return lit;
}

AreaTruth tracedArea(LitScene& lit, SceneRenderer& renderer, unsigned samples, osgEnvLight::ReferenceOptions::Paths paths)
{
    using osgEnvLight::Layer;
    renderer.render(&lit);
    const osgEnvLight::ReferenceResult truth =
        tracedView(lit, renderer, samples, {Layer::BEAUTY, Layer::NORMAL, Layer::DEPTH}, false, paths);
    AreaTruth result;
    result.picture = truth.mean(Layer::BEAUTY);
    result.error = truth.standardError(Layer::BEAUTY);
    Picture surface = truth.mean(Layer::NORMAL);
    for (size_t i = 0; i < surface.pixels(); ++i) surface.rgba[4 * i + 3] = result.picture.rgba[4 * i + 3];
    result.mask = osgEnvLight::withoutEdges(osgEnvLight::Mask::geometry(result.picture), surface, truth.mean(Layer::DEPTH));
    return result;
}

}  // namespace suite

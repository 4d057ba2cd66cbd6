// SPDX-License-Identifier: MIT
// The suite's scenes made by code: metres, Z up.
#include "SuiteScenes.h"

#include <osgEnvLight/Material>

#include <osg/AlphaFunc>
#include <osg/Geometry>
#include <osg/Texture2D>

#include <cmath>
#include <functional>
#include <map>

namespace suite
{

using osg::Vec3d;
using osg::Vec3f;
using osgEnvLight::Material;

namespace
{

using Part = osg::ref_ptr<osg::Geode>;

Part lambert(const Part& geode, const Vec3f& diffuse)
{
    Material::setLambert(*geode->getOrCreateStateSet(), diffuse);
    return geode;
}

Part glossy(const Part& geode, const Vec3f& color, float metalness, float roughness)
{
    Material::setCookTorrance(*geode->getOrCreateStateSet(), color, metalness, roughness);
    return geode;
}

Part ground(double half, const Vec3f& diffuse = Vec3f(0.6f, 0.58f, 0.55f))
{
    return lambert(makeQuad(Vec3d(-half, -half, 0), Vec3d(2 * half, 0, 0), Vec3d(0, 2 * half, 0)), diffuse);
}

Part block(const Vec3d& low, const Vec3d& high, const Vec3f& diffuse = Vec3f(0.7f, 0.7f, 0.68f))
{
    return lambert(makeBox(low, high), diffuse);
}

void see(SuiteScene& scene, const Vec3d& eye, const Vec3d& target, double fovy = 40.0)
{
    scene.eye = eye;
    scene.target = target;
    scene.fovy = fovy;
}

void wall(SuiteScene& scene)
{
    scene.add(ground(6));
    scene.add(block(Vec3d(-3, 0, 0), Vec3d(3, 0.6, 2), Vec3f(0.7f, 0.4f, 0.3f)));
    see(scene, Vec3d(-4, -8, 5), Vec3d(0, -0.3, 0.6));
}

void post(SuiteScene& scene)
{
    scene.add(ground(5, Vec3f(0.8f, 0.8f, 0.8f)));
    scene.add(block(Vec3d(-0.3, -0.3, 0), Vec3d(0.3, 0.3, 2.5)));
    see(scene, Vec3d(0, -8, 6), Vec3d(0, 0, 0.6));
}

// A room, its window to the left of a camera that stands in it.
void room(SuiteScene& scene)
{
    const Vec3f white(0.8f, 0.8f, 0.78f);
    scene.add(block(Vec3d(-2.2, -2.2, -0.2), Vec3d(2.2, 2.2, 0), Vec3f(0.5f, 0.35f, 0.2f)));
    scene.add(block(Vec3d(-2.2, -2.2, 2.6), Vec3d(2.2, 2.2, 2.8), white));
    scene.add(block(Vec3d(-2.2, 2, 0), Vec3d(2.2, 2.2, 2.6), white));
    scene.add(block(Vec3d(-2.2, -2.2, 0), Vec3d(2.2, -2, 2.6), white));
    scene.add(block(Vec3d(2, -2, 0), Vec3d(2.2, 2, 2.6), white));
    scene.add(block(Vec3d(-2.2, -2, 0), Vec3d(-2, 2, 0.9), white));
    scene.add(block(Vec3d(-2.2, -2, 2.2), Vec3d(-2, 2, 2.6), white));
    scene.add(block(Vec3d(-2.2, -2, 0.9), Vec3d(-2, -0.6, 2.2), white));
    scene.add(block(Vec3d(-2.2, 1.4, 0.9), Vec3d(-2, 2, 2.2), white));
    scene.add(block(Vec3d(-0.9, 0.6, 0), Vec3d(0.3, 1.4, 0.75), Vec3f(0.3f, 0.4f, 0.6f)));
    see(scene, Vec3d(1.7, -1.8, 1.6), Vec3d(-0.8, 0.9, 1.0), 65.0);
}

// A room that is lit through a slot in its roof alone.
void slot(SuiteScene& scene)
{
    const Vec3f white(0.8f, 0.8f, 0.78f);
    scene.add(block(Vec3d(-2.2, -2.2, -0.2), Vec3d(2.2, 2.2, 0), Vec3f(0.5f, 0.35f, 0.2f)));
    for (double y : {-2.2, 2.0}) scene.add(block(Vec3d(-2.2, y, 0), Vec3d(2.2, y + 0.2, 2.6), white));
    for (double x : {-2.2, 2.0}) scene.add(block(Vec3d(x, -2, 0), Vec3d(x + 0.2, 2, 2.6), white));
    scene.add(block(Vec3d(-2.2, -2.2, 2.6), Vec3d(2.2, -0.2, 2.8), white));
    scene.add(block(Vec3d(-2.2, 0.2, 2.6), Vec3d(2.2, 2.2, 2.8), white));
    scene.add(block(Vec3d(-0.9, 0.6, 0), Vec3d(0.3, 1.4, 0.75), Vec3f(0.3f, 0.4f, 0.6f)));
    see(scene, Vec3d(1.7, -1.8, 1.6), Vec3d(-0.8, 0.9, 0.6), 65.0);
}

void stairs(SuiteScene& scene)
{
    scene.add(ground(8));
    for (int i = 0; i < 9; ++i)
        scene.add(block(Vec3d(-1, 0.3 * i, 0), Vec3d(1, 0.3 * (i + 1), 0.18 * (i + 1)), Vec3f(0.6f, 0.6f, 0.62f)));
    for (double x : {-1.25, 1.0}) scene.add(block(Vec3d(x, -0.5, 0), Vec3d(x + 0.25, 2.7, 2.2), Vec3f(0.75f, 0.6f, 0.45f)));
    see(scene, Vec3d(0.6, -4.5, 3), Vec3d(0, 1.0, 0.7));
}

void canopy(SuiteScene& scene)
{
    scene.add(ground(5));
    scene.add(block(Vec3d(-2, -1.2, 2.2), Vec3d(2, 1.2, 2.32)));
    for (double x : {-1.9, -0.65, 0.6, 1.85})
        for (double y : {-1.1, 1.05})
            scene.add(block(Vec3d(x, y, 0), Vec3d(x + 0.05, y + 0.05, 2.2), Vec3f(0.25f, 0.25f, 0.25f)));
    see(scene, Vec3d(-3.5, -7, 2.6), Vec3d(0, -0.2, 1.0));
}

// Leaves: discs cut from cards by their alpha.
osg::ref_ptr<osg::Texture2D> leafTexture()
{
    osg::ref_ptr<osg::Image> image = new osg::Image;
    image->allocateImage(32, 32, 1, GL_RGBA, GL_UNSIGNED_BYTE);
    for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 32; ++x) {
            const double dx = (x % 16 - 7.5) / 7.0;
            const double dy = (y % 16 - 7.5) / 5.0;
            const bool leaf = dx * dx + dy * dy < 1.0;
            unsigned char* p = image->data(unsigned(x), unsigned(y));
            p[0] = static_cast<unsigned char>(90 + 3 * (x % 16));
            p[1] = 150;
            p[2] = 60;
            p[3] = leaf ? 255 : 0;
        }
    osg::ref_ptr<osg::Texture2D> texture = new osg::Texture2D(image);
    texture->setFilter(osg::Texture::MIN_FILTER, osg::Texture::NEAREST);
    texture->setFilter(osg::Texture::MAG_FILTER, osg::Texture::NEAREST);
    return texture;
}

void foliage(SuiteScene& scene)
{
    scene.add(ground(4));
    const osg::ref_ptr<osg::Texture2D> texture = leafTexture();
    for (int i = 0; i < 24; ++i) {
        const double turn = 2.4 * i;  // the golden angle spreads them
        const double reach = 0.25 * std::sqrt(double(i));
        const Vec3d centre(reach * std::cos(turn), reach * std::sin(turn), 1.7 - 0.08 * (i % 7));
        const Vec3d across(0.55 * std::cos(1.7 * i), 0.55 * std::sin(1.7 * i), 0.15);
        const Vec3d along(-0.5 * std::sin(1.7 * i), 0.5 * std::cos(1.7 * i), 0.3 * std::sin(3.1 * i));
        const Part card = lambert(makeQuad(centre - across - along, across * 2.0, along * 2.0), Vec3f(1, 1, 1));
        osg::ref_ptr<osg::Vec2Array> st = new osg::Vec2Array;
        for (const osg::Vec2& c : {osg::Vec2(0, 0), osg::Vec2(1, 0), osg::Vec2(1, 1), osg::Vec2(0, 1)}) st->push_back(c);
        card->getDrawable(0)->asGeometry()->setTexCoordArray(0, st, osg::Array::BIND_PER_VERTEX);
        osg::StateSet& state = *card->getOrCreateStateSet();
        state.setTextureAttributeAndModes(0, texture);
        state.setAttributeAndModes(new osg::AlphaFunc(osg::AlphaFunc::GREATER, 0.5f));
        scene.add(card);
    }
    scene.add(block(Vec3d(-0.08, -0.08, 0), Vec3d(0.08, 0.08, 1.5), Vec3f(0.3f, 0.2f, 0.1f)));
    see(scene, Vec3d(-2.5, -5.5, 3.6), Vec3d(0, 0, 0.8));
}

void gloss(SuiteScene& scene)
{
    scene.add(ground(6, Vec3f(0.4f, 0.4f, 0.4f)));
    const float roughness[] = {0.1f, 0.25f, 0.45f, 0.8f};
    for (int i = 0; i < 4; ++i) {
        const double x = 1.3 * (i - 1.5);
        scene.add(glossy(makeSphere(Vec3d(x, 0.7, 0.6), 0.6, 96), Vec3f(1.0f, 0.77f, 0.34f), 1.0f, roughness[i]));
        scene.add(glossy(makeSphere(Vec3d(x, -0.7, 0.6), 0.6, 96), Vec3f(0.1f, 0.25f, 0.5f), 0.0f, roughness[i]));
    }
    const Part phong = makeSphere(Vec3d(0, -2.0, 0.4), 0.4, 96);
    Material::setPhong(*phong->getOrCreateStateSet(), Vec3f(0.4f, 0.1f, 0.1f), Vec3f(0.4f, 0.4f, 0.4f), 60.0f);
    scene.add(phong);
    see(scene, Vec3d(-1.5, -8, 4.5), Vec3d(0, -0.2, 0.4), 38.0);
}

using Curve = std::function<Vec3d(double)>;

// A closed tube about a curve of parameter 0..2 pi that is nowhere vertical.
Part tube(const Curve& curve, double radius, int columns, int rows)
{
    osg::ref_ptr<osg::Vec3Array> vertices = new osg::Vec3Array;
    osg::ref_ptr<osg::Vec3Array> normals = new osg::Vec3Array;
    osg::ref_ptr<osg::DrawElementsUInt> triangles = new osg::DrawElementsUInt(GL_TRIANGLES);
    for (int i = 0; i <= columns; ++i) {
        const double t = 2.0 * osg::PI * i / columns;
        Vec3d tangent = curve(t + 1e-4) - curve(t - 1e-4);
        tangent.normalize();
        Vec3d side = Vec3d(0, 0, 1) ^ tangent;
        side.normalize();
        const Vec3d up = tangent ^ side;
        for (int j = 0; j <= rows; ++j) {
            const double angle = 2.0 * osg::PI * j / rows;
            const Vec3d n = side * std::cos(angle) + up * std::sin(angle);
            normals->push_back(n);
            vertices->push_back(curve(t) + n * radius);
            if (i == columns || j == rows) continue;
            const unsigned a = unsigned(i * (rows + 1) + j);
            const unsigned b = a + unsigned(rows) + 1;
            for (unsigned k : {a, b + 1, b, a, a + 1, b + 1}) triangles->push_back(k);
        }
    }
    osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
    geometry->setVertexArray(vertices);
    geometry->setNormalArray(normals, osg::Array::BIND_PER_VERTEX);
    geometry->addPrimitiveSet(triangles);
    Part geode = new osg::Geode;
    geode->addDrawable(geometry);
    return geode;
}

void knot(SuiteScene& scene)
{
    scene.add(ground(5));
    const Curve trefoil = [](double t) {
        const double r = 1.0 + 0.45 * std::cos(3.0 * t);
        return Vec3d(r * std::cos(2.0 * t), r * std::sin(2.0 * t), 0.85 + 0.5 * std::sin(3.0 * t));
    };
    scene.add(glossy(tube(trefoil, 0.22, 240, 24), Vec3f(0.2f, 0.5f, 0.35f), 0.0f, 0.3f));
    see(scene, Vec3d(-2.5, -5.5, 3.6), Vec3d(0, 0, 0.6), 36.0);
}

}  // namespace

void buildScene(const std::string& name, SuiteScene& scene)
{
    static const std::map<std::string, void (*)(SuiteScene&)> builders = {
        {"wall", wall},     {"post", post},       {"room", room},   {"slot", slot}, {"stairs", stairs},
        {"canopy", canopy}, {"foliage", foliage}, {"gloss", gloss}, {"knot", knot}};
    const auto builder = builders.find(name);
    if (builder != builders.end()) builder->second(scene);
}

}  // namespace suite

// SPDX-License-Identifier: MIT
// Chessmen on a wooden board, in the middle of a game: turned, carved and polished surfaces close to each other.
#include "ChessPieces.h"
#include "Scene.h"

#include <osg/Image>
#include <osg/Texture2D>

#include <algorithm>
#include <array>
#include <cmath>

namespace scenes
{

namespace
{

constexpr double square = 0.055, squareThickness = 0.012, frameWidth = 0.035, half = 4 * square;

const std::map<std::string, Material> chessMaterials{
    {"ivory", cookTorrance({0.78, 0.67, 0.47}, 0, 0.35)},
    {"ebony", cookTorrance({0.032, 0.024, 0.02}, 0, 0.25)},
    {"gold", cookTorrance({1, 0.77, 0.34}, 1, 0.22)},
    {"silver", cookTorrance({0.95, 0.93, 0.88}, 1, 0.12)},
    {"glass", {Brdf::Phong, {0.12, 0.2, 0.18}, {0.5, 0.5, 0.5}, 600, 0, 0, 0.45}},
    {"maple", phong({0.95, 0.95, 0.95}, 0.04, 120)},
    {"walnut", phong({0.95, 0.95, 0.95}, 0.04, 120)},
    {"frame", phong({0.95, 0.95, 0.95}, 0.05, 250)},
    {"cloth", lambert({0.10, 0.16, 0.15})}};

struct Man {
    Piece piece;
    const char* place;
    const char* material;
    double turn;  // degrees about Z
};

const std::vector<Man> position{
    {Piece::King, "g1", "ivory", 80},  {Piece::Queen, "e2", "gold", 90},    {Piece::Rook, "a1", "ivory", 95},
    {Piece::Rook, "e1", "ivory", 70},  {Piece::Knight, "f3", "ivory", 118}, {Piece::Bishop, "f4", "glass", 150},
    {Piece::Pawn, "a2", "ivory", 0},   {Piece::Pawn, "b2", "ivory", 0},     {Piece::Pawn, "d4", "ivory", 0},
    {Piece::Pawn, "f2", "ivory", 0},   {Piece::Pawn, "g2", "ivory", 0},     {Piece::Pawn, "h3", "ivory", 0},
    {Piece::King, "g8", "ebony", -95}, {Piece::Queen, "d5", "silver", -60}, {Piece::Rook, "a8", "ebony", -90},
    {Piece::Rook, "f8", "ebony", -75}, {Piece::Knight, "c6", "ebony", -40}, {Piece::Bishop, "e6", "ebony", -120},
    {Piece::Pawn, "a7", "ebony", 0},   {Piece::Pawn, "b7", "ebony", 0},     {Piece::Pawn, "e5", "ebony", 0},
    {Piece::Pawn, "f7", "ebony", 0},   {Piece::Pawn, "g7", "ebony", 0},     {Piece::Pawn, "h6", "ebony", 0},
    {Piece::Knight, "b4", "gold", 35}, {Piece::Bishop, "c3", "ivory", 60}};

struct Wood {
    osg::Vec3d light, dark;  // display encoded, 0..255
    double rings;            // per texture width
    unsigned seed;
};

// Noise over a lattice of `cellsX` x `cellsY` that repeats, in [0, 1].
double noise(double x, double y, unsigned cellsX, unsigned cellsY, unsigned seed)
{
    const auto lattice = [&](unsigned i, unsigned j) {
        unsigned h = (i % cellsX) * 0x9E3779B1U ^ (j % cellsY) * 0x85EBCA77U ^ seed * 0xC2B2AE3DU;
        h = (h ^ h >> 15) * 0x2C1B3C6DU;
        h = (h ^ h >> 12) * 0x297A2D39U;
        return (h >> 8) * 0x1p-24;
    };
    const double u = x * cellsX, v = y * cellsY;
    const unsigned i = static_cast<unsigned>(u), j = static_cast<unsigned>(v);
    const double fu = u - i, fv = v - j, a = fu * fu * (3 - 2 * fu), b = fv * fv * (3 - 2 * fv);
    const double low = lattice(i, j) * (1 - a) + lattice(i + 1, j) * a;
    const double high = lattice(i, j + 1) * (1 - a) + lattice(i + 1, j + 1) * a;
    return low * (1 - b) + high * b;
}

// The grain runs along the texture's x: year rings bent by slow noise, fine fibres and short pores.
osg::Vec3d woodColour(const Wood& wood, double x, double y)
{
    const double bend = 2.2 * noise(x, y, 2, 3, wood.seed) + 0.5 * noise(x, y, 5, 9, wood.seed + 1);
    const double phase = wood.rings * y + bend, ring = phase - std::floor(phase);
    const double late = std::pow(ring, 3) * std::min(1.0, (1 - ring) * 8);
    const double fibre = noise(x, y, 10, 170, wood.seed + 2);
    const double pore = std::pow(noise(x, y, 24, 256, wood.seed + 3), 6);
    const double dark = std::clamp(0.15 + 0.5 * late + 0.35 * (fibre - 0.4) + 0.5 * pore, 0.0, 1.0);
    return wood.light * (1 - dark) + wood.dark * dark;
}

osg::ref_ptr<osg::Texture2D> woodTexture(const Wood& wood)
{
    constexpr int size = 512;
    osg::ref_ptr<osg::Image> image = new osg::Image;
    image->allocateImage(size, size, 1, GL_RGB, GL_UNSIGNED_BYTE);
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x) {
            const osg::Vec3d colour = woodColour(wood, (x + 0.5) / size, (y + 0.5) / size);
            for (int c = 0; c < 3; ++c) image->data(unsigned(x), unsigned(y))[c] = static_cast<unsigned char>(colour[c] + 0.5);
        }
    osg::ref_ptr<osg::Texture2D> texture = new osg::Texture2D(image);
    texture->setWrap(osg::Texture::WRAP_S, osg::Texture::REPEAT);
    texture->setWrap(osg::Texture::WRAP_T, osg::Texture::REPEAT);
    texture->setFilter(osg::Texture::MIN_FILTER, osg::Texture::LINEAR_MIPMAP_LINEAR);
    texture->setMaxAnisotropy(8);
    return texture;
}

// A board cut from its own place in the wood; `number` picks the place, and the grain runs along x or y.
Mesh plank(const osg::Vec3d& min, const osg::Vec3d& max, double bevel, unsigned number, bool grainAlongY)
{
    constexpr double textureWidth = 0.25;
    const osg::Vec2d offset(number * 0.381966, number * 0.618034);
    Mesh mesh = box(min, max, bevel, 2);
    mesh.setTexCoords([&](const osg::Vec3d& p) {
        const osg::Vec2d place = grainAlongY ? osg::Vec2d(p.y(), p.x() + p.z()) : osg::Vec2d(p.x(), p.y() + p.z());
        return place / textureWidth + offset;
    });
    return mesh;
}

void addSquares(Scene& scene)
{
    std::array<Mesh, 2> woods;
    for (unsigned i = 0; i < 8; ++i)
        for (unsigned j = 0; j < 8; ++j) {
            const osg::Vec3d min(i * square - half, j * square - half, -squareThickness);
            woods[(i + j) % 2].add(plank(min, min + osg::Vec3d(square, square, squareThickness), 0.0004, 8 * i + j, true));
        }
    scene.add(woods[0], "walnut");
    scene.add(woods[1], "maple");
}

void addFrame(Scene& scene)
{
    const double outer = half + frameWidth, bottom = -0.026, top = 0.003, bevel = 0.003;
    Mesh mesh;
    mesh.add(plank({-outer, -outer, bottom}, {outer, -half, top}, bevel, 1, false));
    mesh.add(plank({-outer, half, bottom}, {outer, outer, top}, bevel, 2, false));
    mesh.add(plank({-outer, -half, bottom}, {-half, half, top}, bevel, 3, true));
    mesh.add(plank({half, -half, bottom}, {outer, half, top}, bevel, 4, true));
    scene.add(mesh, "frame");
}

void addMen(Scene& scene)
{
    std::map<Piece, osg::ref_ptr<osg::Geometry>> models;
    for (const Man& man : position) {
        osg::ref_ptr<osg::Geometry>& model = models[man.piece];
        if (!model) model = chessPiece(man.piece).geometry();
        const osg::Vec3d centre((man.place[0] - 'a' + 0.5) * square - half, (man.place[1] - '1' + 0.5) * square - half, 0);
        scene.add(model, man.material,
                  osg::Matrixd::rotate(osg::DegreesToRadians(man.turn), osg::Z_AXIS) * osg::Matrixd::translate(centre));
    }
}

}  // namespace

Scene chess()
{
    Scene scene("chess", {"studio", 225, 0.6, 1}, {{-0.27, -0.5, 0.3}, {0.012, -0.03, 0.012}, 34}, chessMaterials);
    const std::vector<std::pair<std::string, Wood>> woods{{"maple", {{226, 190, 140}, {176, 128, 78}, 14, 1}},
                                                          {"walnut", {{124, 78, 50}, {58, 32, 20}, 10, 2}},
                                                          {"frame", {{92, 50, 32}, {36, 18, 12}, 12, 3}}};
    for (const auto& [name, wood] : woods) scene.stateSet(name)->setTextureAttributeAndModes(0, woodTexture(wood));
    addSquares(scene);
    addFrame(scene);
    addMen(scene);
    scene.add(box({-1.1, -1.1, -0.066}, {1.1, 1.1, -0.026}, 0.01, 2), "cloth");
    return scene;
}

}  // namespace scenes

// SPDX-License-Identifier: MIT
#include "ChessPieces.h"

#include "Isosurface.h"

#include <array>
#include <cmath>

namespace scenes
{

namespace
{

constexpr double mm = 0.001;
constexpr bool corner = true;
constexpr unsigned segments = 48, steps = 4;

// Profiles in millimetres: radius, height.
using Profile = std::vector<ProfilePoint>;

const Profile pawnProfile{{0, 0, corner},      {13.4, 0, corner},   {14.3, 0.9},         {14.5, 2.3},         {14.3, 3.7},
                          {13.4, 4.6, corner}, {12.6, 4.9, corner}, {12.8, 6},           {11.6, 8.6},         {9.3, 11.2, corner},
                          {10, 11.8},          {10.2, 12.5},        {9.8, 13.2, corner}, {8.4, 13.6, corner}, {6.6, 18},
                          {5.4, 24},           {5.1, 30},           {5.6, 33.6, corner}, {8.6, 34.4},         {9.2, 35.1},
                          {8.6, 35.8},         {5.2, 36.6, corner}, {7.2, 38.9},         {8.3, 42.2},         {8.1, 45.3},
                          {6.2, 48.6},         {3.2, 50.5},         {0, 51.1, corner}};

const Profile rookProfile{{0, 0, corner},
                          {16.9, 0, corner},
                          {17.8, 0.9},
                          {18, 2.5},
                          {17.8, 4.1},
                          {16.9, 5, corner},
                          {16, 5.4, corner},
                          {16.2, 6.8},
                          {14.8, 10},
                          {12, 13.2, corner},
                          {12.8, 13.9},
                          {13, 14.7},
                          {12.6, 15.5, corner},
                          {11.2, 16, corner},
                          {9.6, 22},
                          {8.8, 30},
                          {8.8, 38},
                          {9.6, 43.4, corner},
                          {11.6, 44},
                          {12.1, 44.8},
                          {11.6, 45.6, corner},
                          {10.4, 46, corner},
                          {11, 48.2},
                          {12.4, 50.6, corner},
                          {12.4, 54, corner},
                          {8.4, 54, corner},
                          {8.4, 52, corner},
                          {0, 52, corner}};

const Profile knightProfile{
    {0, 0, corner},       {16.9, 0, corner},    {17.8, 0.9},  {18, 2.5},          {17.8, 4.1},      {16.9, 5, corner},
    {16, 5.4, corner},    {16.2, 6.8},          {15.2, 9.6},  {13.6, 12, corner}, {14.4, 12.7},     {14.6, 13.5},
    {14.2, 14.3, corner}, {13.2, 14.8, corner}, {12.4, 15.8}, {11, 16.6, corner}, {0, 16.6, corner}};

const Profile bishopProfile{{0, 0, corner},      {16.4, 0, corner},   {17.3, 0.9},          {17.5, 2.4},         {17.3, 3.9},
                            {16.4, 4.8, corner}, {15.5, 5.2, corner}, {15.7, 6.5},          {13.9, 10},          {11, 13, corner},
                            {11.8, 13.7},        {12, 14.5},          {11.6, 15.3, corner}, {9.8, 15.8, corner}, {7.6, 23},
                            {6.1, 33},           {5.8, 42},           {6.3, 46.6, corner},  {9.8, 47.6},         {10.4, 48.4},
                            {9.8, 49.2},         {7.4, 50, corner},   {8.4, 50.6},          {8.6, 51.3},         {8, 52, corner},
                            {5.6, 52.6, corner}, {0, 54, corner}};

const Profile queenProfile{{0, 0, corner},
                           {17.9, 0, corner},
                           {18.8, 0.9},
                           {19, 2.6},
                           {18.8, 4.3},
                           {17.9, 5.2, corner},
                           {17, 5.6, corner},
                           {17.2, 7.2},
                           {15, 11.6},
                           {12, 15, corner},
                           {12.9, 15.8},
                           {13.1, 16.6},
                           {12.7, 17.4, corner},
                           {10.8, 18, corner},
                           {8.3, 27},
                           {6.8, 38},
                           {6.4, 49},
                           {6.8, 54.6, corner},
                           {10.8, 55.8},
                           {11.4, 56.7},
                           {10.8, 57.6},
                           {8, 58.4, corner},
                           {9.4, 59},
                           {9.6, 59.8},
                           {9, 60.5, corner},
                           {6.8, 61, corner},
                           {7.2, 66},
                           {8.8, 73},
                           {11.6, 79.6, corner},
                           {12, 80.6},
                           {11.4, 81.4, corner},
                           {9.6, 80.6, corner},
                           {8.6, 80.8},
                           {6, 83.2},
                           {2.6, 84.6, corner},
                           {2, 85.4, corner},
                           {0, 85.6, corner}};

const Profile kingProfile{{0, 0, corner},
                          {18.4, 0, corner},
                          {19.3, 0.9},
                          {19.5, 2.7},
                          {19.3, 4.4},
                          {18.4, 5.3, corner},
                          {17.5, 5.7, corner},
                          {17.7, 7.4},
                          {15.4, 12.2},
                          {12.3, 15.8, corner},
                          {13.2, 16.6},
                          {13.4, 17.5},
                          {13, 18.3, corner},
                          {11.1, 18.9, corner},
                          {8.6, 28},
                          {7.1, 40},
                          {6.8, 51},
                          {7.2, 57.2, corner},
                          {11.3, 58.5},
                          {11.9, 59.4},
                          {11.3, 60.3},
                          {8.4, 61.1, corner},
                          {9.9, 61.8},
                          {10.1, 62.6},
                          {9.5, 63.3, corner},
                          {7.2, 63.8, corner},
                          {7.7, 69},
                          {9.4, 76},
                          {11.3, 81, corner},
                          {11.9, 81.9},
                          {11.4, 82.8, corner},
                          {10.4, 82.9, corner},
                          {8.8, 84.8},
                          {5.6, 86.2},
                          {2.6, 86.7, corner},
                          {2.2, 87.6, corner},
                          {0, 87.8, corner}};

Mesh turned(const Profile& profile)
{
    return lathe(profile, segments, steps);
}

// One merlon of the rook: a chamfered section in (radius, height), counter-clockwise seen along its sweep, between two angles.
Mesh merlon(double centre, double halfAngle)
{
    const std::array<osg::Vec2d, 7> section{
        {{12.4, 54}, {12.4, 57.5}, {11.9, 58}, {8.9, 58}, {8.4, 57.5}, {8.4, 54}, {12.4, 54}}};
    constexpr unsigned sweep = 6;
    const auto direction = [&](unsigned i) {
        const double angle = centre + halfAngle * (2.0 * i / sweep - 1);
        return osg::Vec3d(std::cos(angle), std::sin(angle), 0);
    };
    const osg::Vec3d up(0, 0, 1);
    Mesh mesh;
    for (size_t k = 0; k + 2 < section.size(); ++k) {
        const osg::Vec2d edge = section[k + 1] - section[k];
        mesh.addGrid(sweep, 1, [&](unsigned i, unsigned j) {
            const osg::Vec2d p = section[k + j];
            return Vertex{direction(i) * p.x() + up * p.y(), direction(i) * edge.y() - up * edge.x(), {}};
        });
    }
    for (unsigned end : {0U, sweep}) {
        const osg::Vec3d across = direction(end), normal = (up ^ across) * (end == 0 ? -1 : 1);
        std::vector<unsigned> ring;
        for (size_t k = 0; k < section.size() - 1; ++k)
            ring.push_back(mesh.addVertex({across * section[k].x() + up * section[k].y(), normal, {}}));
        for (size_t k = 1; k + 1 < ring.size(); ++k)
            mesh.addTriangle(ring[0], ring[end == 0 ? k : k + 1], ring[end == 0 ? k + 1 : k]);
    }
    return mesh;
}

Mesh rook()
{
    Mesh mesh = turned(rookProfile);
    for (int i = 0; i < 6; ++i) mesh.add(merlon(i * osg::PI / 3, 0.34));
    return mesh;
}

Mesh knight()
{
    Mesh mesh = turned(knightProfile);
    mesh.add(horseHead());
    return mesh;
}

// An egg with a slanting saw cut.
Mesh mitre()
{
    const osg::Vec3d centre(0, 0, 60.5), cutEnd(1.5, 0, 61), across(0.78, 0, 0.62), along(0.62, 0, -0.78);
    const auto field = [&](const osg::Vec3d& p) {
        const osg::Vec3d q = p - centre;
        const double taper = q.z() > 0 ? 1 - 0.022 * q.z() : 1 + 0.012 * q.z();
        const double egg = (osg::Vec3d(q.x() / taper / 8.8, q.y() / taper / 8.8, q.z() / 10.5).length() - 1) * 8.8;
        const osg::Vec3d c = p - cutEnd;
        const double cut = std::max(std::abs(c * along) - 0.9, -(c * across));
        return smoothMax(egg, -cut, 0.6);
    };
    return isosurface(field, osg::BoundingBoxd(-10, -10, 49, 10, 10, 73), 0.55);
}

Mesh bishop()
{
    Mesh mesh = turned(bishopProfile);
    mesh.add(mitre());
    mesh.add(sphere(2.6, 5), osg::Vec3d(0, 0, 72.6));
    return mesh;
}

Mesh queen()
{
    constexpr int points = 9;
    Mesh mesh = turned(queenProfile);
    for (int i = 0; i < points; ++i) {
        const double angle = 2 * osg::PI * i / points;
        mesh.add(sphere(2.3, 4), osg::Vec3d(10.6 * std::cos(angle), 10.6 * std::sin(angle), 81.2));
    }
    mesh.add(sphere(3.2, 6), osg::Vec3d(0, 0, 87.6));
    return mesh;
}

Mesh king()
{
    Mesh mesh = turned(kingProfile);
    mesh.add(box({-1.5, -1.7, 86.8}, {1.5, 1.7, 96.5}, 0.6, 2));
    mesh.add(box({-1.4, -4.4, 90.2}, {1.4, 4.4, 93.4}, 0.6, 2));
    return mesh;
}

}  // namespace

Mesh chessPiece(Piece piece)
{
    constexpr std::array<Mesh (*)(), 6> makers{[] { return turned(pawnProfile); }, rook, knight, bishop, queen, king};
    Mesh inMetres;
    inMetres.add(makers[static_cast<size_t>(piece)](), osg::Matrixd::scale(mm, mm, mm));
    return inMetres;
}

}  // namespace scenes

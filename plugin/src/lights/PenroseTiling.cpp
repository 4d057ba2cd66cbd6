// SPDX-License-Identifier: MIT
#include "lights/PenroseTiling.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace osgEnvLight
{

namespace
{

const double phi = 1.6180339887498948482;
const unsigned levels = 31;
const double tilesPerCell = 4.0;
const unsigned indices = 21;  // rows and columns of the table: six Fibonacci digits give 21 numbers

// The paper's tiles a..f: two sampling tiles, which only turn into one another; two acute triangles (legs phi, base 1)
// and two obtuse ones (legs phi, base phi^2), which differ by their rule.
enum Tile : unsigned char { A, B, C, D, E, F, NONE };
enum Digits : unsigned char { ZERO = 0, HIGH = 1, LOW = 2 };  // the new pair: 00, 10, 01, last digit first

// A step in the child's scale: phi^power along the parent's direction, turned by 18 degrees each.
struct Leg {
    int turn;
    int power;
};

// A tile that another is subdivided into: its first vertex is reached by legs from the parent's.
struct Child {
    Tile tile = NONE;
    Digits digits = ZERO;
    int turn = 0;
    std::vector<Leg> legs;
};

const std::array<std::vector<Child>, 6>& rules()
{
    const Leg acute2{0, 1}, acute3{4, 2}, obtuse2{0, 3}, obtuse3{2, 2};  // the parent's other vertices
    static const std::array<std::vector<Child>, 6> all = {{
        {{B, ZERO, 0, {}}},
        {{A, ZERO, 10, {}}},
        {{F, ZERO, 14, {acute3}}, {C, HIGH, 6, {acute2}}, {A, HIGH, 1, {acute3, {16, 1}}}},
        {{E, ZERO, 6, {acute2}}, {D, HIGH, 14, {acute2, {8, 1}}}},
        {{C, HIGH, 12, {obtuse3}}, {E, LOW, 8, {obtuse2}}, {F, ZERO, 0, {}}, {A, HIGH, 7, {obtuse3, {12, 0}}}},
        {{F, LOW, 12, {obtuse3}},
         {E, ZERO, 0, {obtuse3, {14, 1}}},
         {D, HIGH, 8, {obtuse3, {14, 1}, {2, 1}}},
         {A, LOW, 15, {obtuse3, {14, 1}}}},
    }};
    return all;
}

osg::Vec2d along(int turn)
{
    const double angle = osg::PI / 10.0 * turn;
    return osg::Vec2d(std::cos(angle), std::sin(angle));
}

// What is the same for every tile of a kind, direction and level, worked out once.
struct Geometry {
    struct Placed {
        Tile tile;
        Digits digits;
        unsigned char turn;
        osg::Vec2d offset;  // of the first vertex, in the child's scale
    };
    std::array<std::array<std::vector<Placed>, 20>, 6> children;
    std::array<std::array<std::array<osg::Vec2d, 2>, 20>, 6> corners;  // the other two vertices, in the tile's scale
    std::array<double, levels + 1> scale;
    std::array<uint64_t, 2 * levels + 3> fibonacci;

    Geometry()
    {
        // The domain lies about the centre of the inscribed circle of an obtuse triangle, whose radius is .425 of its scale.
        scale[0] = 3.0;
        for (unsigned l = 1; l <= levels; ++l) scale[l] = scale[l - 1] / phi;
        fibonacci = {{0, 1}};
        for (size_t i = 2; i < fibonacci.size(); ++i) fibonacci[i] = fibonacci[i - 1] + fibonacci[i - 2];
        for (int turn = 0; turn < 20; ++turn)
            for (unsigned tile = A; tile <= F; ++tile) {
                const bool isAcute = tile == C || tile == D;
                corners[tile][size_t(turn)] = {along(turn) * (isAcute ? 1.0 : phi * phi), along(turn + (isAcute ? 4 : 2)) * phi};
                for (const Child& c : rules()[tile]) {
                    osg::Vec2d offset;
                    for (const Leg& leg : c.legs) offset += along(turn + leg.turn) * std::pow(phi, leg.power);
                    children[tile][size_t(turn)].push_back(
                        {c.tile, c.digits, static_cast<unsigned char>((turn + c.turn) % 20), offset});
                }
            }
    }
};

const Geometry& geometry()
{
    static const Geometry g;
    return g;
}

// A tile in the queue.
struct Node {
    double key;  // of a sampling tile; of a triangle the least that a sampling tile in it may have
    osg::Vec2d vertex;
    uint64_t rank;
    unsigned order;  // ties go to the older
    Tile tile;
    unsigned char turn;
    unsigned char level;
    unsigned char code;  // its last six digits

    bool sampling() const { return tile <= B; }
    bool operator<(const Node& o) const { return key != o.key ? key > o.key : order > o.order; }
};

class Chooser
{
  public:
    Chooser(ImportanceGrid& grid, const PenroseRule& rule) : _grid(grid), _rule(rule)
    {
        const double s = _geometry.scale[0];
        const double area = 0.5 * phi * phi * phi * std::sin(osg::PI / 5.0) * s * s;
        _share = 2.0 / (2.0 * area);
        _largest = rule.onePerCell ? tilesPerCell * double(grid.cells()) : 1e300;
        const double inradius = area / ((phi + 0.5 * phi * phi) * s);
        enter(F, 0, osg::Vec2d(1.0 - 0.5 * phi * phi * s, 0.5 - inradius), 0, 0, 0);
    }

    std::vector<PenrosePoint> choose(size_t count)
    {
        while (_chosen.size() < count && !_queue.empty()) {
            std::pop_heap(_queue.begin(), _queue.end());
            const Node n = _queue.back();
            _queue.pop_back();
            n.sampling() ? take(n) : subdivide(n);
        }
        std::vector<PenrosePoint> points = finish();
        if (_rule.onePerCell) fillUp(points, count);
        return points;
    }

  private:
    void enter(Tile tile, int turn, const osg::Vec2d& vertex, uint64_t rank, unsigned level, unsigned code)
    {
        Node n{0.0,
               vertex,
               rank,
               _entered++,
               tile,
               static_cast<unsigned char>(turn),
               static_cast<unsigned char>(level),
               static_cast<unsigned char>(code & 63u)};
        double importance = 0.0;
        double least = double(rank);
        if (n.sampling()) {
            if (vertex.x() < 0.0 || vertex.y() < 0.0 || vertex.x() >= 2.0 || vertex.y() >= 1.0) return;
            importance = _grid.importance(_grid.cellAt(vertex.x(), vertex.y()));
        } else {
            if (level == levels) return;
            importance = greatest(n);
            // Every sampling tile is left with a digit other than 0 in its last pair.
            least += double(_geometry.fibonacci[2 * level + 2]);
        }
        if (importance <= 0.0 || least * _share > _largest) return;
        n.key = least * _share / importance;
        _queue.push_back(n);
        std::push_heap(_queue.begin(), _queue.end());
    }

    double greatest(const Node& n) const
    {
        const auto& corners = _geometry.corners[n.tile][n.turn];
        const double scale = _geometry.scale[n.level];
        const osg::Vec2d b = n.vertex + corners[0] * scale;
        const osg::Vec2d c = n.vertex + corners[1] * scale;
        const double margin = 1e-9;  // rounding of vertices on an edge
        return _grid.maximum(std::min({n.vertex.x(), b.x(), c.x()}) - margin, std::min({n.vertex.y(), b.y(), c.y()}) - margin,
                             std::max({n.vertex.x(), b.x(), c.x()}) + margin, std::max({n.vertex.y(), b.y(), c.y()}) + margin);
    }

    void subdivide(const Node& n)
    {
        const unsigned level = n.level + 1u;
        const uint64_t digits[3] = {0, _geometry.fibonacci[2 * level + 1], _geometry.fibonacci[2 * level]};
        for (const Geometry::Placed& c : _geometry.children[n.tile][n.turn])
            enter(c.tile, c.turn, n.vertex + c.offset * _geometry.scale[level], n.rank + digits[c.digits], level,
                  unsigned(n.code) << 2 | c.digits);
    }

    void take(const Node& n)
    {
        const size_t cell = _grid.cellAt(n.vertex.x(), n.vertex.y());
        const double importance = _grid.importance(cell);
        if (importance <= 0.0) return;  // taken meanwhile
        if (_rule.onePerCell) _grid.clear(cell);
        _chosen.push_back(n);
        _importance.push_back(importance);
        _threshold = n.key;
    }

    // The indices of the table depend on the scale of the importance, which is known only now.
    std::vector<PenrosePoint> finish() const
    {
        std::vector<PenrosePoint> points;
        points.reserve(_chosen.size());
        for (size_t i = 0; i < _chosen.size(); ++i) {
            const Node& n = _chosen[i];
            const double density = std::max(_threshold * _importance[i] / _share, double(n.rank));
            const double position = std::log(std::sqrt(5.0) * density) / std::log(phi * phi);
            const unsigned level = std::clamp(unsigned(position), unsigned(n.level), levels);
            const double between = std::clamp(position - level, 0.0, 1.0);
            // Down to that level the sampling tile turns from a to b and back, and its code is prolonged by zeros.
            const unsigned more = level - n.level;
            const unsigned turns = (more + (n.tile == B ? 1u : 0u)) / 2u;
            points.push_back({n.vertex, n.rank, _grid.cellAt(n.vertex.x(), n.vertex.y()), int((n.turn + 10u * turns) % 20u),
                              _geometry.scale[level], std::min(unsigned(between * indices), indices - 1),
                              structuralIndex(more > 2 ? 0u : unsigned(n.code) << 2 * more & 63u)});
        }
        return points;
    }

    void fillUp(std::vector<PenrosePoint>& points, size_t count) const
    {
        std::vector<std::pair<double, size_t>> left;
        for (size_t i = 0; i < _grid.cells() && points.size() < count; ++i)
            if (_grid.importance(i) > 0.0) left.push_back({-_grid.importance(i), i});
        std::sort(left.begin(), left.end());
        for (size_t k = 0; k < left.size() && points.size() < count; ++k)
            points.push_back({_grid.centre(left[k].second), 0, left[k].second, 0, 0.0, 0, 0});
    }

    // Weights 1, 2, 3, 5, 8, 13, the last digit's the largest; no two digits in a row are 1, so at most 20.
    unsigned structuralIndex(unsigned code) const
    {
        unsigned sum = 0;
        for (unsigned i = 0; i < 6; ++i)
            if (code >> (5 - i) & 1u) sum += unsigned(_geometry.fibonacci[i + 2]);
        return sum;
    }

    const Geometry& _geometry = geometry();
    ImportanceGrid& _grid;
    PenroseRule _rule;
    double _share;    // of all numbers, the domain's: every other one is found in the root triangle
    double _largest;  // density that is ever asked for
    std::vector<Node> _queue;
    std::vector<Node> _chosen;
    std::vector<double> _importance;
    double _threshold = 0.0;
    unsigned _entered = 0;
};

}  // namespace

std::vector<PenrosePoint> choosePenrosePoints(ImportanceGrid grid, size_t count, const PenroseRule& rule)
{
    return Chooser(grid, rule).choose(count);
}

osg::Vec2d correctedPosition(const PenrosePoint& p, const PenroseTable& table)
{
    const float* shift = table.shift[p.importanceIndex][p.structuralIndex];
    const osg::Vec2d moved = p.vertex + (along(p.turn) * double(shift[0]) + along(p.turn + 5) * double(shift[1])) * p.scale;
    return moved.y() > 0.0 && moved.y() < 1.0 ? moved : p.vertex;
}

}  // namespace osgEnvLight

// SPDX-License-Identifier: MIT
// envlight_scale_study [LEAVES] [NAME=VALUE...]: a table of what large scenes cost the host's processor.
//   LEAVES      boxes on a floor, 100000: each has a transform of its own, below a quadtree of groups
//   NAME=VALUE  a setting
// Plain OSG and the lighting draw the same scene in turns. The table has the least milliseconds of their cull traversals, draw
// traversals and frames; and of the lighting's first frames the sum and the longest.
#include <SceneRenderer.h>

#include <osg/MatrixTransform>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <iostream>
#include <stdexcept>

using osgEnvLight::LitScene;

namespace
{

struct Kind {
    const char* name;
    bool shared;     // one geometry for all
    bool ownStates;  // a state set for each
    int moving;      // of the boxes, in each frame
    bool close;      // the eye sees a few hundred of them
};

const Kind kinds[] = {
    {"a geometry each", false, false, 0, false},
    {"one geometry", true, false, 0, false},
    {"a state set each", true, true, 0, false},
    {"seen from close by", true, false, 0, true},
    {"one moves", true, false, 1, false},
    {"one moves, seen from close by", true, false, 1, true},
    {"a thousand move, seen from close by", true, false, 1000, true},
};

osg::ref_ptr<osg::Geometry> box(double side)
{
    osg::ref_ptr<osg::Geode> geode = makeBox(osg::Vec3d(-side, -side, 0), osg::Vec3d(side, side, 2 * side));
    return geode->getDrawable(0)->asGeometry();
}

class Scene
{
  public:
    Scene(const Kind& kind, int leaves) : root(new osg::Group), _kind(kind), _side(int(std::lround(std::sqrt(leaves))))
    {
        _shared = box(0.3);
        root->addChild(makeQuad(osg::Vec3d(0, 0, 0), osg::Vec3d(_side, 0, 0), osg::Vec3d(0, _side, 0)));
        root->addChild(tree(0, 0, _side, _side));
    }
    int leaves() const { return int(_all.size()); }
    double side() const { return _side; }

    void move(int frame)
    {
        for (int i = 0; i < _kind.moving; ++i) {
            osg::MatrixTransform& t = *_all[size_t(i) * _all.size() / size_t(_kind.moving)];
            osg::Matrixd m = t.getMatrix();
            m.setTrans(m.getTrans().x(), m.getTrans().y(), 0.5 + 0.5 * std::sin(0.3 * frame + i));
            t.setMatrix(m);
        }
    }

    osg::ref_ptr<osg::Group> root;

  private:
    osg::ref_ptr<osg::Node> tree(int x0, int y0, int x1, int y1)
    {
        if (x1 - x0 <= 1 && y1 - y0 <= 1) return leaf(x0, y0);
        osg::ref_ptr<osg::Group> group = new osg::Group;
        const int xm = x1 - x0 > 1 ? (x0 + x1) / 2 : x1;
        const int ym = y1 - y0 > 1 ? (y0 + y1) / 2 : y1;
        for (int i = 0; i < 4; ++i) {
            const int xa = i % 2 ? xm : x0, xb = i % 2 ? x1 : xm, ya = i / 2 ? ym : y0, yb = i / 2 ? y1 : ym;
            if (xb > xa && yb > ya) group->addChild(tree(xa, ya, xb, yb));
        }
        return group;
    }

    osg::ref_ptr<osg::Node> leaf(int x, int y)
    {
        osg::ref_ptr<osg::MatrixTransform> t = new osg::MatrixTransform(osg::Matrixd::translate(x + 0.5, y + 0.5, 0));
        osg::ref_ptr<osg::Geode> geode = new osg::Geode;
        geode->addDrawable(_kind.shared ? _shared : box(0.3));
        if (_kind.ownStates) geode->getOrCreateStateSet()->setRenderBinDetails(0, "RenderBin");
        t->addChild(geode);
        _all.push_back(t.get());
        return t;
    }

    const Kind _kind;
    const int _side;
    osg::ref_ptr<osg::Geometry> _shared;
    std::vector<osg::MatrixTransform*> _all;
};

struct Times {
    double cull = 1e30, draw = 1e30, frame = 1e30;
    void least(const Times& t)
    {
        cull = std::min(cull, t.cull);
        draw = std::min(draw, t.draw);
        frame = std::min(frame, t.frame);
    }
};

Times draw(SceneRenderer& renderer, osg::Node& scene)
{
    Times times;
    times.frame = renderer.time(&scene, 1)[0];
    osg::Stats& stats = *renderer.viewer().getCamera()->getStats();
    const unsigned frame = renderer.viewer().getFrameStamp()->getFrameNumber();
    stats.getAttribute(frame, "Cull traversal time taken", times.cull);
    stats.getAttribute(frame, "Draw traversal time taken", times.draw);
    times.cull *= 1e3;
    times.draw *= 1e3;
    return times;
}

void measure(const Kind& kind, int leaves, const std::vector<std::string>& settings)
{
    Scene scene(kind, leaves);
    SceneRenderer renderer(256, 256);
    const double s = scene.side(), reach = kind.close ? 10.0 : s;
    renderer.lookAt(osg::Vec3d(0.5 * s, 0.5 * s - reach, 0.7 * reach), osg::Vec3d(0.5 * s, 0.5 * s, 0));
    renderer.viewer().getCamera()->getStats()->collectStats("rendering", true);
    osg::ref_ptr<osg::Group> plain = new osg::Group;
    plain->addChild(scene.root);
    osg::ref_ptr<LitScene> lit = new LitScene;
    lit->addChild(scene.root);
    for (const std::string& text : settings) {
        const size_t equals = text.find('=');
        std::string error = "expected NAME=VALUE, not '" + text + "'";
        if (equals == std::string::npos || !lit->getSettings()->set(text.substr(0, equals), text.substr(equals + 1), error))
            throw std::runtime_error(error);
    }
    int frame = 0;
    for (int i = 0; i < 2; ++i) draw(renderer, *plain);
    double start = 0.0, longest = 0.0;
    int settling = 0;
    do {
        scene.move(++frame);
        const double ms = draw(renderer, *lit).frame;
        start += ms;
        longest = std::max(longest, ms);
    } while (++settling < 4 || (lit->regenerating() && settling < 40));
    Times without, with;
    for (int i = 0; i < 8; ++i) {
        scene.move(++frame);
        with.least(draw(renderer, *lit));
        without.least(draw(renderer, *plain));
    }
    std::cout << std::left << std::setw(38) << kind.name << std::right << std::fixed << std::setprecision(2) << std::setw(9)
              << without.cull << std::setw(9) << with.cull << std::setw(9) << without.draw << std::setw(9) << with.draw
              << std::setw(9) << without.frame << std::setw(9) << with.frame << std::setw(10) << start << std::setw(10) << longest
              << std::endl;
}

}  // namespace

int main(int argc, char** argv)
try {
    int leaves = 100000;
    std::vector<std::string> settings;
    for (int i = 1; i < argc; ++i) {
        if (std::string(argv[i]).find('=') != std::string::npos)
            settings.push_back(argv[i]);
        else
            leaves = std::stoi(argv[i]);
    }
    std::cout << leaves << " boxes; milliseconds without and with the lighting\n"
              << std::string(38, ' ') << "     cull     cull     draw     draw    frame    frame     start   longest"
              << std::endl;
    for (const Kind& kind : kinds) measure(kind, leaves, settings);
    return 0;
} catch (const std::exception& error) {
    std::cerr << "envlight_scale_study: " << error.what() << std::endl;
    return 1;
}

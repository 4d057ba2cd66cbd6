// SPDX-License-Identifier: MIT
// Times and errors of settings, in one viewer.
#pragma once

#include "Attribution.h"
#include "HeadlessViewer.h"
#include "Sweeps.h"

namespace tradeoff
{

class Measurement
{
  public:
    /** @param frames  that count, after those that warm up */
    Measurement(osgEnvLight::LitScene& lit, HeadlessViewer& viewer, const Truth& truth, int frames);

    /** Draw with the candidate's settings, on top of those that the scene had at first. Failures of OpenGL and of the settings
     * are the point's, not exceptions.*/
    Point measure(const Candidate& candidate);

    /** The pictures of the last candidate. */
    const Terms& pictures() const { return _pictures; }

    /** The scene's own. */
    const osgEnvLight::Settings& settings() const { return *_base; }

    /** How times are taken, for people. */
    std::string statement() const;

  private:
    void time(Point& point);
    osgEnvLight::Picture view(int view);
    const osgEnvLight::Picture& specular();

    osgEnvLight::LitScene& _lit;
    HeadlessViewer& _viewer;
    const Truth& _truth;
    const osg::ref_ptr<osgEnvLight::Settings> _base;
    int _frames;
    Terms _pictures;
    std::map<std::tuple<bool, int, int, int, int>, osgEnvLight::Picture> _speculars;
};

}  // namespace tradeoff

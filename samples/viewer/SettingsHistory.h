// SPDX-License-Identifier: MIT
#pragma once

#include <osgEnvLight/LitScene>

#include <vector>

/** The states that settings and environment map had, to go back to and forth. The map's image is shared, not copied. */
class SettingsHistory
{
  public:
    explicit SettingsHistory(osgEnvLight::LitScene& lit);

    /** Forget all steps: the present state is the first. */
    void restart();
    /** The present state becomes a step, if it differs from the last one. */
    void record();
    /** False if there is no step that way. */
    bool undo();
    bool redo();
    bool canUndo() const { return _present > 0; }
    bool canRedo() const { return _present + 1 < _states.size(); }

  private:
    struct State {
        osg::ref_ptr<osgEnvLight::Settings> settings;
        osg::ref_ptr<osgEnvLight::EnvironmentMap> map;
        double rotation;
        double intensity;
    };

    State now() const;
    void restore(const State& state);
    static bool same(const State& a, const State& b);

    osgEnvLight::LitScene& _lit;
    std::vector<State> _states;
    size_t _present = 0;
};

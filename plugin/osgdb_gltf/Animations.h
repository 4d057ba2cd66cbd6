// SPDX-License-Identifier: MIT
#pragma once

#include "Accessors.h"

#include <osgAnimation/Animation>
#include <osgAnimation/UpdateMatrixTransform>

namespace osgEnvLight::gltf
{

/** The animations of a file for osgAnimation, which links channels to nodes by name: those of the update callbacks are the nodes'
 * indices, as glTF's names need not differ. Times count from the first key of an animation. */
class Animations
{
  public:
    Animations(const Asset& asset, Accessors& accessors) : _asset(asset), _accessors(accessors) {}

    bool any() const { return !_asset.model.animations.empty(); }

    /** Which nodes an animation moves, and of which one animates weights. */
    std::vector<bool> movedNodes() const { return targets(false); }
    std::vector<bool> morphedNodes() const { return targets(true); }

    osgAnimation::AnimationList build();

    /** Names of update callbacks. */
    static std::string transformTarget(std::size_t node) { return "node" + std::to_string(node); }
    static std::string weightsTarget(std::size_t node) { return "node" + std::to_string(node) + ".weights"; }
    /** Gives `callback` the transform of a node, in parts that channels find. */
    static void stackTransform(osgAnimation::UpdateMatrixTransform& callback, const tinygltf::Node& node);

  private:
    struct Curve {
        std::vector<double> times;
        std::vector<float> values;
        std::string interpolation;
    };
    std::vector<bool> targets(bool weights) const;
    Curve curve(std::size_t animation, std::size_t channel);
    void checkTimes(const std::vector<double>& times, const std::string& path) const;
    void addChannel(osgAnimation::Animation& animation, const Curve& curve, const tinygltf::AnimationChannel& channel);
    void addWeights(osgAnimation::Animation& animation, const Curve& curve, std::size_t node);
    std::size_t valuesPerKey(const tinygltf::AnimationChannel& channel) const;

    const Asset& _asset;
    Accessors& _accessors;
};

}  // namespace osgEnvLight::gltf

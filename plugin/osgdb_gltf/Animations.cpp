// SPDX-License-Identifier: MIT
#include "Animations.h"

#include <osgAnimation/Channel>
#include <osgAnimation/StackedMatrixElement>
#include <osgAnimation/StackedQuaternionElement>
#include <osgAnimation/StackedScaleElement>
#include <osgAnimation/StackedTranslateElement>

#include <algorithm>

namespace osgEnvLight::gltf
{

namespace
{

using QuatCubicBezier = osgAnimation::TemplateCubicBezier<osg::Quat>;
using QuatCubicBezierSampler =
    osgAnimation::TemplateSampler<osgAnimation::TemplateCubicBezierInterpolator<osg::Quat, QuatCubicBezier>>;

/** How osgAnimation interpolates values of a type. */
template <class Value>
struct Samplers;
template <>
struct Samplers<float> {
    using Step = osgAnimation::FloatStepSampler;
    using Linear = osgAnimation::FloatLinearSampler;
    using Cubic = osgAnimation::FloatCubicBezierSampler;
    using CubicKey = osgAnimation::FloatCubicBezier;
    static float at(const float* v) { return *v; }
};
template <>
struct Samplers<osg::Vec3> {
    using Step = osgAnimation::Vec3StepSampler;
    using Linear = osgAnimation::Vec3LinearSampler;
    using Cubic = osgAnimation::Vec3CubicBezierSampler;
    using CubicKey = osgAnimation::Vec3CubicBezier;
    static osg::Vec3 at(const float* v) { return osg::Vec3(v[0], v[1], v[2]); }
};
template <>
struct Samplers<osg::Quat> {
    using Step = osgAnimation::QuatStepSampler;
    using Linear = osgAnimation::QuatSphericalLinearSampler;
    using Cubic = QuatCubicBezierSampler;
    using CubicKey = QuatCubicBezier;
    static osg::Quat at(const float* v) { return osg::Quat(v[0], v[1], v[2], v[3]); }
};

/** The values of one target among the keys: `width` floats at `offset` of every `stride`. */
struct Track {
    const std::vector<double>& times;
    const float* values;
    std::size_t stride;

    const float* at(std::size_t key) const { return values + key * stride; }
};

template <class Sampler, class KeyOf>
osg::ref_ptr<osgAnimation::Channel> makeChannel(const Track& track, KeyOf keyOf)
{
    osg::ref_ptr<osgAnimation::TemplateChannel<Sampler>> channel = new osgAnimation::TemplateChannel<Sampler>;
    auto* keys = channel->getOrCreateSampler()->getOrCreateKeyframeContainer();
    using Key = typename Sampler::KeyframeContainerType::KeyType;
    for (std::size_t i = 0; i < track.times.size(); ++i) keys->push_back(Key(track.times[i], keyOf(i)));
    return channel;
}

/** @param width  floats between the in-tangent, the value and the out-tangent of a cubic key */
template <class Value>
osg::ref_ptr<osgAnimation::Channel> makeChannel(const Track& track, const std::string& interpolation, std::size_t width)
{
    using S = Samplers<Value>;
    if (interpolation == "STEP") return makeChannel<typename S::Step>(track, [&](std::size_t i) { return S::at(track.at(i)); });
    if (interpolation != "CUBICSPLINE")
        return makeChannel<typename S::Linear>(track, [&](std::size_t i) { return S::at(track.at(i)); });
    return makeChannel<typename S::Cubic>(track, [&](std::size_t i) {
        // Hermite to Bezier: a control point is a third of the tangent away.
        const Value value = S::at(track.at(i) + width);
        if (i + 1 == track.times.size()) return typename S::CubicKey(value);
        const float third = float((track.times[i + 1] - track.times[i]) / 3.0);
        const Value out = S::at(track.at(i) + 2 * width);
        const Value next = S::at(track.at(i + 1) + width);
        const Value in = S::at(track.at(i + 1));
        return typename S::CubicKey(value, value + out * third, next - in * third);
    });
}

osg::Vec3 vec3(const std::vector<double>& v, double otherwise)
{
    return v.empty() ? osg::Vec3(float(otherwise), float(otherwise), float(otherwise))
                     : osg::Vec3(float(v[0]), float(v[1]), float(v[2]));
}

}  // namespace

std::vector<bool> Animations::targets(bool weights) const
{
    std::vector<bool> result(_asset.model.nodes.size(), false);
    for (const tinygltf::Animation& animation : _asset.model.animations)
        for (const tinygltf::AnimationChannel& channel : animation.channels)
            if (channel.target_node >= 0 && (channel.target_path == "weights") == weights)
                result[std::size_t(channel.target_node)] = true;
    return result;
}

void Animations::stackTransform(osgAnimation::UpdateMatrixTransform& callback, const tinygltf::Node& node)
{
    osgAnimation::StackedTransform& stack = callback.getStackedTransforms();
    if (!node.matrix.empty()) return stack.push_back(new osgAnimation::StackedMatrixElement(osg::Matrix(node.matrix.data())));
    const std::vector<double>& r = node.rotation;
    stack.push_back(new osgAnimation::StackedTranslateElement("translation", vec3(node.translation, 0.0)));
    stack.push_back(
        new osgAnimation::StackedQuaternionElement("rotation", r.empty() ? osg::Quat() : osg::Quat(r[0], r[1], r[2], r[3])));
    stack.push_back(new osgAnimation::StackedScaleElement("scale", vec3(node.scale, 1.0)));
}

void Animations::checkTimes(const std::vector<double>& times, const std::string& path) const
{
    const std::string expected = "times that begin at 0 or later and increase";
    if (times.front() < 0.0) _asset.fail(path, expected, "a negative one at 0");
    const auto bad = std::adjacent_find(times.begin(), times.end(), [](double a, double b) { return a >= b; });
    if (bad != times.end()) _asset.fail(path, expected, "one that does not at " + std::to_string(bad - times.begin() + 1));
}

std::size_t Animations::valuesPerKey(const tinygltf::AnimationChannel& channel) const
{
    if (channel.target_path == "rotation") return 4;
    if (channel.target_path != "weights") return 3;
    const int mesh = _asset.model.nodes[std::size_t(channel.target_node)].mesh;
    return mesh < 0 ? 0 : _asset.model.meshes[std::size_t(mesh)].primitives[0].targets.size();
}

Animations::Curve Animations::curve(std::size_t animation, std::size_t channel)
{
    const tinygltf::Animation& a = _asset.model.animations[animation];
    const tinygltf::AnimationChannel& c = a.channels[channel];
    const std::string path = element("animations", animation);
    const std::string channelPath = element(path + ".channels", channel);
    if (std::size_t(c.sampler) >= a.samplers.size())
        _asset.fail(channelPath + ".sampler", "an index below " + std::to_string(a.samplers.size()) + ", the number of samplers",
                    std::to_string(c.sampler));
    const bool moves = c.target_path != "weights";
    if (moves && !_asset.model.nodes[std::size_t(c.target_node)].matrix.empty())
        _asset.fail(channelPath + ".target.node", "a node with translation, rotation and scale", "one with a matrix");
    const tinygltf::AnimationSampler& sampler = a.samplers[std::size_t(c.sampler)];
    const std::string samplerPath = element(path + ".samplers", std::size_t(c.sampler));
    const std::vector<float> times = _accessors.floats(sampler.input, 1, samplerPath + ".input");
    Curve curve;
    curve.times.assign(times.begin(), times.end());
    checkTimes(curve.times, samplerPath + ".input");
    curve.values = _accessors.floats(sampler.output, moves ? unsigned(valuesPerKey(c)) : 1, samplerPath + ".output");
    curve.interpolation = sampler.interpolation;
    const std::size_t needed = curve.times.size() * valuesPerKey(c) * (curve.interpolation == "CUBICSPLINE" ? 3 : 1);
    if (curve.values.size() != needed)
        _asset.fail(samplerPath + ".output",
                    std::to_string(needed) + " numbers for " + std::to_string(curve.times.size()) + " times",
                    std::to_string(curve.values.size()));
    _accessors.spend(curve.values.size() * 16, channelPath);
    return curve;
}

void Animations::addWeights(osgAnimation::Animation& animation, const Curve& curve, std::size_t node)
{
    const bool cubic = curve.interpolation == "CUBICSPLINE";
    const std::size_t targets = curve.values.size() / curve.times.size() / (cubic ? 3 : 1);
    for (std::size_t i = 0; i < targets; ++i) {
        const Track track{curve.times, curve.values.data() + i, targets * (cubic ? 3 : 1)};
        const osg::ref_ptr<osgAnimation::Channel> channel = makeChannel<float>(track, curve.interpolation, targets);
        channel->setName(std::to_string(i));
        channel->setTargetName(weightsTarget(node));
        animation.addChannel(channel);
    }
}

void Animations::addChannel(osgAnimation::Animation& animation, const Curve& curve, const tinygltf::AnimationChannel& channel)
{
    const std::size_t node = std::size_t(channel.target_node);
    if (channel.target_path == "weights") return addWeights(animation, curve, node);
    const std::size_t width = valuesPerKey(channel);
    const Track track{curve.times, curve.values.data(), curve.values.size() / curve.times.size()};
    const osg::ref_ptr<osgAnimation::Channel> result = width == 4 ? makeChannel<osg::Quat>(track, curve.interpolation, width)
                                                                  : makeChannel<osg::Vec3>(track, curve.interpolation, width);
    result->setName(channel.target_path);
    result->setTargetName(transformTarget(node));
    animation.addChannel(result);
}

osgAnimation::AnimationList Animations::build()
{
    osgAnimation::AnimationList list;
    for (std::size_t i = 0; i < _asset.model.animations.size(); ++i) {
        const tinygltf::Animation& a = _asset.model.animations[i];
        std::vector<std::pair<Curve, const tinygltf::AnimationChannel*>> curves;
        double start = 1e30;
        for (std::size_t c = 0; c < a.channels.size(); ++c) {
            const std::string& path = a.channels[c].target_path;
            if (path != "translation" && path != "rotation" && path != "scale" && path != "weights") continue;
            curves.emplace_back(curve(i, c), &a.channels[c]);
            start = std::min(start, curves.back().first.times.front());
        }
        osg::ref_ptr<osgAnimation::Animation> animation = new osgAnimation::Animation;
        animation->setName(a.name.empty() ? "animation" + std::to_string(i) : a.name);
        animation->setPlayMode(osgAnimation::Animation::LOOP);
        for (auto& [curve, channel] : curves) {
            for (double& time : curve.times) time -= start;
            addChannel(*animation, curve, *channel);
        }
        list.push_back(animation);
    }
    return list;
}

}  // namespace osgEnvLight::gltf

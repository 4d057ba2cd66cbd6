// SPDX-License-Identifier: MIT
#include "SceneBuilder.h"

#include "Cameras.h"
#include "Extensions.h"
#include "Lights.h"

#include <osg/FrontFace>
#include <osg/Notify>

#include <osgAnimation/BasicAnimationManager>
#include <osgAnimation/MorphGeometry>
#include <osgAnimation/Skeleton>
#include <osgAnimation/UpdateBone>

#include <osgUtil/UpdateVisitor>

namespace osgEnvLight::gltf
{

namespace
{

// Visitors of scene graphs recurse.
constexpr int deepest = 512;

osg::Matrix matrixOf(const tinygltf::Node& n)
{
    if (!n.matrix.empty()) return osg::Matrix(n.matrix.data());
    osg::Matrix matrix;
    if (!n.translation.empty()) matrix.preMultTranslate(osg::Vec3d(n.translation[0], n.translation[1], n.translation[2]));
    if (!n.rotation.empty()) matrix.preMultRotate(osg::Quat(n.rotation[0], n.rotation[1], n.rotation[2], n.rotation[3]));
    if (!n.scale.empty()) matrix.preMultScale(osg::Vec3d(n.scale[0], n.scale[1], n.scale[2]));
    return matrix;
}

bool mirrors(const osg::Matrix& m)
{
    const auto row = [&](int i) { return osg::Vec3d(m(i, 0), m(i, 1), m(i, 2)); };
    return (row(0) ^ row(1)) * row(2) < 0.0;
}

}  // namespace

SceneBuilder::SceneBuilder(const Asset& asset)
    : _asset(asset),
      _accessors(asset),
      _meshes(asset, _accessors),
      _skins(asset, _accessors),
      _animations(asset, _accessors),
      _nodes(asset.model.nodes.size())
{
    findParents();
    _bones = _skins.boneNodes(_parents);
    _moved = _animations.movedNodes();
    _morphed = _animations.morphedNodes();
}

void SceneBuilder::findParents()
{
    const std::vector<tinygltf::Node>& nodes = _asset.model.nodes;
    _parents.assign(nodes.size(), -1);
    for (std::size_t i = 0; i < nodes.size(); ++i)
        for (std::size_t k = 0; k < nodes[i].children.size(); ++k) {
            int& parent = _parents[std::size_t(nodes[i].children[k])];
            if (parent >= 0)
                _asset.fail(element(element("nodes", i) + ".children", k), "a node without another parent",
                            "node " + std::to_string(nodes[i].children[k]) + ", a child of node " + std::to_string(parent));
            parent = int(i);
        }
    // With one parent each, a cycle is what has no end upwards.
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        int depth = 0;
        for (int node = int(i); node >= 0; node = _parents[std::size_t(node)])
            if (++depth > deepest)
                _asset.fail(element("nodes", i), "at most " + std::to_string(deepest) + " nodes above it",
                            "more, or itself among them");
    }
}

std::vector<int> SceneBuilder::roots() const
{
    const tinygltf::Model& model = _asset.model;
    std::vector<int> roots;
    if (model.scenes.empty()) {
        for (std::size_t i = 0; i < _parents.size(); ++i)
            if (_parents[i] < 0) roots.push_back(int(i));
        return roots;
    }
    const std::size_t scene = std::size_t(std::max(model.defaultScene, 0));
    roots = model.scenes[scene].nodes;
    std::vector<bool> listed(_parents.size(), false);
    for (std::size_t i = 0; i < roots.size(); ++i) {
        const std::size_t node = std::size_t(roots[i]);
        if (_parents[node] >= 0 || listed[node])
            _asset.fail(element(element("scenes", scene) + ".nodes", i), "a node without a parent, once",
                        "node " + std::to_string(node) +
                            (listed[node] ? " again" : ", a child of node " + std::to_string(_parents[node])));
        listed[node] = true;
    }
    return roots;
}

osg::ref_ptr<osg::Group> SceneBuilder::makeTransform(int index)
{
    const tinygltf::Node& node = _asset.model.nodes[std::size_t(index)];
    const osg::Matrix matrix = matrixOf(node);
    const bool bone = _bones[std::size_t(index)], moved = _moved[std::size_t(index)];
    if (!bone && !moved && matrix.isIdentity()) return new osg::Group;
    osg::ref_ptr<osg::MatrixTransform> transform = bone ? new osgAnimation::Bone : new osg::MatrixTransform;
    transform->setMatrix(matrix);
    // osgUtil::Optimizer would flatten it, and forget the tangents.
    transform->setDataVariance(osg::Object::DYNAMIC);
    if (bone || moved) {
        const std::string name = Animations::transformTarget(std::size_t(index));
        osg::ref_ptr<osgAnimation::UpdateMatrixTransform> callback =
            bone ? new osgAnimation::UpdateBone(name) : new osgAnimation::UpdateMatrixTransform(name);
        Animations::stackTransform(*callback, node);
        transform->setUpdateCallback(callback);
    }
    return transform;
}

osg::ref_ptr<osg::Group> SceneBuilder::makeNode(int index, bool mirrored)
{
    const tinygltf::Node& node = _asset.model.nodes[std::size_t(index)];
    osg::ref_ptr<osg::Group> group = makeTransform(index);
    group->setName(node.name);
    _nodes[std::size_t(index)] = group;
    if (mirrors(matrixOf(node))) {
        mirrored = !mirrored;
        const auto front = mirrored ? osg::FrontFace::CLOCKWISE : osg::FrontFace::COUNTER_CLOCKWISE;
        group->getOrCreateStateSet()->setAttribute(new osg::FrontFace(front));
    }
    // osgAnimation wants bones before what else is below a bone.
    for (const bool bones : {true, false})
        for (const int child : node.children)
            if (_bones[std::size_t(child)] == bones) group->addChild(makeNode(child, mirrored));
    if (node.mesh >= 0) addMesh(*group, index);
    if (node.camera >= 0) addCamera(*group, node);
    addLight(*group, node);
    return group;
}

osg::ref_ptr<osg::Geode> SceneBuilder::movingGeode(int index)
{
    const tinygltf::Node& node = _asset.model.nodes[std::size_t(index)];
    const tinygltf::Mesh& mesh = _asset.model.meshes[std::size_t(node.mesh)];
    osg::ref_ptr<osg::Geode> geode = new osg::Geode;
    geode->setName(mesh.name);
    for (std::size_t i = 0; i < mesh.primitives.size(); ++i) {
        osg::ref_ptr<osg::Geometry> geometry =
            _meshes.primitive(node.mesh, i, node.weights.empty() ? mesh.weights : node.weights);
        if (node.skin >= 0) geometry = _skins.rig(geometry, node.skin, mesh.primitives[i], Meshes::path(node.mesh, i));
        geode->addDrawable(geometry);
    }
    if (_morphed[std::size_t(index)]) {
        const std::string name = Animations::weightsTarget(std::size_t(index));
        osg::ref_ptr<osgAnimation::UpdateMorph> callback = new osgAnimation::UpdateMorph(name);
        callback->addTarget(name);
        geode->setUpdateCallback(callback);
    }
    return geode;
}

void SceneBuilder::addMesh(osg::Group& group, int index)
{
    const tinygltf::Node& node = _asset.model.nodes[std::size_t(index)];
    if (node.skin >= 0) {
        _skinned.push_back(movingGeode(index));
        return;
    }
    osg::ref_ptr<osg::Geode> geode;
    if (_meshes.hasTargets(node.mesh))
        geode = movingGeode(index);
    else
        geode = _meshes.geode(node.mesh);
    const tinygltf::Value* instancing = extension(node.extensions, "EXT_mesh_gpu_instancing");
    if (instancing && instancing->Has("attributes"))
        addInstances(group, geode, instancing->Get("attributes"),
                     element("nodes", std::size_t(index)) + ".extensions.EXT_mesh_gpu_instancing.attributes.");
    else
        group.addChild(geode);
}

void SceneBuilder::addInstances(osg::Group& group, osg::Geode* geode, const tinygltf::Value& instancing, const std::string& path)
{
    std::size_t count = 0;
    const auto read = [&](const char* name, unsigned components) {
        if (!instancing.Has(name)) return std::vector<float>();
        std::vector<float> values = _accessors.floats(instancing.Get(name).GetNumberAsInt(), components, path + name);
        const std::size_t instances = values.size() / components;
        if (count != 0 && instances != count)
            _asset.fail(path + name, std::to_string(count) + " elements as the other attributes have", std::to_string(instances));
        count = instances;
        return values;
    };
    const std::vector<float> translations = read("TRANSLATION", 3), rotations = read("ROTATION", 4), scales = read("SCALE", 3);
    _accessors.spend(count * 512, path + "TRANSLATION");
    for (std::size_t i = 0; i < count; ++i) {
        osg::Matrix matrix;
        if (!translations.empty())
            matrix.preMultTranslate(osg::Vec3f(translations[3 * i], translations[3 * i + 1], translations[3 * i + 2]));
        if (!rotations.empty())
            matrix.preMultRotate(osg::Quat(rotations[4 * i], rotations[4 * i + 1], rotations[4 * i + 2], rotations[4 * i + 3]));
        if (!scales.empty()) matrix.preMultScale(osg::Vec3f(scales[3 * i], scales[3 * i + 1], scales[3 * i + 2]));
        osg::ref_ptr<osg::MatrixTransform> transform = new osg::MatrixTransform(matrix);
        transform->setDataVariance(osg::Object::DYNAMIC);
        transform->addChild(geode);
        group.addChild(transform);
    }
}

void SceneBuilder::addCamera(osg::Group& group, const tinygltf::Node& node)
{
    const Asset::Camera& camera = _asset.cameras[std::size_t(node.camera)];
    if (camera.yfov > 0.0)
        group.addChild(makeCamera(camera, node));
    else
        OSG_INFO << _asset.name << ": the orthographic camera '" << camera.name << "' is not read" << std::endl;
}

void SceneBuilder::addLight(osg::Group& group, const tinygltf::Node& node)
{
    const tinygltf::Value* reference = extension(node.extensions, "KHR_lights_punctual");
    if (!reference) return;
    if (_lights == mostLights) {
        OSG_INFO << _asset.name << ": only the first " << mostLights << " lights are read" << std::endl;
        return;
    }
    const osg::ref_ptr<osg::LightSource> source =
        makeLight(_asset.model.lights[std::size_t(numberOf(*reference, "light", 0))], ++_lights);
    if (!_lightModes) _lightModes = new osg::StateSet;
    source->setStateSetModes(*_lightModes, osg::StateAttribute::ON);
    group.addChild(source);
}

osg::ref_ptr<osg::Group> SceneBuilder::build(bool keepYUp)
{
    osg::ref_ptr<osg::MatrixTransform> root = new osg::MatrixTransform;
    root->setDataVariance(osg::Object::DYNAMIC);
    if (!keepYUp) root->setMatrix(osg::Matrix(1, 0, 0, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1));
    osg::ref_ptr<osg::Group> scene = root;
    if (_skins.any()) {
        osg::ref_ptr<osgAnimation::Skeleton> skeleton = new osgAnimation::Skeleton;
        skeleton->setDefaultUpdateCallback();
        root->addChild(skeleton);
        scene = skeleton;
    }
    const std::vector<int> list = roots();
    for (const bool bones : {true, false})
        for (const int node : list)
            if (_bones[std::size_t(node)] == bones) scene->addChild(makeNode(node, false));
    _skins.addJoints(_nodes);
    for (osg::Geode* geode : _skinned) scene->addChild(geode);
    if (_lightModes) root->setStateSet(_lightModes);
    finish(*root);
    return root;
}

/** Starts the first animation, and brings skins and morph targets to its first frame, so that the bounds are right at once. */
void SceneBuilder::finish(osg::Group& root)
{
    if (_animations.any()) {
        osg::ref_ptr<osgAnimation::BasicAnimationManager> manager = new osgAnimation::BasicAnimationManager;
        for (osgAnimation::Animation* animation : _animations.build()) manager->registerAnimation(animation);
        manager->playAnimation(manager->getRegisteredAnimation(0));
        root.setUpdateCallback(manager);
    }
    osgUtil::UpdateVisitor update;
    update.setFrameStamp(new osg::FrameStamp);
    root.accept(update);
}

}  // namespace osgEnvLight::gltf

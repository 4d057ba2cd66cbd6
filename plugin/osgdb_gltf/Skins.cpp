// SPDX-License-Identifier: MIT
#include "Skins.h"

#include <osgAnimation/RigTransformSoftware>

namespace osgEnvLight::gltf
{

namespace
{

std::string jointName(std::size_t skin, std::size_t joint)
{
    return "skin" + std::to_string(skin) + ".joint" + std::to_string(joint);
}

}  // namespace

std::vector<bool> Skins::boneNodes(const std::vector<int>& parents) const
{
    std::vector<bool> bones(_asset.model.nodes.size(), false);
    for (const tinygltf::Skin& skin : _asset.model.skins)
        for (int node : skin.joints)
            for (; node >= 0 && !bones[std::size_t(node)]; node = parents[std::size_t(node)]) bones[std::size_t(node)] = true;
    return bones;
}

void Skins::addJoints(const std::vector<osg::ref_ptr<osg::Group>>& nodes)
{
    for (std::size_t s = 0; s < _asset.model.skins.size(); ++s) {
        if (!_used[s]) continue;
        const tinygltf::Skin& skin = _asset.model.skins[s];
        const std::string path = element("skins", s) + ".inverseBindMatrices";
        std::vector<float> matrices;
        if (skin.inverseBindMatrices >= 0) {
            matrices = _accessors.floats(skin.inverseBindMatrices, 16, path);
            if (matrices.size() < skin.joints.size() * 16)
                _asset.fail(path, std::to_string(skin.joints.size()) + " matrices, one for each joint",
                            std::to_string(matrices.size() / 16));
        }
        _accessors.spend(skin.joints.size() * 1024, path);
        for (std::size_t j = 0; j < skin.joints.size(); ++j) {
            osg::Group* node = nodes[std::size_t(skin.joints[j])].get();
            if (!node)
                _asset.fail(element(element("skins", s) + ".joints", j), "a node of the scene that shows the skin",
                            "node " + std::to_string(skin.joints[j]));
            osg::ref_ptr<osgAnimation::Bone> bone = new osgAnimation::Bone(jointName(s, j));
            bone->setDefaultUpdateCallback();
            bone->setDataVariance(osg::Object::DYNAMIC);
            if (!matrices.empty()) bone->setInvBindMatrixInSkeletonSpace(osg::Matrix(&matrices[j * 16]));
            // Bones first: OSG updates children in their order.
            node->insertChild(0, bone);
        }
    }
}

osg::ref_ptr<osgAnimation::VertexInfluenceMap> Skins::influences(std::size_t vertices, int skin, const tinygltf::Primitive& p,
                                                                 const std::string& primitive)
{
    const std::size_t joints = _asset.model.skins[std::size_t(skin)].joints.size();
    osg::ref_ptr<osgAnimation::VertexInfluenceMap> map = new osgAnimation::VertexInfluenceMap;
    std::vector<float> sums(vertices, 0.0f);
    std::vector<unsigned> first(vertices, 0);
    for (int set = 0; set < 2; ++set) {
        const std::string jointsName = "JOINTS_" + std::to_string(set), weightsName = "WEIGHTS_" + std::to_string(set);
        const std::string where = primitive + ".attributes.";
        const auto jointsAt = p.attributes.find(jointsName), weightsAt = p.attributes.find(weightsName);
        if (set > 0 && jointsAt == p.attributes.end()) break;
        if (jointsAt == p.attributes.end()) _asset.fail(where + jointsName, "an accessor, as its node has a skin", "nothing");
        if (weightsAt == p.attributes.end()) _asset.fail(where + weightsName, "an accessor beside " + jointsName, "nothing");
        const std::vector<unsigned> indices = _accessors.integers(jointsAt->second, 4, where + jointsName);
        const std::vector<float> weights = _accessors.floats(weightsAt->second, 4, where + weightsName);
        if (indices.size() != vertices * 4 || weights.size() != vertices * 4)
            _asset.fail(where + jointsName, std::to_string(vertices) + " elements as POSITION has, and as many weights",
                        std::to_string(indices.size() / 4) + " and " + std::to_string(weights.size() / 4));
        for (std::size_t i = 0; i < indices.size(); ++i) {
            if (i % 4 == 0 && set == 0) first[i / 4] = indices[i];
            if (indices[i] >= joints)
                _asset.fail(where + jointsName, "joints below " + std::to_string(joints), std::to_string(indices[i]));
            if (weights[i] <= 0.0f) continue;
            sums[i / 4] += weights[i];
            (*map)[jointName(std::size_t(skin), indices[i])].emplace_back(unsigned(i / 4), weights[i]);
        }
    }
    // osgAnimation warns of vertices that nothing moves.
    for (std::size_t v = 0; v < vertices; ++v)
        if (sums[v] < 1e-3f) (*map)[jointName(std::size_t(skin), first[v])].emplace_back(unsigned(v), 1.0f);
    for (auto& [name, influence] : *map) influence.setName(name);
    return map;
}

osg::ref_ptr<osgAnimation::RigGeometry> Skins::rig(osg::Geometry* source, int skin, const tinygltf::Primitive& p,
                                                   const std::string& primitive)
{
    const std::size_t vertices = source->getVertexArray()->getNumElements();
    _used[std::size_t(skin)] = true;
    _accessors.spend(vertices * 256, primitive);
    osg::ref_ptr<osgAnimation::RigGeometry> rig = new osgAnimation::RigGeometry;
    rig->setName(source->getName());
    rig->setRigTransformImplementation(new osgAnimation::RigTransformSoftware);
    rig->setInfluenceMap(influences(vertices, skin, p, primitive));
    rig->setSourceGeometry(source);
    rig->copyFrom(*source);
    return rig;
}

}  // namespace osgEnvLight::gltf

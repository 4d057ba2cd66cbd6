// SPDX-License-Identifier: MIT
#include "Directions.h"
#include "MeshBuilder.h"
#include "SceneState.h"

#include "surface/AreaLightPlace.h"
#include "surface/SceneLights.h"

#include <osg/PagedLOD>
#include <osg/ProxyNode>
#include <osgDB/ReadFile>
#include <osgUtil/CullVisitor>
#include <osgUtil/RenderStage>

#include <algorithm>
#include <unordered_map>

#include "glsl.h"
#include "lib/tone.glsl"

namespace osgEnvLight
{

namespace
{

// Loads what a cull asks for, at once.
class ImmediatePager : public osg::NodeVisitor::DatabaseRequestHandler
{
  public:
    void requestNodeFile(const std::string& name, osg::NodePath& path, float, const osg::FrameStamp*,
                         osg::ref_ptr<osg::Referenced>&, const osg::Referenced* options) override
    {
        osg::Group* parent = path.empty() ? nullptr : path.back()->asGroup();
        osg::ref_ptr<osg::Node> node =
            parent ? osgDB::readRefNodeFile(name, dynamic_cast<const osgDB::Options*>(options)) : nullptr;
        if (!node) return;
        parent->addChild(node);
        loaded = true;
    }

    bool loaded = false;
};

// A view's leaves and the state above them.
class Flattener
{
  public:
    Flattener(osg::Node& scene, osg::Camera& camera, const osg::FrameStamp* frame, const SceneReading& reading)
        : _scene(scene), _camera(camera), _frame(frame ? frame : new osg::FrameStamp), _reading(reading)
    {
    }

    TriangleScene flatten()
    {
        cull();
        collect(*_stage);
        findOrigin();
        placeEmitters();
        if (_reading.sceneLights) placePointLights();
        for (const osgUtil::RenderLeaf* leaf : _leaves) append(*leaf);
        for (const TriangleMesh& mesh : _result.meshes) {
            _result.triangles += mesh.triangles.size();
            for (const glm::vec3& p : mesh.positions)
                if (glm::all(glm::lessThan(glm::abs(p), glm::vec3(1e30f))))
                    _result.radius = std::max(_result.radius, double(glm::length(p)));
        }
        for (const auto& [what, count] : _leftOut)
            _result.leftOut.push_back(what + " (" + std::to_string(count) + (count == 1 ? " drawable)" : " drawables)"));
        return std::move(_result);
    }

  private:
    void cull()
    {
        osg::ref_ptr<ImmediatePager> pager = new ImmediatePager;
        // A page may bring further pages; no graph is this deep.
        for (int depth = 0; depth < 64; ++depth) {
            pager->loaded = false;
            _root = new osgUtil::StateGraph;
            _stage = new osgUtil::RenderStage;  // without a viewport: a LitScene on the way draws its children plainly
            const osg::ref_ptr<osgUtil::CullVisitor> cv = new osgUtil::CullVisitor;
            _visitor = cv;  // its end empties its leaves
            cv->setCullingMode(osg::CullSettings::NO_CULLING);
            cv->setComputeNearFarMode(osg::CullSettings::DO_NOT_COMPUTE_NEAR_FAR);
            cv->setLODScale(_camera.getLODScale());
            cv->setTraversalMask(_camera.getCullMask());
            cv->setFrameStamp(const_cast<osg::FrameStamp*>(_frame.get()));
            cv->setTraversalNumber(_frame->getFrameNumber());
            cv->setDatabaseRequestHandler(pager);
            cv->setStateGraph(_root);
            cv->setRenderStage(_stage);
            osg::ref_ptr<osg::Viewport> viewport =
                _camera.getViewport() ? new osg::Viewport(*_camera.getViewport()) : new osg::Viewport(0, 0, 1, 1);
            _projection = new osg::RefMatrix(_camera.getProjectionMatrix());
            cv->pushViewport(viewport);
            cv->pushProjectionMatrix(_projection);
            cv->pushModelViewMatrix(new osg::RefMatrix(_camera.getViewMatrix()), osg::Transform::ABSOLUTE_RF);
            if (_camera.getStateSet()) cv->pushStateSet(_camera.getStateSet());
            _scene.accept(*cv);
            if (_camera.getStateSet()) cv->popStateSet();
            cv->popModelViewMatrix();
            cv->popProjectionMatrix();
            cv->popViewport();
            if (!pager->loaded) break;
        }
    }

    void collect(osgUtil::RenderBin& bin)
    {
        for (osgUtil::StateGraph* graph : bin.getStateGraphList())
            for (const auto& leaf : graph->_leaves) _leaves.push_back(leaf.get());
        // Sorted bins hold their leaves in a list of their own, but only once they are sorted, which is in the draw.
        for (const auto& [number, child] : bin.getRenderBinList()) collect(*child);
    }

    osg::Matrixd worldFromModel(const osgUtil::RenderLeaf& leaf) const
    {
        return osg::Matrixd(*leaf._modelview) * osg::Matrixd::inverse(_camera.getViewMatrix());
    }

    void findOrigin()
    {
        osg::BoundingBoxd box;
        for (const osgUtil::RenderLeaf* leaf : _leaves)
            if (const osg::Geometry* geometry = leaf->getDrawable()->asGeometry())
                expandByTriangles(*geometry, worldFromModel(*leaf), box);
        if (box.valid()) _result.origin = toGlm(box.center());
    }

    osg::Matrixd sceneFromEye() const
    {
        return osg::Matrixd::inverse(_camera.getViewMatrix()) *
               osg::Matrixd::translate(-_result.origin.x, -_result.origin.y, -_result.origin.z);
    }

    void placeEmitters()
    {
        const osg::Matrixd toScene = sceneFromEye();
        for (const MetAreaLight& met : takeAreaLights(*_stage)) {
            Emitter emitter;
            const std::string problem = met.emitter(toScene, emitter);
            std::vector<std::string>& said = _result.leftOut;
            if (!problem.empty() && std::find(said.begin(), said.end(), problem) == said.end()) said.push_back(problem);
            if (!problem.empty() || !(emitter.flux() > 0.0)) continue;
            _areaLights.push_back(met);
            _result.emitters.push_back(std::move(emitter));
        }
    }

    void placePointLights()
    {
        const osg::Matrixd toScene = sceneFromEye();
        const auto xyz = [](const osg::Vec4f& v) { return osg::Vec3d(v[0], v[1], v[2]); };
        for (const SceneLight& light : switchedOn(findSceneLights(*_stage, nullptr, false), findLightModes(*_stage, {}).some)) {
            PointLight p;
            p.directional = light.position[3] == 0.0f;
            p.position =
                toGlm(p.directional ? osg::Matrixd::transform3x3(xyz(light.position), toScene) : xyz(light.position) * toScene);
            const glm::dvec3 color(light.color[0], light.color[1], light.color[2]);
            p.radiance =
                _reading.linearColors ? color : glm::dvec3(glsl::typedDecode3(glsl::vec3(color))) * _reading.emissionScale;
            p.attenuation = toGlm(xyz(light.falloff));
            p.axis = toGlm(osg::Matrixd::transform3x3(xyz(light.spot), toScene));
            p.cosCutoff = double(light.spot[3]);
            p.exponent = double(light.falloff[3]);
            _result.pointLights.push_back(p);
        }
    }

    // Whose surface a leaf is; -1: of none.
    int emitterOf(const osgUtil::RenderLeaf& leaf) const
    {
        const AreaLightPlace* place = AreaLightPlace::of(*leaf.getDrawable());
        const auto found = std::find_if(_areaLights.begin(), _areaLights.end(), [&](const MetAreaLight& met) {
            return met.place == place && met.eyeFromLight == leaf._modelview;
        });
        return found == _areaLights.end() ? -1 : int(found - _areaLights.begin());
    }

    const SceneState& effective(const osgUtil::StateGraph* graph)
    {
        const auto found = _states.find(graph);
        if (found != _states.end()) return found->second;
        SceneState state;
        if (graph->_parent) state = effective(graph->_parent);
        if (graph->getStateSet()) state.merge(*graph->getStateSet());
        return _states.emplace(graph, state).first->second;
    }

    void append(const osgUtil::RenderLeaf& leaf)
    {
        const osg::Geometry* geometry = leaf.getDrawable()->asGeometry();
        if (!geometry) {
            ++_leftOut[std::string("drawables of the class ") + leaf.getDrawable()->libraryName() +
                       "::" + leaf.getDrawable()->className()];
            return;
        }
        if (leaf._projection && osg::Matrixd(*leaf._projection) != osg::Matrixd(*_projection)) {
            ++_leftOut["what has a projection of its own"];
            return;
        }
        const SceneState& state = effective(leaf._parent);
        if (state.shadowCatcher()) {
            ++_leftOut["shadow catchers"];
            return;
        }
        std::set<std::string> leftOut;
        TriangleMesh mesh;
        mesh.emitter = emitterOf(leaf);
        mesh.material = state.material(*geometry, _reading.linearColors, _textures, leftOut);
        if (mesh.emitter < 0) mesh.material.emissionScale = _reading.emissionScale;
        const osg::Vec3d axis = osg::Matrixd::transform3x3(osg::Vec3d(0, 0, 1), worldFromModel(leaf));
        mesh.material.axis = toGlm(axis);
        if (geometry->getDrawCallback()) leftOut.insert("draw callbacks");
        if (!appendTriangles(*geometry, worldFromModel(leaf), state.textureMatrix(), _result.origin, mesh, _result))
            leftOut.insert("points and lines");
        if (mesh.emitter < 0 && !state.drawnForward(geometry)) addLamp(state, mesh, leftOut);
        for (const std::string& what : leftOut) ++_leftOut[what];
        if (!mesh.triangles.empty()) _result.meshes.push_back(std::move(mesh));
    }

    // Of what is no area light all directions find the emission, in time.
    void addLamp(const SceneState& state, TriangleMesh& mesh, std::set<std::string>& leftOut)
    {
        const LampRule rule{std::isfinite(_reading.leastLamp), float(_reading.leastLamp / _reading.emissionScale),
                            !_reading.linearColors};
        const osg::Vec3d radiance = osg::Vec3d(state.lampEmission(rule)) * _reading.emissionScale;
        if (radiance == osg::Vec3d()) return;
        if (mesh.triangles.size() > mostLampTriangles) {
            leftOut.insert("lamps of more than " + std::to_string(mostLampTriangles) + " triangles, in direct light");
            return;
        }
        mesh.lamp = true;
        for (const glm::uvec3& t : mesh.triangles) {
            const auto corner = [&](int k) {
                const glm::vec3& p = mesh.positions[t[k]];
                return osg::Vec3d(double(p.x), double(p.y), double(p.z));
            };
            Emitter e;
            e.shape = AreaLight::POLYGON;
            e.center = (corner(0) + corner(1) + corner(2)) / 3.0;
            for (int k = 0; k < 3; ++k) e.vertices.push_back(corner(k) - e.center);
            e.triangles = {0, 1, 2};
            e.normal = (e.vertices[1] - e.vertices[0]) ^ (e.vertices[2] - e.vertices[0]);
            e.area = 0.5 * e.normal.normalize();
            e.radiance = radiance;
            e.twoSided = !state.culled();
            e.drawn = true;
            if (e.area > 0.0) _result.emitters.push_back(std::move(e));
        }
    }

    // Each is looked at from each point.
    static constexpr size_t mostLampTriangles = 1024;

    osg::Node& _scene;
    osg::Camera& _camera;
    osg::ref_ptr<const osg::FrameStamp> _frame;
    const SceneReading _reading;
    osg::ref_ptr<osgUtil::CullVisitor> _visitor;
    osg::ref_ptr<osgUtil::StateGraph> _root;
    osg::ref_ptr<osgUtil::RenderStage> _stage;
    osg::ref_ptr<osg::RefMatrix> _projection;
    std::vector<const osgUtil::RenderLeaf*> _leaves;
    std::vector<MetAreaLight> _areaLights;  // of the emitters
    std::unordered_map<const osgUtil::StateGraph*, SceneState> _states;
    std::map<std::string, int> _leftOut;
    TextureCache _textures;
    TriangleScene _result;
};

}  // namespace

TriangleScene flattenScene(osg::Node& scene, osg::Camera& camera, const osg::FrameStamp* frame, const SceneReading& reading)
{
    return Flattener(scene, camera, frame, reading).flatten();
}

}  // namespace osgEnvLight

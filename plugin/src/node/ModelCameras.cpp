// SPDX-License-Identifier: MIT
#include <osgEnvLight/ModelCameras>

#include <osg/CameraView>
#include <osg/Math>
#include <osg/NodeVisitor>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace osgEnvLight
{

namespace
{

/** The vertical opening angle, degrees. */
double openingAngle(const osg::CameraView& camera)
{
    double angle = camera.getFieldOfView();
    if (camera.getFieldOfViewMode() == osg::CameraView::HORIZONTAL) {
        constexpr double aspect = 4.0 / 3.0;
        angle = osg::RadiansToDegrees(2.0 * std::atan(std::tan(osg::DegreesToRadians(0.5 * angle)) / aspect));
    }
    return std::isfinite(angle) ? std::clamp(angle, 0.01, 179.0) : HomeView().fovy;
}

class CameraFinder : public osg::NodeVisitor
{
  public:
    explicit CameraFinder(const osg::BoundingSphere& bound) : NodeVisitor(TRAVERSE_ALL_CHILDREN), _bound(bound)
    {
        setNodeMaskOverride(~0u);
    }

    void apply(osg::Transform& node) override
    {
        if (const auto* camera = dynamic_cast<const osg::CameraView*>(&node)) add(*camera);
        traverse(node);
    }

    std::vector<ModelCamera> cameras;

  private:
    // A camera looks along -Z.
    void add(const osg::CameraView& camera)
    {
        const osg::Matrixd place = osg::computeLocalToWorld(getNodePath());
        HomeView view;
        view.eye = place.getTrans();
        osg::Vec3d forward = osg::Matrixd::transform3x3(osg::Vec3d(0, 0, -1), place);
        view.up = osg::Matrixd::transform3x3(osg::Vec3d(0, 1, 0), place);
        // Also of NaN.
        if (!view.eye.valid() || !(forward.normalize() > 0.0) || !(view.up.normalize() > 0.0)) return;
        if (!((forward ^ view.up).length() > 1e-6)) return;
        view.target = view.eye + forward * distance(view.eye, forward);
        view.fovy = openingAngle(camera);
        const std::string number = "camera " + std::to_string(cameras.size() + 1);
        cameras.push_back({camera.getName().empty() ? number : camera.getName(), view});
    }

    double distance(const osg::Vec3d& eye, const osg::Vec3d& forward) const
    {
        if (!_bound.valid() || !(_bound.radius() > 0.0)) return 1.0;
        const double along = (osg::Vec3d(_bound.center()) - eye) * forward;
        return along > 0.01 * double(_bound.radius()) ? along : double(_bound.radius());
    }

    const osg::BoundingSphere _bound;
};

}  // namespace

std::vector<ModelCamera> findModelCameras(osg::Node& scene)
{
    CameraFinder finder(scene.getBound());
    scene.accept(finder);
    return std::move(finder.cameras);
}

std::optional<HomeView> firstModelCamera(osg::Node& scene)
{
    const std::vector<ModelCamera> cameras = findModelCameras(scene);
    return cameras.empty() ? std::nullopt : std::optional<HomeView>(cameras.front().view);
}

HomeView modelCamera(osg::Node& scene, const std::string& name)
{
    const std::vector<ModelCamera> cameras = findModelCameras(scene);
    std::string names;
    for (const ModelCamera& camera : cameras) {
        if (camera.name == name) return camera.view;
        names += (names.empty() ? "'" : ", '") + camera.name + "'";
    }
    throw std::runtime_error("'" + name + "', expected a camera of the model, " +
                             (cameras.empty() ? "which has none" : "which has " + names));
}

}  // namespace osgEnvLight

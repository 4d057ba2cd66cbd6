// SPDX-License-Identifier: MIT
#include "surface/Backdrop.h"

#include "surface/SurfaceState.h"

#include <osg/Drawable>
#include <osg/Matrixd>
#include <osgUtil/RenderLeaf>

#include <algorithm>

namespace osgEnvLight
{

namespace
{

SurfaceState stateOf(const osgUtil::StateGraph& graph)
{
    SurfaceState state;
    if (graph._parent) state = stateOf(*graph._parent);
    if (graph.getStateSet()) state.merge(*graph.getStateSet());
    return state;
}

// The eye stands in it, or at the rim of a dome that ends at the horizon. Nothing flat: a sheet of water has the eye near it,
// too.
bool enclosesEye(const osg::BoundingBox& box, const osg::Matrixd& modelView)
{
    const osg::Vec3d sides(box.xMax() - box.xMin(), box.yMax() - box.yMin(), box.zMax() - box.zMin());
    const double longest = std::max({sides[0], sides[1], sides[2]});
    if (std::min({sides[0], sides[1], sides[2]}) < 0.05 * longest) return false;
    const double margin = 0.1 * longest;
    const osg::Vec3d eye = osg::Vec3d() * osg::Matrixd::inverse(modelView);
    for (int i = 0; i < 3; ++i)
        if (eye[i] < double(box._min[i]) - margin || eye[i] > double(box._max[i]) + margin) return false;
    return true;
}

// A rectangle under a parallel projection of its own, or one whose program takes its vertices for clip coordinates.
bool fillsScreen(const osg::BoundingBox& box, const osgUtil::RenderLeaf& leaf, bool ownProgram)
{
    const double tolerance = 1e-3;
    const osg::Matrixd projection = leaf._projection.valid() ? osg::Matrixd(*leaf._projection) : osg::Matrixd();
    const bool parallel = projection(0, 3) == 0.0 && projection(1, 3) == 0.0 && projection(2, 3) == 0.0;
    if (!parallel && !ownProgram) return false;
    const osg::Matrixd toClip = parallel ? osg::Matrixd(*leaf._modelview) * projection : osg::Matrixd();
    osg::BoundingBoxd clip;
    for (unsigned i = 0; i < 8; ++i) clip.expandBy(osg::Vec3d(box.corner(i)) * toClip);
    return clip.xMin() <= -1.0 + tolerance && clip.yMin() <= -1.0 + tolerance && clip.xMax() >= 1.0 - tolerance &&
           clip.yMax() >= 1.0 - tolerance;
}

// In bins from 0 on, what is blended or writes depth is something in the scene: smoke, rain, a body around the eye.
bool isBackdrop(const osgUtil::StateGraph& graph, const osgUtil::RenderLeaf& leaf, bool negativeBin)
{
    const osg::Drawable* drawable = leaf.getDrawable();
    if (!drawable || !leaf._modelview) return false;
    const osg::BoundingBox box = drawable->getBoundingBox();
    if (!box.valid()) return false;
    // The bounds first: few drawables are so large, and their state costs a walk up the graph.
    const bool encloses = enclosesEye(box, *leaf._modelview);
    if (negativeBin) return encloses || fillsScreen(box, leaf, stateOf(graph).ownProgram());
    if (!encloses) return false;
    const SurfaceState state = stateOf(graph);
    return !state.storesDepth() && !state.blending();
}

std::string backdropIn(const osgUtil::StateGraph& graph, bool negativeBin, const char* where)
{
    for (const auto& leaf : graph._leaves) {
        if (!isBackdrop(graph, *leaf, negativeBin)) continue;
        const std::string& name = leaf->getDrawable()->getName();
        return name.empty() ? std::string("a drawable ") + where : "'" + name + "' " + where;
    }
    return std::string();
}

std::string backdropIn(osgUtil::RenderBin& bin)
{
    for (const osgUtil::StateGraph* graph : bin.getStateGraphList()) {
        const std::string found = backdropIn(*graph, true, "drawn before the node");
        if (!found.empty()) return found;
    }
    for (const auto& [number, child] : bin.getRenderBinList()) {
        const std::string found = backdropIn(*child);
        if (!found.empty()) return found;
    }
    return std::string();
}

}  // namespace

std::string findBackdrop(osgUtil::RenderStage& host, const std::vector<ForwardGraph>& forward)
{
    for (const auto& [number, bin] : host.getRenderBinList()) {
        const std::string found = number < 0 ? backdropIn(*bin) : std::string();
        if (!found.empty()) return found;
    }
    for (const ForwardGraph& f : forward) {
        if (f.bin->getSortMode() == osgUtil::RenderBin::SORT_BACK_TO_FRONT) continue;
        const std::string found = backdropIn(*f.graph, f.bin->getBinNum() < 0, "below the node");
        if (!found.empty()) return found;
    }
    return std::string();
}

}  // namespace osgEnvLight

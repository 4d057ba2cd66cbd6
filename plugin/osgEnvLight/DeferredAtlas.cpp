// SPDX-License-Identifier: MIT
// When the sky shadow atlas of a view is drawn, and with what.
#include <osgEnvLight/DeferredTechnique>

#include <osgUtil/CullVisitor>
#include <osgViewer/View>

namespace osgEnvLight
{

namespace
{

// Where the first frame draws all maps at once instead of a few a frame: as many triangles as a frame of a large model has,
// 256 maps of 40 000 drawn twice.
const double firstFrameTriangles = 2e7;

}  // namespace

ViewData::Atlas& DeferredTechnique::skyAtlas(Cull& c)
{
    return c.view.atlas("atlas", c.view.plan.occlusionLights, unsigned(c.settings.atlasSize));
}

DeferredTechnique::ShadowPlaces DeferredTechnique::placesOf(Cull& c, const ShadowAtlas& atlas)
{
    return {&c.frame.atlasState(atlas, 1.0 / c.view.textures().map().mean), atlas.origin()};
}

void DeferredTechnique::addAtlas(Cull& c, osgUtil::CullVisitor& cv)
{
    if (!c.view.plan.atlas) {
        c.view.dropAtlas("atlas");
        _waitingMaps = 0;
        return;
    }
    ViewData::Atlas& own = skyAtlas(c);
    ShadowAtlas& atlas = *own.maps;
    atlas.setCasters(c.casters);
    const bool atOnce = c.settings.regeneration == Settings::IMMEDIATE ||
                        (atlas.version() == 0 && 2.0 * atlas.lights * double(atlas.triangles()) <= firstFrameTriangles);
    refreshAtlas(c, cv, "atlas", own, c.view.textures().occlusionList(atlas.lights),
                 atOnce ? atlas.lights : unsigned(c.settings.atlasUpdatesPerFrame));
    _waitingMaps = atlas.waiting();
    if (auto* view = dynamic_cast<osgViewer::View*>(cv.getRenderInfo().getView()); view && atlas.waiting() > 0)
        view->requestRedraw();
}

void DeferredTechnique::refreshAtlas(Cull& c, osgUtil::CullVisitor& cv, const std::string& name, ViewData::Atlas& own,
                                     const LightList& list, unsigned budget)
{
    ShadowAtlas& atlas = *own.maps;
    LightList lights = inWorld(c, list);
    lights.resize(atlas.lights, DirectionalLight{osg::Vec3d(0, 0, 1), osg::Vec3d()});  // dark ones
    const std::vector<ShadowRefresh> refreshes = atlas.update(lights, budget);
    if (refreshes.empty()) return;
    addRefresh(c, cv, name, "pass/midpoint.frag", *own.camera, atlas.targets(), refreshes, atlas.drawn());
}

}  // namespace osgEnvLight

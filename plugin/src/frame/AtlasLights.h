/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include "shadow/ShadowAtlas.h"

#include <osgEnvLight/Export>

#include <map>
#include <string>
#include <vector>

namespace osgEnvLight
{

/** The lights of a view's shadow atlases as textures (ShadowAtlas::lightImage). A texture changes only when no draw holds it:
 * another state of an atlas has another one, and a draw thread finishes with the former.*/
class OSGENVLIGHT_EXPORT AtlasLights
{
  public:
    /** @param name   of the atlas
     * @param near   the atlas of the same lights about the view, or null
     * @param scale  that the fluxes are multiplied by */
    osg::Texture2D* texture(const std::string& name, const ShadowAtlas& atlas, const ShadowAtlas* near, double scale);

    /** ShadowAtlas::nearestImage() of an atlas. */
    osg::Texture2D* nearest(const std::string& name, const ShadowAtlas& atlas);

    /** Forget those that were not asked for since the last call. */
    void endFrame();
    size_t bytes() const;
    void resizeGLObjectBuffers(unsigned maximum);
    void releaseGLObjects(osg::State* state) const;

  private:
    struct Entry {
        std::vector<osg::ref_ptr<osg::Texture2D>> textures;  // the last one; before it, those that a draw may still hold
        osg::ref_ptr<const ShadowAtlas> atlas, near;         // that it is of, at which versions and scale
        unsigned version = 0, nearVersion = 0;
        double scale = 0.0;
        bool used = false;
    };
    static osg::Texture2D* kept(Entry& entry);
    static void renew(Entry& entry, osg::Image& image, GLint format);

    std::map<std::string, Entry> _entries;
};

}  // namespace osgEnvLight

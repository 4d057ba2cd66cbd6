// SPDX-License-Identifier: MIT
// What a frame has behind the scene: the map, or what the host has drawn there.
#include "surface/Backdrop.h"
#include "node/DeferredTechnique.h"

#include <osg/GraphicsContext>

#include <utility>

namespace osgEnvLight
{

namespace
{

bool overlaps(const osg::Viewport* a, const osg::Viewport* b)
{
    return a && b && a->x() < b->x() + b->width() && b->x() < a->x() + a->width() && a->y() < b->y() + b->height() &&
           b->y() < a->y() + a->height();
}

// A camera before the host's has cleared these colours and drawn into them: the far part of a depth partition, a backdrop.
bool drawsOverAnother(const osg::Camera* host)
{
    const osg::GraphicsContext* context = host ? host->getGraphicsContext() : nullptr;
    if (!context || (host->getClearMask() & GL_COLOR_BUFFER_BIT)) return false;
    for (const osg::Camera* other : const_cast<osg::GraphicsContext*>(context)->getCameras()) {
        const bool before = std::make_pair(other->getRenderOrder(), other->getRenderOrderNum()) <=
                            std::make_pair(host->getRenderOrder(), host->getRenderOrderNum());
        if (other != host && before && (other->getClearMask() & GL_COLOR_BUFFER_BIT) && other->getBufferAttachmentMap().empty() &&
            host->getBufferAttachmentMap().empty() && overlaps(other->getViewport(), host->getViewport()))
            return true;
    }
    return false;
}

}  // namespace

// What is behind the scene, in words.
std::string DeferredTechnique::chooseBackground(Cull& c, const std::vector<ForwardGraph>& forward) const
{
    c.background = c.settings.background;
    if (c.background == Settings::BACKGROUND_AUTO) {
        const std::string backdrop = findBackdrop(c.host, forward);
        c.background = backdrop.empty() ? Settings::BACKGROUND_ON : Settings::BACKGROUND_OFF;
        if (!backdrop.empty()) return backdrop + " behind";
    }
    if (c.background == Settings::BACKGROUND_OFF) return "the background switched off";
    const bool keepsColors = c.settings.background == Settings::BACKGROUND_AUTO && !(c.host.getClearMask() & GL_COLOR_BUFFER_BIT);
    if (keepsColors || drawsOverAnother(c.host.getCamera())) {
        c.background = Settings::BACKGROUND_OFF;
        return "the colours behind that the host does not clear";
    }
    return c.background == Settings::BACKGROUND_BLUR ? "the map behind, blurred" : "the map behind";
}

}  // namespace osgEnvLight

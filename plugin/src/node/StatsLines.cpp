// SPDX-License-Identifier: MIT
#include "node/StatsLines.h"

#include <osgViewer/ViewerBase>

namespace osgEnvLight
{

namespace
{

osgViewer::StatsHandler* handlerOf(osgViewer::View& view)
{
    for (const osg::ref_ptr<osgGA::EventHandler>& h : view.getEventHandlers())
        if (auto* handler = dynamic_cast<osgViewer::StatsHandler*>(h.get())) return handler;
    return nullptr;
}

osg::Stats* statsOf(osgViewer::View& view)
{
    return view.getViewerBase() ? view.getViewerBase()->getViewerStats() : nullptr;
}

}  // namespace

bool StatsLines::areShown(osgViewer::View& view)
{
    osg::Stats* stats = statsOf(view);
    return stats && stats->collectStats("event") && handlerOf(view);  // as the handler sets it
}

void StatsLines::update(osgViewer::View& view, const Plan& plan, const Average& average)
{
    for (const PassReport& r : plan.passes)
        if (r.cpu >= 0.0)
            show(view, "env " + r.pass, "osgEnvLight " + r.pass + " time taken", 1e-3 * (r.gpu >= 0.0 ? r.gpu : r.cpu), 1000.0f,
                 0.1f);
    if (average.frames > 0 && average.standardError >= 0.0)
        show(view, "env still view, error %", "osgEnvLight standard error", average.standardError, 100.0f, 1.0f);
}

void StatsLines::show(osgViewer::View& view, const std::string& label, const std::string& attribute, double value,
                      float multiplier, float most)
{
    if (_handler.get() != handlerOf(view)) {  // another one starts anew
        _handler = handlerOf(view);
        _attributes.clear();
    }
    osg::ref_ptr<osgViewer::StatsHandler> handler;
    if (!_handler.lock(handler)) return;
    if (_attributes.emplace(label, attribute).second) {
        const osg::Vec4 text(0.6f, 0.9f, 1.0f, 1.0f), bar(0.3f, 0.6f, 0.8f, 0.5f);
        handler->addUserStatsLine(label, text, bar, attribute, multiplier, true, false, "", "", most);
    }
    statsOf(view)->setAttribute(view.getFrameStamp()->getFrameNumber(), attribute, value);
}

StatsLines::~StatsLines()
{
    osg::ref_ptr<osgViewer::StatsHandler> handler;
    if (!_handler.lock(handler)) return;
    for (const auto& [label, attribute] : _attributes) handler->removeUserStatsLine(label);
}

}  // namespace osgEnvLight

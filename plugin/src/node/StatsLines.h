/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include <osgEnvLight/LitScene>

#include <osg/observer_ptr>

#include <osgViewer/View>
#include <osgViewer/ViewerEventHandlers>

#include <map>

namespace osgEnvLight
{

/** What a viewer's StatsHandler shows of the node: a line for each pass, and the standard error of a still view that is
 * averaged. Added when the handler first shows its viewer's times, taken away again with this. */
class OSGENVLIGHT_EXPORT StatsLines : public osg::Referenced
{
  public:
    /** Whether a handler of the view shows its viewer's times, and wants those of the passes. */
    static bool areShown(osgViewer::View& view);

    /** Writes this frame's values and adds the lines that are missing. */
    void update(osgViewer::View& view, const Plan& plan, const Average& average);

  protected:
    ~StatsLines() override;

  private:
    void show(osgViewer::View& view, const std::string& label, const std::string& attribute, double value, float multiplier,
              float most);

    osg::observer_ptr<osgViewer::StatsHandler> _handler;
    std::map<std::string, std::string> _attributes;  // by label
};

}  // namespace osgEnvLight

// SPDX-License-Identifier: MIT
#include <osgEnvLight/LitScene>

#include "node/DeferredTechnique.h"
#include "node/StatsLines.h"

#include <osg/Notify>
#include <osgDB/DatabasePager>
#include <osgGA/EventVisitor>
#include <osgUtil/CullVisitor>
#include <osgUtil/GLObjectsVisitor>
#include <osgViewer/View>

#include <atomic>

namespace osgEnvLight
{

// What the node does besides lighting in a host's frame: keys, home position, statistics, and asking for frames.
class LitScene::Implementation
{
  public:
    explicit Implementation(LitScene& node) : technique(new DeferredTechnique), _node(node) {}

    void handleEvents(osgGA::EventVisitor& ev);
    void goHome(osgGA::EventVisitor& ev);
    void askForUpdates(bool needed);
    void followFrame(osg::NodeVisitor& nv);
    void showStats(osgGA::EventVisitor& ev);
    bool playsImages() const { return _node._map->getImage() && _node._map->getImage()->requiresUpdateCall(); }
    bool asksForFrames() const { return _asksForFrames; }
    bool showsTimes() const { return _showsTimes; }

    const osg::ref_ptr<DeferredTechnique> technique;

  private:
    static bool wantsUpdates(osg::Node& node);

    LitScene& _node;
    bool _homeGiven = false;
    osg::ref_ptr<StatsLines> _statsLines;
    std::atomic<bool> _showsTimes{false};  // written in the event traversal, read in cull
    bool _updates = false;
    bool _asksForFrames = false;
    unsigned _followedFrame = ~0u;  // another one follows it, whatever its cull finds
};

LitScene::LitScene() : _map(new EnvironmentMap), _settings(new Settings), _implementation(new Implementation(*this))
{
    setCullingActive(false);  // the background shows where the bound does not
    setNumChildrenRequiringEventTraversal(getNumChildrenRequiringEventTraversal() + 1);
}

LitScene::LitScene(osg::Image* image) : LitScene()
{
    if (image)
        _map->setImage(image);
    else
        OSG_WARN << "osgEnvLight: LitScene was given a null image (a file that was not read?); the built-in sky lights instead"
                 << std::endl;
}

LitScene::LitScene(const LitScene& other, const osg::CopyOp& copyop)
    : osg::Group(other, copyop),
      _map(new EnvironmentMap(*other._map, copyop)),
      _settings(new Settings(*other._settings, copyop)),
      _homeView(other._homeView),
      _timed(other._timed),
      _implementation(new Implementation(*this))
{
    setCullingActive(false);
    setNumChildrenRequiringEventTraversal(getNumChildrenRequiringEventTraversal() + 1);
}

LitScene::~LitScene() = default;

void LitScene::setEnvironmentMap(EnvironmentMap* map)
{
    _map = map ? map : new EnvironmentMap;
}

void LitScene::setSettings(Settings* settings)
{
    _settings = settings ? settings : new Settings;
}

bool LitScene::isTimed() const
{
    return _timed || _implementation->showsTimes();
}

Plan LitScene::plan() const
{
    return _implementation->technique->plan();
}

unsigned LitScene::numViews() const
{
    return _implementation->technique->numViews();
}

size_t LitScene::textureBytes() const
{
    return _implementation->technique->bytes();
}

bool LitScene::regenerating() const
{
    return _implementation->technique->regenerating();
}

Average LitScene::average() const
{
    return _implementation->technique->average();
}

unsigned LitScene::drawnSunMaps() const
{
    return _implementation->technique->drawnSunMaps();
}

void LitScene::reloadShaders()
{
    _implementation->technique->reloadShaders();
}

void LitScene::traverse(osg::NodeVisitor& nv)
{
    Implementation& own = *_implementation;
    if (nv.getVisitorType() == osg::NodeVisitor::CULL_VISITOR) {
        osgUtil::CullVisitor* cv = nv.asCullVisitor();
        if (cv && own.technique->cull(*this, *cv)) return;
    }
    if (dynamic_cast<osgUtil::GLObjectsVisitor*>(&nv)) own.technique->lookBeforeUpload(*this);
    const bool plays = own.playsImages();
    const bool events = nv.getVisitorType() == osg::NodeVisitor::EVENT_VISITOR;
    if (events || nv.getVisitorType() == osg::NodeVisitor::UPDATE_VISITOR) {
        own.followFrame(nv);
        own.askForUpdates(plays || own.asksForFrames());
    }
    // A sequence of images goes on by this call; for a texture in the graph, OSG would make it.
    if (nv.getVisitorType() == osg::NodeVisitor::UPDATE_VISITOR && plays) _map->getImage()->update(&nv);
    if (nv.getVisitorType() == osg::NodeVisitor::EVENT_VISITOR && nv.asEventVisitor()) {
        own.goHome(*nv.asEventVisitor());
        own.handleEvents(*nv.asEventVisitor());
        own.showStats(*nv.asEventVisitor());
    }
    osg::Group::traverse(nv);
}

namespace
{

// Whether the host or the application has asked for this frame, other than by nodes that want to be updated.
bool isAskedFor(osgGA::EventVisitor& ev)
{
    for (const auto& event : ev.getEvents()) {
        const osgGA::GUIEventAdapter* ea = event->asGUIEventAdapter();
        if (!ea || ea->getEventType() != osgGA::GUIEventAdapter::FRAME) return true;
    }
    auto* view = dynamic_cast<osgViewer::View*>(ev.getActionAdapter());
    if (!view) return false;
    const osgViewer::ViewerBase* viewer = view->getViewerBase();
    const osgDB::DatabasePager* pager = view->getDatabasePager();
    return (viewer && (viewer->getRequestRedraw() || viewer->getRequestContinousUpdate())) ||
           (pager && (pager->requiresUpdateSceneGraph() || pager->requiresRedraw()));
}

}  // namespace

// Whether a node wants to be updated, or one below it, for another reason than a LitScene that asks for frames.
bool LitScene::Implementation::wantsUpdates(osg::Node& node)
{
    if (node.getUpdateCallback()) return true;
    const unsigned wanted = node.getNumChildrenRequiringUpdateTraversal();
    if (wanted == 0) return false;
    const auto* lit = dynamic_cast<const LitScene*>(&node);
    if (lit && lit->_implementation->playsImages()) return true;
    unsigned known = lit && lit->_implementation->_updates ? 1 : 0;
    osg::Group* group = node.asGroup();
    for (unsigned i = 0; group && i < group->getNumChildren() && known < wanted; ++i) {
        osg::Node& child = *group->getChild(i);
        if (wantsUpdates(child)) return true;
        if (child.getNumChildrenRequiringUpdateTraversal() > 0) ++known;
    }
    return known < wanted;
}

// A viewer that draws on demand draws as long as a node wants to be updated. A redraw requested in cull would be forgotten at the
// end of the same frame, and the counts of nodes that want to be updated are not for cull threads. So a frame is followed by
// another, in which it is known what its cull found, and that one by more while the light settles; but not a frame for which only
// LitScenes have asked, or two would keep each other awake.
void LitScene::Implementation::followFrame(osg::NodeVisitor& nv)
{
    if (!nv.getFrameStamp()) return;
    const unsigned frame = nv.getFrameStamp()->getFrameNumber();
    if (osgGA::EventVisitor* ev = nv.asEventVisitor()) {
        const auto* view = dynamic_cast<osgViewer::View*>(ev->getActionAdapter());
        osg::Node& scene = view && view->getSceneData() ? const_cast<osg::Node&>(*view->getSceneData()) : _node;
        if (isAskedFor(*ev) || scene.getNumChildrenRequiringUpdateTraversal() == 0 || wantsUpdates(scene)) _followedFrame = frame;
        _asksForFrames = _asksForFrames || frame == _followedFrame || technique->unsettled();
    } else {
        technique->countUpdate();
        _asksForFrames = frame == _followedFrame || technique->unsettled();
    }
}

// Only while there is something to update: a viewer that draws on demand would draw all the time.
void LitScene::Implementation::askForUpdates(bool needed)
{
    if (needed == _updates) return;
    _updates = needed;
    const unsigned others = _node.getNumChildrenRequiringUpdateTraversal() - (needed ? 0 : 1);
    _node.setNumChildrenRequiringUpdateTraversal(needed ? others + 1 : others);
}

void LitScene::Implementation::goHome(osgGA::EventVisitor& ev)
{
    if (!_node._homeView || _homeGiven) return;
    auto* view = dynamic_cast<osgViewer::View*>(ev.getActionAdapter());
    const osgGA::GUIEventAdapter* event = ev.getEvents().empty() ? nullptr : ev.getEvents().front()->asGUIEventAdapter();
    if (!view || !view->getCameraManipulator() || !event) return;
    _homeGiven = true;
    double fovy, aspect, near, far;
    if (view->getCamera()->getProjectionMatrixAsPerspective(fovy, aspect, near, far))
        view->getCamera()->setProjectionMatrixAsPerspective(_node._homeView->fovy, aspect, near, far);
    view->getCameraManipulator()->setHomePosition(_node._homeView->eye, _node._homeView->target, _node._homeView->up);
    view->getCameraManipulator()->home(*event, *view);
}

void LitScene::Implementation::showStats(osgGA::EventVisitor& ev)
{
    auto* view = dynamic_cast<osgViewer::View*>(ev.getActionAdapter());
    _showsTimes = view && StatsLines::areShown(*view);
    if (!_showsTimes) return;
    if (!_statsLines) _statsLines = new StatsLines;
    _statsLines->update(*view, technique->plan(), technique->average());
}

void LitScene::Implementation::handleEvents(osgGA::EventVisitor& ev)
{
    for (const auto& event : ev.getEvents()) {
        const osgGA::GUIEventAdapter* ea = event->asGUIEventAdapter();
        if (!ea || ea->getHandled() || ea->getEventType() != osgGA::GUIEventAdapter::KEYDOWN) continue;
        if (ea->getKey() == 'V')
            _node._settings->view = (_node._settings->view + 1) % Settings::NUM_VIEWS;
        else if (ea->getKey() == 'R')
            technique->reloadShaders();
        else
            continue;
        ea->setHandled(true);
    }
}

void LitScene::resizeGLObjectBuffers(unsigned maximum)
{
    osg::Group::resizeGLObjectBuffers(maximum);
    _implementation->technique->resizeGLObjectBuffers(maximum);
}

void LitScene::releaseGLObjects(osg::State* state) const
{
    osg::Group::releaseGLObjects(state);
    _implementation->technique->releaseGLObjects(state);
}

}  // namespace osgEnvLight

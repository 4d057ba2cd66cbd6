// SPDX-License-Identifier: MIT
#include <osgEnvLight/LitScene>

#include <osgEnvLight/StatsLines>

#include <osg/Notify>
#include <osgDB/DatabasePager>
#include <osgGA/EventVisitor>
#include <osgUtil/CullVisitor>
#include <osgUtil/GLObjectsVisitor>
#include <osgViewer/View>

namespace osgEnvLight
{

LitScene::LitScene() : _map(new EnvironmentMap), _settings(new Settings), _technique(new DeferredTechnique)
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
      _technique(new DeferredTechnique),
      _homeView(other._homeView),
      _timed(other._timed)
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

void LitScene::traverse(osg::NodeVisitor& nv)
{
    if (nv.getVisitorType() == osg::NodeVisitor::CULL_VISITOR) {
        osgUtil::CullVisitor* cv = nv.asCullVisitor();
        if (cv && _technique->cull(*this, *cv)) return;
    }
    if (dynamic_cast<osgUtil::GLObjectsVisitor*>(&nv)) _technique->lookBeforeUpload(*this);
    const bool plays = playsImages();
    const bool events = nv.getVisitorType() == osg::NodeVisitor::EVENT_VISITOR;
    if (events || nv.getVisitorType() == osg::NodeVisitor::UPDATE_VISITOR) {
        followFrame(nv);
        askForUpdates(plays || _asksForFrames);
    }
    // A sequence of images goes on by this call; for a texture in the graph, OSG would make it.
    if (nv.getVisitorType() == osg::NodeVisitor::UPDATE_VISITOR && plays) _map->getImage()->update(&nv);
    if (nv.getVisitorType() == osg::NodeVisitor::EVENT_VISITOR && nv.asEventVisitor()) {
        if (_homeView && !_homeGiven) goHome(*nv.asEventVisitor());
        handleEvents(*nv.asEventVisitor());
        showStats(*nv.asEventVisitor());
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
bool LitScene::wantsUpdates(osg::Node& node)
{
    if (node.getUpdateCallback()) return true;
    const unsigned wanted = node.getNumChildrenRequiringUpdateTraversal();
    if (wanted == 0) return false;
    const auto* lit = dynamic_cast<const LitScene*>(&node);
    if (lit && lit->playsImages()) return true;
    unsigned known = lit && lit->_updates ? 1 : 0;
    osg::Group* group = node.asGroup();
    for (unsigned i = 0; group && i < group->getNumChildren() && known < wanted; ++i) {
        osg::Node& child = *group->getChild(i);
        if (wantsUpdates(child)) return true;
        if (child.getNumChildrenRequiringUpdateTraversal() > 0) ++known;
    }
    return known < wanted;
}

bool LitScene::playsImages() const
{
    return _map->getImage() && _map->getImage()->requiresUpdateCall();
}

// A viewer that draws on demand draws as long as a node wants to be updated. A redraw requested in cull would be forgotten at the
// end of the same frame, and the counts of nodes that want to be updated are not for cull threads. So a frame is followed by
// another, in which it is known what its cull found, and that one by more while the light settles; but not a frame for which only
// LitScenes have asked, or two would keep each other awake.
void LitScene::followFrame(osg::NodeVisitor& nv)
{
    if (!nv.getFrameStamp()) return;
    const unsigned frame = nv.getFrameStamp()->getFrameNumber();
    if (osgGA::EventVisitor* ev = nv.asEventVisitor()) {
        const auto* view = dynamic_cast<osgViewer::View*>(ev->getActionAdapter());
        osg::Node& scene = view && view->getSceneData() ? const_cast<osg::Node&>(*view->getSceneData()) : *this;
        if (isAskedFor(*ev) || scene.getNumChildrenRequiringUpdateTraversal() == 0 || wantsUpdates(scene)) _followedFrame = frame;
        _asksForFrames = _asksForFrames || frame == _followedFrame || _technique->unsettled();
    } else {
        _technique->countUpdate();
        _asksForFrames = frame == _followedFrame || _technique->unsettled();
    }
}

// Only while there is something to update: a viewer that draws on demand would draw all the time.
void LitScene::askForUpdates(bool needed)
{
    if (needed == _updates) return;
    _updates = needed;
    const unsigned others = getNumChildrenRequiringUpdateTraversal() - (needed ? 0 : 1);
    setNumChildrenRequiringUpdateTraversal(needed ? others + 1 : others);
}

void LitScene::goHome(osgGA::EventVisitor& ev)
{
    auto* view = dynamic_cast<osgViewer::View*>(ev.getActionAdapter());
    const osgGA::GUIEventAdapter* event = ev.getEvents().empty() ? nullptr : ev.getEvents().front()->asGUIEventAdapter();
    if (!view || !view->getCameraManipulator() || !event) return;
    _homeGiven = true;
    double fovy, aspect, near, far;
    if (view->getCamera()->getProjectionMatrixAsPerspective(fovy, aspect, near, far))
        view->getCamera()->setProjectionMatrixAsPerspective(_homeView->fovy, aspect, near, far);
    view->getCameraManipulator()->setHomePosition(_homeView->eye, _homeView->target, _homeView->up);
    view->getCameraManipulator()->home(*event, *view);
}

void LitScene::showStats(osgGA::EventVisitor& ev)
{
    auto* view = dynamic_cast<osgViewer::View*>(ev.getActionAdapter());
    _showsTimes = view && StatsLines::areShown(*view);
    if (!_showsTimes) return;
    if (!_statsLines) _statsLines = new StatsLines;
    _statsLines->update(*view, passTimes(), average());
}

void LitScene::handleEvents(osgGA::EventVisitor& ev)
{
    for (const auto& event : ev.getEvents()) {
        const osgGA::GUIEventAdapter* ea = event->asGUIEventAdapter();
        if (!ea || ea->getHandled() || ea->getEventType() != osgGA::GUIEventAdapter::KEYDOWN) continue;
        if (ea->getKey() == 'V')
            _settings->view = (_settings->view + 1) % Settings::NUM_VIEWS;
        else if (ea->getKey() == 'R')
            reloadShaders();
        else
            continue;
        ea->setHandled(true);
    }
}

void LitScene::resizeGLObjectBuffers(unsigned maximum)
{
    osg::Group::resizeGLObjectBuffers(maximum);
    _technique->resizeGLObjectBuffers(maximum);
}

void LitScene::releaseGLObjects(osg::State* state) const
{
    osg::Group::releaseGLObjects(state);
    _technique->releaseGLObjects(state);
}

}  // namespace osgEnvLight

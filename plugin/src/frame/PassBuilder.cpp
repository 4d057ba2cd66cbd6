// SPDX-License-Identifier: MIT
#include "frame/PassBuilder.h"

#include "base/Limits.h"
#include "frame/FrameContext.h"
#include "frame/FrameGraph.h"

#include <stdexcept>

namespace osgEnvLight
{

TextureId PassBuilder::create(const std::string& name, const TextureDesc& desc)
{
    const char* pass = _graph._nodes[size_t(_pass)].pass->name();
    if (find(name).valid()) throw std::runtime_error(std::string(pass) + " makes '" + name + "', which another pass makes too");
    FrameGraph::Resource resource;
    resource.name = name;
    resource.desc = desc;
    resource.maker = _pass;
    _graph._resources.push_back(resource);
    return find(name);
}

TextureId PassBuilder::find(const std::string& name) const
{
    TextureId id;
    for (size_t i = 0; i < _graph._resources.size(); ++i)
        if (_graph._resources[i].name == name) id._index = int(i);
    return id;
}

TextureId PassBuilder::import(const std::string& name, osg::Texture2D* texture)
{
    _graph.import(name, texture);
    return find(name);
}

void PassBuilder::read(TextureId texture, const std::string& sampler)
{
    if (!texture.valid())
        throw std::runtime_error(std::string(_graph._nodes[size_t(_pass)].pass->name()) + " reads " + sampler +
                                 ", which no pass before it makes");
    _graph._resources[size_t(texture._index)].readers.push_back(_pass);
    _inputs.samplers.push_back({sampler, texture, nullptr});
}

bool PassBuilder::read(const std::string& texture, const std::string& sampler)
{
    const TextureId id = find(texture);
    if (id.valid()) read(id, sampler);
    return id.valid();
}

void PassBuilder::bind(osg::Texture* texture, const std::string& sampler)
{
    _inputs.samplers.push_back({sampler, TextureId(), texture});
}

void PassBuilder::write(TextureId texture, const std::array<float, 4>& elsewhere)
{
    _inputs.targets.push_back({texture, elsewhere, true});
}

void PassBuilder::addTo(TextureId texture)
{
    drawOver(texture);
    _inputs.adds = true;
}

void PassBuilder::addLaterTo(TextureId texture)
{
    _graph._resources[size_t(texture._index)].lateAdders.push_back(_pass);
    _inputs.targets.push_back({texture, {}, false});
    _inputs.adds = true;
}

void PassBuilder::drawOver(TextureId texture)
{
    _graph._resources[size_t(texture._index)].adders.push_back(_pass);
    _inputs.targets.push_back({texture, {}, false});
}

void PassBuilder::mark(TextureId marks)
{
    _inputs.marks = marks;
    _inputs.writesMarks = true;
}

void PassBuilder::testMarks(TextureId marks, osg::Depth::Function test, float depth)
{
    if (!marks.valid())
        throw std::runtime_error(std::string(_graph._nodes[size_t(_pass)].pass->name()) +
                                 " draws marked pixels, which no pass before it marks");
    _graph._resources[size_t(marks._index)].readers.push_back(_pass);
    _inputs.marks = marks;
    _inputs.markTest = test;
    _inputs.drawnDepth = depth;
}

void PassBuilder::drawMarked(TextureId marks, float mark)
{
    testMarks(marks, osg::Depth::GREATER, mark + 0.5f * limits::MARK_STEP);
}

void PassBuilder::drawOnly(TextureId marks, float mark)
{
    testMarks(marks, osg::Depth::EQUAL, mark);
}

void PassBuilder::drawUnmarked(TextureId marks)
{
    testMarks(marks, osg::Depth::LESS, limits::MARK_NONE - 0.5f * limits::MARK_STEP);
}

void PassBuilder::triangle(const std::function<osg::ref_ptr<FullScreen>()>& make, const std::function<void(FullScreen&)>& prepare)
{
    _inputs.makeTriangle = make;
    _inputs.prepareTriangle = prepare;
}

void PassBuilder::settings(SettingsGroup group)
{
    frameUniforms(&_context.frame.settingsState(group, _context.settings));
}

StateSets& PassBuilder::states()
{
    return _graph._states;
}

void PassBuilder::readGBuffer()
{
    read("albedo", "albedoMap");
    read("normal", "normalMap");
    read("specular properties", "specularMap");
    read("depth", "depthMap");
    defineKinds(_context.facts.surfaces.lobes);
}

void PassBuilder::defineKinds(unsigned lobes)
{
    define("HAS_COATS", (lobes & SurfaceKinds::COATS) != 0);
    define("HAS_ANISOTROPY", (lobes & SurfaceKinds::ANISOTROPY) != 0);
    define("HAS_EDGES", (lobes & SurfaceKinds::EDGES) != 0);
    define("HAS_ROUGH_DIFFUSE", (lobes & SurfaceKinds::ROUGH_DIFFUSE) != 0);
}

}  // namespace osgEnvLight

// SPDX-License-Identifier: MIT
#include "frame/FrameGraph.h"

#include "base/Limits.h"
#include "frame/FrameContext.h"
#include "surface/SurfaceState.h"

#include <osg/BlendFunc>
#include <osg/Depth>
#include <osg/PolygonMode>
#include <osgUtil/CullVisitor>

#include <algorithm>
#include <limits>
#include <stdexcept>

namespace osgEnvLight
{

namespace
{

const unsigned firstForwardUnit = SurfaceState::units;  // beyond those of the surfaces
const int endOfFrame = std::numeric_limits<int>::max() - 1;

// Against the host's depth, or against marks.
osg::ref_ptr<osg::Depth> depthTest(const PassInputs& in, bool reversed)
{
    if (in.toHost) return new osg::Depth(reversed ? osg::Depth::GEQUAL : osg::Depth::LEQUAL);
    if (!in.marks.valid()) return new osg::Depth(osg::Depth::ALWAYS, 0, 1, false);
    if (in.writesMarks) return new osg::Depth(osg::Depth::ALWAYS);
    const auto z = double(in.drawnDepth);
    return new osg::Depth(in.markTest, z, z, false);
}

}  // namespace

void FrameGraph::run(FrameContext& c)
{
    begin(c);
    setUp(c);
    dropUnread();
    const std::vector<int> sequence = order();
    allocate(sequence, c);
    for (const int i : sequence) draw(_nodes[size_t(i)], c);
    _pool.endFrame();
    _states.endFrame();
    _nodes.clear();  // they hold textures
    _resources.clear();
}

void FrameGraph::begin(FrameContext& c)
{
    _nodes.clear();
    _resources.clear();
    _report.clear();
    _pool.beginFrame();
    import("albedo", c.gbuffer.albedo.get());
    import("normal", c.gbuffer.normal.get());
    import("specular properties", c.gbuffer.specular.get());
    import("depth", c.gbuffer.depth.get());
    import("emission", c.gbuffer.emission.get());
}

void FrameGraph::import(const std::string& name, osg::Texture2D* texture)
{
    Resource r;
    r.name = name;
    r.texture = texture;
    r.outside = true;
    _resources.push_back(r);
}

void FrameGraph::setUp(FrameContext& c)
{
    for (const auto& pass : _passes) {
        const Requirement required = pass->require(c);
        PassReport report;
        report.pass = pass->name();
        report.runs = required.needed;
        report.reason = required.reason;
        _report.push_back(report);
        if (required.needed)
            pass->update(c);
        else
            pass->dismiss(c);
    }
    _nodes.resize(_passes.size());
    for (size_t i = 0; i < _passes.size(); ++i) {
        _nodes[i].pass = _passes[i].get();
        if (!_report[i].runs) continue;
        PassBuilder builder(*this, c, int(i), _nodes[i].inputs);
        _passes[i]->setup(builder, c);
        _report[i].reason += c.takeRemark();
    }
}

// Those draw that draw for the host or of their own accord, and all whose results these read.
void FrameGraph::dropUnread()
{
    std::vector<size_t> waiting;
    const auto enliven = [&](size_t i) {
        if (_nodes[i].draws || _nodes[i].inputs.keepsContents) return;
        _nodes[i].draws = true;
        waiting.push_back(i);
    };
    for (size_t i = 0; i < _nodes.size(); ++i) {
        const PassInputs& in = _nodes[i].inputs;
        if (in.toHost || in.filled || in.drawsAlways || in.makeTriangle || !in.customDraws.empty()) enliven(i);
    }
    while (!waiting.empty()) {
        const size_t reader = waiting.back();
        const PassInputs& in = _nodes[reader].inputs;
        waiting.pop_back();
        std::vector<TextureId> ids;
        if (in.marks.valid()) ids.push_back(in.marks);
        for (const PassInputs::Target& t : in.targets) ids.push_back(t.id);
        for (const PassInputs::Sampler& s : in.samplers)
            if (s.id.valid()) ids.push_back(s.id);
        for (const TextureId id : ids) {
            const Resource& r = _resources[size_t(id._index)];
            if (r.maker >= 0) enliven(size_t(r.maker));
            for (const int adder : r.adders) enliven(size_t(adder));
            for (const int adder : r.lateAdders)
                if (size_t(adder) < reader) enliven(size_t(adder));
        }
    }
}

// What is made comes before what is added to it, and that before what reads it; what is added later, after the readers before it.
// Else as the passes were added.
std::vector<int> FrameGraph::order() const
{
    std::vector<std::vector<int>> before(_nodes.size());
    const auto follows = [&](int later, int earlier) {
        if (earlier >= 0 && later != earlier) before[size_t(later)].push_back(earlier);
    };
    for (const Resource& r : _resources) {
        for (const int adder : r.adders) follows(adder, r.maker);
        for (const int adder : r.lateAdders) {
            follows(adder, r.maker);
            for (const int other : r.adders) follows(adder, other);
        }
        for (const int reader : r.readers) {
            follows(reader, r.maker);
            for (const int adder : r.adders) follows(reader, adder);
            for (const int adder : r.lateAdders) adder < reader ? follows(reader, adder) : follows(adder, reader);
        }
    }
    std::vector<int> sequence;
    std::vector<bool> done(_nodes.size());
    for (size_t i = 0; i < _nodes.size(); ++i) done[i] = !_nodes[i].draws;
    const auto isReady = [&](size_t i) {
        return !done[i] && std::all_of(before[i].begin(), before[i].end(), [&](int b) { return done[size_t(b)]; });
    };
    while (std::find(done.begin(), done.end(), false) != done.end()) {
        size_t next = 0;
        while (next < _nodes.size() && !isReady(next)) ++next;
        if (next == _nodes.size()) {
            std::string names;
            for (size_t i = 0; i < _nodes.size(); ++i)
                if (!done[i]) names += std::string(names.empty() ? "" : ", ") + _nodes[i].pass->name();
            throw std::runtime_error("passes wait for each other: " + names);
        }
        done[next] = true;
        sequence.push_back(int(next));
    }
    return sequence;
}

void FrameGraph::allocate(const std::vector<int>& sequence, const FrameContext& c)
{
    std::vector<int> position(_nodes.size(), -1);
    for (size_t i = 0; i < sequence.size(); ++i) position[size_t(sequence[i])] = int(i);
    struct Span {
        Resource* resource;
        int first, last;
    };
    std::vector<Span> spans;
    for (Resource& r : _resources) {
        if (r.outside) continue;
        const int first = position[size_t(r.maker)];
        if (first < 0 && !r.desc.kept) continue;
        int last = first;
        for (const auto* users : {&r.adders, &r.lateAdders, &r.readers})
            for (const int user : *users) {
                const PassInputs& in = _nodes[size_t(user)].inputs;
                last = std::max(last, in.toHost || in.filled ? endOfFrame : position[size_t(user)]);
            }
        spans.push_back({&r, first, last});
    }
    std::stable_sort(spans.begin(), spans.end(), [](const Span& a, const Span& b) { return a.first < b.first; });
    for (const Span& s : spans) {
        const TextureDesc& d = s.resource->desc;
        const auto texels = [&](int pixels) { return d.side ? d.side : d.half ? (pixels + 1) / 2 : pixels; };
        const TexturePool::Size size{d.format, texels(c.width()), texels(c.height()), d.linear};
        s.resource->texture = d.kept ? _pool.kept(s.resource->name, size) : _pool.transient(size, s.first, s.last);
    }
}

std::vector<StateSets::Sampler> FrameGraph::samplers(const Node& node) const
{
    std::vector<StateSets::Sampler> all;
    std::string names;
    for (const PassInputs::Sampler& s : node.inputs.samplers) {
        osg::ref_ptr<osg::Texture> texture = s.bound;
        if (s.id.valid()) texture = _resources[size_t(s.id._index)].texture.get();
        if (!texture) throw std::runtime_error(std::string(node.pass->name()) + " reads " + s.name + ", which no pass draws");
        all.push_back({s.name, texture});
        names += " " + s.name;
    }
    if (all.size() > mostUnits)
        throw std::runtime_error(std::string(node.pass->name()) + " reads " + std::to_string(all.size()) +
                                 " textures, expected at most " + std::to_string(mostUnits) + ":" + names);
    return all;
}

osg::StateSet& FrameGraph::stateOf(const Node& node, FrameContext& c)
{
    const PassInputs& in = node.inputs;
    const std::string name = node.pass->name();
    const bool reversed = in.toHost && c.depth.reversed;
    const std::vector<StateSets::Sampler> all = samplers(node);
    const std::string mark =
        in.drawsMarked() ? " of marks " + std::to_string(in.markTest) + " " + std::to_string(in.drawnDepth) : "";
    StateSets::Key key{
        name + (in.adds ? " adds" : "") + (in.blendsOverHost ? " over" : "") + (reversed ? " reversed" : "") + mark,
        in.defines,
        {}};
    for (const StateSets::Sampler& s : all) key.objects.push_back(s.texture.get());
    for (const auto& u : in.uniforms) key.objects.push_back(u.get());
    const StateSets::State state = _states.get(key);
    osg::StateSet& s = state.stateSet;
    if (!state.isNew) return s;
    s.setName("osgEnvLight " + name);
    for (const std::string& d : in.defines) s.setDefine(d);
    for (const auto& u : in.uniforms) s.addUniform(u.get());
    const std::string folder = "pass/";
    s.setAttribute(c.shaders.program(folder + node.pass->vertexShader() + ".vert", folder + node.pass->shader() + ".frag"),
                   fixedOn);
    for (GLenum mode : {GLenum(GL_BLEND), GLenum(GL_CULL_FACE), GLenum(GL_LIGHTING), GLenum(GL_ALPHA_TEST)})
        s.setMode(mode, fixedOff);
    for (GLenum plane = GL_CLIP_PLANE0; plane < GL_CLIP_PLANE0 + 6; ++plane) s.setMode(plane, fixedOff);
    if (in.adds) s.setAttributeAndModes(new osg::BlendFunc(GL_ONE, GL_ONE), fixedOn);
    if (in.blendsOverHost) s.setAttributeAndModes(new osg::BlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA), fixedOn);
    s.setAttribute(new osg::PolygonMode, fixedOn);
    s.setAttributeAndModes(depthTest(in, reversed), in.toHost || in.marks.valid() ? fixedOn : fixedOff);
    for (unsigned unit = 0; unit < all.size(); ++unit) StateSets::bind(s, unit, all[unit]);
    return s;
}

void FrameGraph::fill(const Node& node, osg::StateSet& state) const
{
    const std::vector<StateSets::Sampler> all = samplers(node);
    for (const std::string& d : node.inputs.defines) state.setDefine(d);
    for (const auto& u : node.inputs.uniforms) state.addUniform(u.get());
    for (const auto& set : node.inputs.frameUniforms)
        for (const auto& [name, uniform] : set->getUniformList()) state.addUniform(uniform.first);
    for (unsigned i = 0; i < all.size(); ++i) StateSets::bind(state, firstForwardUnit + i, all[i]);
}

std::vector<osg::ref_ptr<osg::Texture2D>> FrameGraph::targetsOf(const Node& node) const
{
    std::vector<osg::ref_ptr<osg::Texture2D>> targets;
    for (const PassInputs::Target& t : node.inputs.targets) targets.push_back(_resources[size_t(t.id._index)].texture);
    return targets;
}

// Where only marked pixels are drawn, the others must not show what was drawn into the texture before.
std::vector<FullScreen::Clear> FrameGraph::clearsOf(const Node& node) const
{
    std::vector<FullScreen::Clear> clears;
    const PassInputs& in = node.inputs;
    if (!in.drawsMarked()) return clears;
    for (size_t i = 0; i < in.targets.size(); ++i) {
        const bool integers = _resources[size_t(in.targets[i].id._index)].desc.format == GL_RGBA32UI_EXT;
        if (in.targets[i].cleared) clears.push_back({int(i), in.targets[i].elsewhere, integers});
    }
    return clears;
}

void FrameGraph::draw(const Node& node, FrameContext& c)
{
    for (const CustomDraw& d : node.inputs.customDraws) {
        StageDraw& stage = c.frame.draw(d.name, [&] { return d.drawable; });
        stage.add(c.host, *d.camera, *c.viewport, {c.frame.uniforms.get()}, c.cv.getProjectionMatrix(),
                  c.cv.getModelViewMatrix());
    }
    if (node.inputs.filled)
        fill(node, *node.inputs.filled);
    else if (node.inputs.toHost)
        drawToHost(node, c);
    else if (!node.inputs.targets.empty() || node.inputs.writesMarks)
        drawTriangle(node, c);
}

void FrameGraph::drawTriangle(const Node& node, FrameContext& c)
{
    const PassInputs& in = node.inputs;
    RenderTarget& target =
        _pool.target(targetsOf(node), in.marks.valid() ? _resources[size_t(in.marks._index)].texture : nullptr);
    StageDraw& stage = c.frame.draw(node.pass->name(), [&]() -> osg::ref_ptr<osg::Drawable> {
        if (in.makeTriangle) return in.makeTriangle();
        return new FullScreen(c.frame.triangle.get());
    });
    auto& triangle = static_cast<FullScreen&>(stage.drawable());
    c.prepare(triangle, node.pass->name());
    triangle.atlasOrigin = in.shadowOrigin;
    triangle.textureUnits = unsigned(in.samplers.size());
    triangle.clears = clearsOf(node);
    if (in.prepareTriangle) in.prepareTriangle(triangle);
    std::vector<osg::StateSet*> states = {&stateOf(node, c), target.state.get(), c.frame.uniforms.get()};
    for (const auto& s : in.frameUniforms) states.push_back(s.get());
    stage.add(c.host, *target.camera, *target.viewport, states, c.cv.getProjectionMatrix(), c.cv.getModelViewMatrix());
}

void FrameGraph::drawToHost(const Node& node, FrameContext& c)
{
    if (!c.frame.composite) c.frame.composite = new FullScreen(c.frame.triangle.get());
    FullScreen& triangle = *c.frame.composite;
    c.prepare(triangle, node.pass->name());
    triangle.textureUnits = unsigned(node.inputs.samplers.size());
    triangle.owner = c.contextListener;
    std::vector<osg::StateSet*> states = {&stateOf(node, c), c.frame.uniforms.get()};
    for (const auto& s : node.inputs.frameUniforms) states.push_back(s.get());
    for (osg::StateSet* s : states) c.cv.pushStateSet(s);
    c.cv.addDrawable(&triangle, c.cv.getModelViewMatrix());
    for (size_t i = 0; i < states.size(); ++i) c.cv.popStateSet();
    c.cv.pushStateSet(c.frame.afterComposite);  // a graph of its own, behind
    c.cv.addDrawable(c.frame.firstUnit, c.cv.getModelViewMatrix());
    c.cv.popStateSet();
}

size_t FrameGraph::bytes() const
{
    size_t sum = _pool.bytes();
    for (const auto& pass : _passes) sum += pass->bytes();
    return sum;
}

void FrameGraph::resizeGLObjectBuffers(unsigned maximum)
{
    _pool.resizeGLObjectBuffers(maximum);
    _states.resizeGLObjectBuffers(maximum);
    for (const auto& pass : _passes) pass->resizeGLObjectBuffers(maximum);
}

void FrameGraph::releaseGLObjects(osg::State* state) const
{
    _pool.releaseGLObjects(state);
    _states.releaseGLObjects(state);
    for (const auto& pass : _passes) pass->releaseGLObjects(state);
}

void FrameGraph::retire()
{
    _pool.clear();
    _states.clear();
}

}  // namespace osgEnvLight

// SPDX-License-Identifier: MIT
// envlight_frame_study [--against PROGRAM] [OPTION...] [NAME=VALUE...]: a table of the milliseconds that each pass of a still
// frame takes. Beside another build of this program the two draw in turns: whatever else the machine does slows both.
//   --size W H       of the picture, 512 512
//   --triangles N    of the model, 100000
//   --map FILE       or the name of a built-in map, sky
//   --frames N       21
//   --against FILE   the same program of another build: the least times of both, the median ratio of neighbouring frames
//   --theirs NAME=VALUE  a setting of that one alone; NAME=VALUE is of both
//   --fetches        count what each pass of one frame fetches from textures, per pixel of the picture, instead
//   --serve          draw a frame and print its times for each line that is read
#include <BenchModel.h>
#include <SceneRenderer.h>

#include <osg/Group>
#include <osgDB/ReadFile>
#include <osgEnvLight/BuiltinMaps>

#include "Process.h"
#include "gl/ShaderLibrary.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <iomanip>
#include <iostream>
#include <map>
#include <sstream>
#include <stdexcept>

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

using osgEnvLight::LitScene;
using osgEnvLight::ShaderLibrary;

namespace
{

// Milliseconds by pass; the whole frame's is named "frame", that of all processors on it "processors".
using Times = std::vector<std::pair<std::string, double>>;

struct Options {
    int width = 512, height = 512, triangles = 100000, frames = 21;
    std::string map = "sky";
    std::string against;
    std::vector<std::string> settings, theirs;
    bool serves = false, counts = false;
};

void set(LitScene& lit, const std::string& assignment)
{
    const size_t equals = assignment.find('=');
    std::string error = "expected NAME=VALUE, not '" + assignment + "'";
    if (equals == std::string::npos ||
        !lit.getSettings()->set(assignment.substr(0, equals), assignment.substr(equals + 1), error))
        throw std::runtime_error(error);
}

// Of all threads, the software renderer's among them.
double processorTime()
{
    rusage usage;
    getrusage(RUSAGE_SELF, &usage);
    const auto of = [](const timeval& t) { return 1e3 * double(t.tv_sec) + 1e-3 * double(t.tv_usec); };
    return of(usage.ru_utime) + of(usage.ru_stime);
}

class View
{
  public:
    explicit View(const Options& options) : _renderer(options.width, options.height), _lit(new LitScene)
    {
        lookAtBenchModel(_renderer);
        osg::ref_ptr<osg::Image> image = osgEnvLight::createBuiltinMap(options.map);
        if (!image) image = osgDB::readRefImageFile(options.map);
        if (!image) throw std::runtime_error("can't read the map " + options.map);
        _lit->getEnvironmentMap()->setImage(image);
        _lit->addChild(makeBenchModel(options.triangles));
        for (const std::string& s : options.settings) set(*_lit, s);
        _lit->setTimed(true);
        // Compiles, uploads, draws all maps: 8 of them a frame.
        for (int i = 0; i < 4 || _lit->regenerating() || (i < 300 && has(draw(), "atlas")); ++i) draw();
    }

    Times draw()
    {
        const double before = processorTime();
        Times times = {{"frame", _renderer.time(_lit, 1)[0]}};
        times.emplace_back("processors", processorTime() - before);
        for (const auto& t : _lit->plan().passes)
            if (t.gpu >= 0.0) times.emplace_back(t.pass, t.gpu);
        return times;
    }

  private:
    static bool has(const Times& times, const std::string& pass)
    {
        return std::any_of(times.begin(), times.end(), [&](const auto& t) { return t.first == pass; });
    }

    SceneRenderer _renderer;
    osg::ref_ptr<LitScene> _lit;
};

// The fragment shaders of the passes, changed so that each adds what it fetches to a number of its own in a buffer.
class FetchCounters
{
  public:
    FetchCounters()
    {
        const osg::ref_ptr<ShaderLibrary> library = new ShaderLibrary(nullptr);
        std::filesystem::create_directory(_folder.file("pass"));
        for (const std::string& name : ShaderLibrary::names())
            if (std::filesystem::path(name).extension() == ".frag") {
                _folder.write(name, counting(library->expand(name).text, _passes.size()));
                _passes.push_back(std::filesystem::path(name).stem());
            }
        setenv("ENVLIGHT_SHADER_PATH", _folder.file("").c_str(), 1);
    }

    // From now on, in the current context.
    void start()
    {
        const std::vector<GLuint> zeros(_passes.size());
        if (!_gl) {
            _gl = osg::GLExtensions::Get(0, true);
            _gl->glGenBuffers(1, &_buffer);
        }
        _gl->glBindBuffer(GL_SHADER_STORAGE_BUFFER, _buffer);
        _gl->glBufferData(GL_SHADER_STORAGE_BUFFER, GLsizeiptr(4 * zeros.size()), zeros.data(), GL_DYNAMIC_COPY);
        _gl->glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, _buffer);
    }

    std::vector<std::pair<std::string, GLuint>> counts() const
    {
        std::vector<GLuint> numbers(_passes.size());
        _gl->glGetBufferSubData(GL_SHADER_STORAGE_BUFFER, 0, GLsizeiptr(4 * numbers.size()), numbers.data());
        std::vector<std::pair<std::string, GLuint>> result;
        for (size_t i = 0; i < numbers.size(); ++i) result.emplace_back(_passes[i], numbers[i]);
        return result;
    }

  private:
    static std::string counting(const std::string& text, size_t index)
    {
        std::string head, body, line;
        std::istringstream in(text);
        while (std::getline(in, line)) {
            const bool first =
                line.rfind("#version", 0) == 0 || line.rfind("#extension", 0) == 0 || line.rfind("#pragma", 0) == 0;
            if (line.rfind("#line", 0) != 0) (first ? head : body) += line + "\n";
        }
        for (const char* extension :
             {"GL_ARB_shader_storage_buffer_object", "GL_ARB_shading_language_420pack", "GL_ARB_shader_image_load_store"})
            head += std::string("#extension ") + extension + " : require\n";
        head += "layout(std430, binding = 0) buffer Fetches { uint fetchCounts[]; };\nint fetches = 0;\n";
        for (const char* look : {"texelFetch(s, p, l)", "textureLod(s, p, l)", "texture(s, p)", "textureProj(s, p)"})
            head += std::string("#define ") + look + " (++fetches, " + look + ")\n";
        // A shader that writes to a buffer is tested late unless it says otherwise, and pixels without the mark would count.
        if (body.find("gl_FragDepth") == std::string::npos) body = "layout(early_fragment_tests) in;\n" + body;
        const size_t main = body.find("void main()");
        if (main == std::string::npos) throw std::runtime_error("a pass without void main()");
        body.replace(main, 11, "void fetchingMain()");
        return head + body + "void main()\n{\n    fetchingMain();\n    atomicAdd(fetchCounts[" + std::to_string(index) +
               "], uint(fetches));\n}\n";
    }

    TemporaryFolder _folder;
    std::vector<std::string> _passes;
    osg::GLExtensions* _gl = nullptr;
    GLuint _buffer = 0;
};

void countFetches(const Options& options)
{
    FetchCounters counters;
    View view(options);
    counters.start();
    view.draw();
    const double pixels = double(options.width) * options.height;
    std::cout << "fetches per pixel\n" << std::fixed << std::setprecision(1);
    for (const auto& [pass, count] : counters.counts())
        if (count > 0) std::cout << std::left << std::setw(16) << pass << std::right << std::setw(10) << count / pixels << "\n";
}

void serve(View& view)
{
    std::string line;
    while (std::getline(std::cin, line)) {
        for (const auto& [pass, ms] : view.draw()) std::cout << pass << " " << ms << " ";
        std::cout << std::endl;
    }
}

// The same program of another build, which draws a frame when it is told to.
class Server
{
  public:
    Server(const Options& o, const std::string& program)
    {
        int down[2], up[2];
        if (pipe(down) || pipe(up)) throw std::runtime_error("no pipe");
        _pid = fork();
        if (_pid == 0) {
            dup2(down[0], 0);
            dup2(up[1], 1);
            for (int fd : {down[0], down[1], up[0], up[1]}) close(fd);
            std::vector<std::string> words = {program,
                                              "--serve",
                                              "--size",
                                              std::to_string(o.width),
                                              std::to_string(o.height),
                                              "--triangles",
                                              std::to_string(o.triangles),
                                              "--map",
                                              o.map};
            for (const auto* list : {&o.settings, &o.theirs}) words.insert(words.end(), list->begin(), list->end());
            std::vector<char*> arguments;
            for (std::string& w : words) arguments.push_back(w.data());
            arguments.push_back(nullptr);
            execv(program.c_str(), arguments.data());
            _exit(127);
        }
        close(down[0]);
        close(up[1]);
        _to = fdopen(down[1], "w");
        _from = fdopen(up[0], "r");
    }

    ~Server()
    {
        fclose(_to);
        fclose(_from);
        waitpid(_pid, nullptr, 0);
    }

    Times draw()
    {
        char line[4096];
        if (fputs("\n", _to) < 0 || fflush(_to) || !fgets(line, sizeof(line), _from))
            throw std::runtime_error("the other build failed");
        std::istringstream in(line);
        Times times;
        std::pair<std::string, double> t;
        while (in >> t.first >> t.second) times.push_back(t);
        return times;
    }

  private:
    pid_t _pid = 0;
    FILE* _to = nullptr;
    FILE* _from = nullptr;
};

double least(const std::vector<double>& v)
{
    return v.empty() ? std::nan("") : *std::min_element(v.begin(), v.end());
}

double median(std::vector<double> v)
{
    if (v.empty()) return std::nan("");
    std::nth_element(v.begin(), v.begin() + std::ptrdiff_t(v.size() / 2), v.end());
    return v[v.size() / 2];
}

struct Column {
    std::vector<double> theirs, ours, ratios;
};

void print(const std::vector<std::string>& order, const std::map<std::string, Column>& columns, bool paired)
{
    std::cout << std::left << std::setw(16) << "pass" << std::right << (paired ? "    theirs" : "") << "      ours"
              << (paired ? "     ratio" : "") << "\n"
              << std::fixed;
    for (const std::string& pass : order) {
        const Column& c = columns.at(pass);
        std::cout << std::left << std::setw(16) << pass << std::right;
        if (paired) std::cout << std::setw(10) << std::setprecision(1) << least(c.theirs);
        std::cout << std::setw(10) << std::setprecision(1) << least(c.ours);
        if (paired) std::cout << std::setw(10) << std::setprecision(3) << median(c.ratios);
        std::cout << "\n";
    }
}

void compare(const Options& options)
{
    std::unique_ptr<Server> server;
    if (!options.against.empty()) server = std::make_unique<Server>(options, options.against);
    View view(options);
    if (server) server->draw();  // until it has drawn its maps
    std::vector<std::string> order;
    std::map<std::string, Column> columns;
    const auto columnOf = [&](const std::string& pass) -> Column& {
        if (!columns.count(pass)) order.push_back(pass);
        return columns[pass];
    };
    for (int i = 0; i < options.frames; ++i) {
        std::map<std::string, double> theirs;
        if (server)
            for (const auto& [pass, ms] : server->draw()) {
                columnOf(pass).theirs.push_back(ms);
                theirs[pass] = ms;
            }
        for (const auto& [pass, ms] : view.draw()) {
            columnOf(pass).ours.push_back(ms);
            if (theirs.count(pass)) columns[pass].ratios.push_back(ms / theirs[pass]);
        }
    }
    print(order, columns, server != nullptr);
}

Options parse(const std::vector<std::string>& words)
{
    Options o;
    for (size_t i = 0; i < words.size(); ++i) {
        const auto next = [&] {
            if (++i >= words.size()) throw std::runtime_error("a value is missing at the end");
            return words[i];
        };
        if (words[i] == "--size") {
            o.width = std::stoi(next());
            o.height = std::stoi(next());
        } else if (words[i] == "--triangles") {
            o.triangles = std::stoi(next());
        } else if (words[i] == "--frames") {
            o.frames = std::stoi(next());
        } else if (words[i] == "--map") {
            o.map = next();
        } else if (words[i] == "--against") {
            o.against = next();
        } else if (words[i] == "--theirs") {
            o.theirs.push_back(next());
        } else if (words[i] == "--fetches") {
            o.counts = true;
        } else if (words[i] == "--serve") {
            o.serves = true;
        } else {
            o.settings.push_back(words[i]);
        }
    }
    return o;
}

}  // namespace

int main(int argc, char** argv)
{
    try {
        const Options options = parse(std::vector<std::string>(argv + 1, argv + argc));
        if (options.serves) {
            View view(options);
            serve(view);
        } else if (options.counts) {
            countFetches(options);
        } else {
            compare(options);
        }
    } catch (const std::exception& error) {
        std::cerr << "envlight_frame_study: " << error.what() << "\n";
        return 1;
    }
    return 0;
}

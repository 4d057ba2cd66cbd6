// SPDX-License-Identifier: MIT
// Every sampler on the twelve study maps: envlight_lights_study FOLDER [columns, default 512]
// writes lights.csv, and plots of the geometric means over the real maps where gnuplot is on the path.
#include "lights/MapOptions.h"

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <stdexcept>

#include "LightJudge.h"
#include "StudyMaps.h"

using namespace testmaths;
using osgEnvLight::LightList;
using osgEnvLight::LightSampler;
using osgEnvLight::SampleOptions;

namespace
{

const unsigned counts[] = {16, 32, 64, 128, 256, 512, 1024, 2048, 4096};

struct Variant {
    const char* weights;
    SampleOptions options;
};

// Ambient visibility asks 16384 directions for their nearest light: at a few counts only.
bool judgesVisibility(unsigned count)
{
    return count == 16 || count == 64 || count == 256 || count == 1024;
}

// Sums of logarithms, by sampler and count.
struct Means {
    std::map<std::pair<std::string, unsigned>, double> u, v;
    int maps = 0;
};

class Study
{
  public:
    explicit Study(const std::filesystem::path& folder) : _folder(folder), _csv(folder / "lights.csv")
    {
        if (!_csv) throw std::runtime_error((folder / "lights.csv").string() + ": cannot be written");
        _csv << "map,sampler,weights,floor,N,U,V,ambient visibility,milliseconds\n";
        _variants = {{"own", {}}, {"off", {}}, {"on", {}}, {"own", {}}};
        _variants[1].options.weights = SampleOptions::WEIGHTS_OFF;
        _variants[2].options.weights = SampleOptions::WEIGHTS_ON;
        _variants[3].options.floor = osgEnvLight::MapOptions().sampling.floor;
    }

    void judge(const StudyMap& study)
    {
        const auto map = radianceOf(study.image);
        map->harmonics();
        const LightJudge judge(*map, true);
        _means.maps += study.real;
        for (const char* name : LightSampler::names())
            for (size_t i = 0; i < _variants.size(); ++i)
                for (unsigned count : counts) {
                    const auto start = std::chrono::steady_clock::now();
                    const LightList list = LightSampler::create(name)->sample(*map, count, _variants[i].options);
                    const std::chrono::duration<double, std::milli> time = std::chrono::steady_clock::now() - start;
                    const double u = judge.unoccludedError(list);
                    const double v = judge.occludedError(list);
                    _csv << study.name << ',' << name << ',' << _variants[i].weights << ',' << _variants[i].options.floor << ','
                         << count << ',' << u << ',' << v << ',';
                    // Weights move no light.
                    const bool moved = i == 0 || _variants[i].options.floor > 0.0;
                    if (moved && judgesVisibility(count)) _csv << judge.visibilityError(list);
                    _csv << ',' << time.count() << '\n';
                    if (i > 0 || !study.real) continue;
                    _means.u[{name, count}] += std::log(u);
                    _means.v[{name, count}] += std::log(v);
                }
        _csv.flush();
    }

    void plot() const
    {
        if (_means.maps == 0) {
            std::cout << "no plots: they are of the real maps, and blender-data or the exr plugin is not installed\n";
            return;
        }
        if (std::system("command -v gnuplot >/dev/null") != 0) {
            std::cout << "no plots: gnuplot is not on the path\n";
            return;
        }
        plot("u", "Error of unoccluded irradiance U", _means.u);
        plot("v", "Error of occluded irradiance V", _means.v);
    }

  private:
    void plot(const std::string& name, const std::string& title,
              const std::map<std::pair<std::string, unsigned>, double>& sums) const
    {
        const std::filesystem::path script = _folder / (name + ".gnuplot");
        std::ofstream out(script);
        out << "set terminal svg size 800,600 font 'sans,15' background 'white'\n"
            << "set output '" << (_folder / (name + ".svg")).string() << "'\n"
            << "set title '" << title << ", geometric mean of " << _means.maps << " real maps'\n"
            << "set logscale xy\nset grid\nset key bottom left\n"
            << "set xrange [13:5000]\nset linetype 5 linecolor rgb '#a04000'\n"
            << "set xlabel 'lights N'\nset ylabel 'relative RMS error'\nset format y '%g'\n"
            << "set xtics (16, 32, 64, 128, 256, 512, 1024, 2048, 4096)\n";
        for (const char* sampler : LightSampler::names()) {
            out << "$" << blockOf(sampler) << " << end\n";
            for (unsigned count : counts) out << count << ' ' << std::exp(sums.at({sampler, count}) / _means.maps) << '\n';
            out << "end\n";
        }
        out << "plot ";
        for (const char* sampler : LightSampler::names())
            out << "$" << blockOf(sampler) << " with linespoints linewidth 2 title '" << sampler << "', ";
        out << "\n";
        out.close();
        if (std::system(("gnuplot '" + script.string() + "'").c_str()) != 0) std::cout << script << ": gnuplot failed\n";
    }

    static std::string blockOf(std::string sampler)
    {
        for (char& c : sampler)
            if (c == '-') c = '_';
        return sampler;
    }

    std::filesystem::path _folder;
    std::ofstream _csv;
    std::vector<Variant> _variants;
    Means _means;
};

}  // namespace

int main(int argc, char** argv)
{
    if (argc < 2 || argc > 3) {
        std::cerr << "usage: envlight_lights_study FOLDER [columns]\n";
        return 2;
    }
    try {
        std::filesystem::create_directories(argv[1]);
        Study study(argv[1]);
        for (const StudyMap& m : allMaps(argc > 2 ? std::max(std::atoi(argv[2]), 64) : 512)) {
            std::cout << m.name << std::endl;
            study.judge(m);
        }
        study.plot();
    } catch (const std::exception& e) {
        std::cerr << e.what() << '\n';
        return 1;
    }
    return 0;
}

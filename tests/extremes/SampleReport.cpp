// SPDX-License-Identifier: MIT
#include "SampleReport.h"

#include <algorithm>
#include <cmath>

using namespace tradeoff;
using osgEnvLight::Picture;

namespace
{

const Texts defaults = {{"diffuseLights", "128"}, {"specularSamples", "32"}, {"occlusionLights", "512"},
                        {"occlusionSteps", "16"}, {"filterCells", "2"},      {"occlusionRadius", "0.25"},
                        {"combine", "ratio"}};

std::string settingIn(const Texts& settings, const std::string& name)
{
    for (const Texts* list : {&settings, &defaults})
        for (const auto& [key, value] : *list)
            if (key == name) return value;
    return "";
}

Spread spreadAbout(double milliseconds)
{
    return {milliseconds, 0.97 * milliseconds, 1.05 * milliseconds, 40};
}

Figures figuresOf(double error)
{
    Figures f;
    f.tRMSE = error;
    f.relMSE = error * error;
    f.rmse = 0.31 * error;
    f.bias = -0.04 * error;
    f.p99 = 1.9 * error;
    f.ssim = 1.0 - error;
    f.flip = 0.8 * error;
    f.noise = 0.004;
    f.resolved = error > f.noise;
    return f;
}

// Linear colour of a sphere on a plane, where d is how much of the occlusion is missing.
void shade(Picture& picture, int x, int y, double missing)
{
    const double u = 2.0 * (x + 0.5) / picture.width - 1.0;
    const double v = 2.0 * (y + 0.5) / picture.height - 1.0;
    const double r2 = (u * u + (v - 0.05) * (v - 0.05)) / 0.36;
    double light[3] = {0.25 + 0.2 * v, 0.35 + 0.25 * v, 0.5 + 0.3 * v};  // sky
    if (v < -0.1) {
        const double shadow = (1.0 - missing) * std::exp(-6.0 * (u * u + 8.0 * (v + 0.5) * (v + 0.5)));
        for (double& c : light) c = 0.4 * (1.0 - 0.8 * shadow);
    }
    if (r2 < 1.0) {
        const double z = std::sqrt(1.0 - r2);
        const double facing = 0.5 + 0.3 * (v - 0.05) / 0.6 + 0.2 * z;
        const double gloss = std::pow(std::max(0.0, 0.5 * z + 0.6 * (v - 0.05) - 0.3 * u / 0.6), 40.0);
        for (int c = 0; c < 3; ++c) light[c] = (c == 0 ? 0.7 : c == 1 ? 0.35 : 0.2) * facing + gloss;
    }
    for (int c = 0; c < 3; ++c) picture.at(x, y)[c] = float(light[c]);
    picture.at(x, y)[3] = 1.0f;
}

Picture scenePicture(int size, double missing)
{
    Picture picture(size, size);
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x) shade(picture, x, y, missing);
    return picture;
}

Picture falseColors(const Picture& ours, const Picture& reference)
{
    Picture result(ours.width, ours.height);
    for (size_t i = 0; i < ours.rgba.size(); i += 4) {
        const float d = std::clamp(5.0f * (ours.rgba[i + 1] - reference.rgba[i + 1]), -1.0f, 1.0f);
        result.rgba[i] = 1.0f - std::max(-d, 0.0f);
        result.rgba[i + 1] = 1.0f - std::abs(d);
        result.rgba[i + 2] = 1.0f - std::max(d, 0.0f);
    }
    return result;
}

TermPictures termPictures(const std::string& term, double missing)
{
    TermPictures t;
    t.term = term;
    t.ours = scenePicture(160, missing);
    t.reference = scenePicture(160, 0.0);
    t.difference = falseColors(t.ours, t.reference);
    t.differenceLegend = "red: too bright, blue: too dark; full colour from 0.2";
    t.sentence = "72 % of the squared error of " + term + " is where the blockers are outside the view.";
    t.shares = {{"blockers outside the view", 0.72}, {"contact", 0.19}, {"noise", 0.07}, {"rest", 0.02}};
    return t;
}

void addSweep(Report& report, const std::string& name, const std::vector<std::string>& values)
{
    for (const std::string& value : values) {
        const bool usual = value == settingIn(defaults, name);
        report.points.push_back(samplePoint(name, value, usual ? Texts() : Texts{{name, value}}));
        if (name != "combine") report.points.back().number = std::stod(value);
    }
}

}  // namespace

Point samplePoint(const std::string& sweep, const std::string& value, const Texts& settings)
{
    const auto number = [&](const std::string& name) { return std::stod(settingIn(settings, name)); };
    const bool ratio = settingIn(settings, "combine") == "ratio";
    const double cells = number("filterCells");
    const double rays = number("occlusionLights") / 512.0;
    Point p;
    p.sweep = sweep;
    p.value = value;
    p.settings = settings;
    p.passes = {{"G-buffer", spreadAbout(8.0)},
                {"diffuse", spreadAbout(8.0 + 43.0 * number("diffuseLights") / 128.0)},
                {"specular", spreadAbout(14.0 + 30.0 * number("specularSamples") / 32.0)},
                {"occlusion", spreadAbout(20.0 + 229.0 * rays * number("occlusionSteps") / 16.0)},
                {"filter", spreadAbout(30.0 * cells * cells * (ratio ? 1.0 : 0.8) + 13.0)},
                {"composite", spreadAbout(11.0)}};
    double sum = 0.0;
    for (const auto& pass : p.passes) sum += pass.second.median;
    p.frame = spreadAbout(sum + 14.0);
    const double diffuse = 0.5 / number("diffuseLights");
    const double specular = 0.02 * std::pow(number("specularSamples") / 32.0, -0.9) + 0.003;
    const double noise = 0.011 / std::sqrt(rays) / cells;
    const double steps = 0.03 * std::pow(number("occlusionSteps") / 16.0, -1.1) + 0.007;
    const double radius = 0.02 * std::abs(std::log(number("occlusionRadius") / 0.3));
    const double occlusion = std::hypot(std::hypot(noise, steps), std::hypot(radius, 0.003 * cells)) * (ratio ? 1.0 : 1.6);
    p.terms = {{"diffuse", figuresOf(diffuse)}, {"specular", figuresOf(specular)}, {"occlusion", figuresOf(occlusion)}};
    p.beauty = figuresOf(std::hypot(std::hypot(0.8 * diffuse, 0.4 * specular), 0.6 * occlusion));
    return p;
}

Report sampleReport()
{
    Report r;
    r.scene = "chess.envlight";
    r.map = "studio";
    r.width = 512;
    r.height = 512;
    r.date = "2024-05-17 16:20 UTC";
    r.command = "envlight-tradeoff chess.envlight --size 512x512 --target-ms 250 --target-error 0.012 -o report";
    r.hardware = {{"renderer", "llvmpipe (LLVM 15.0.6, 256 bits), software"},
                  {"OpenGL", "4.5 (Compatibility Profile) Mesa 22.3.6"},
                  {"CPU", "Example CPU @ 2.5 GHz, 2 cores"}};
    r.defaults = defaults;
    r.timeStatement = "Times are of 40 frames after 5 that warm up; a pass's time is its timer query's.";
    r.referenceStatement = "The reference: 4096 paths a pixel of length 12 or less; its own noise is 0.4 %.";
    r.errorStatement = "Error: root of the mean squared error over the mean square of the reference.";
    r.exposure = 0.5;
    r.notes = {"The reference has no transparency.", "Emission is left out of both."};
    r.points = {
        samplePoint("preset", "draft",
                    {{"diffuseLights", "32"},
                     {"specularSamples", "16"},
                     {"occlusionLights", "128"},
                     {"occlusionSteps", "8"},
                     {"filterCells", "1"}}),
        samplePoint("preset", "fast", {{"diffuseLights", "64"}, {"occlusionLights", "256"}, {"occlusionSteps", "12"}}),
        samplePoint("preset", "default", {}),
        samplePoint("preset", "fine", {{"occlusionLights", "1024"}, {"occlusionSteps", "32"}, {"occlusionRadius", "0.3"}}),
        samplePoint("preset", "extreme",
                    {{"diffuseLights", "512"},
                     {"specularSamples", "128"},
                     {"occlusionLights", "4096"},
                     {"occlusionSteps", "64"},
                     {"occlusionRadius", "0.3"}})};
    addSweep(r, "diffuseLights", {"32", "64", "128", "256", "512"});
    addSweep(r, "specularSamples", {"4", "8", "16", "32", "64", "128"});
    addSweep(r, "occlusionLights", {"64", "128", "256", "512", "1024", "2048", "4096"});
    addSweep(r, "occlusionSteps", {"4", "8", "16", "32", "64"});
    addSweep(r, "filterCells", {"1", "2", "3"});
    addSweep(r, "occlusionRadius", {"0.05", "0.1", "0.25", "0.3", "0.5", "1"});
    addSweep(r, "combine", {"ratio", "subtract"});
    r.targets = {{Target::MILLISECONDS, 250.0}, {Target::ERROR, 0.012}};
    r.ours = scenePicture(256, 0.4);
    r.reference = scenePicture(256, 0.0);
    r.pictures = {termPictures("diffuse", 0.1), termPictures("specular", 0.2), termPictures("occlusion", 0.5)};
    return r;
}

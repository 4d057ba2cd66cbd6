// SPDX-License-Identifier: MIT
#include "Sections.h"
#include "Text.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <stdexcept>

#include <nlohmann/json.hpp>

namespace tradeoff
{

namespace
{

using nlohmann::ordered_json;

[[noreturn]] void fail(const std::string& file, int error)
{
    throw std::runtime_error(file + ": can't be written: " + std::strerror(error));
}

// Under another name until all of it is on the disk.
void writeFile(const std::string& name, const std::string& content)
{
    const std::string part = name + ".part";
    std::FILE* file = std::fopen(part.c_str(), "wb");
    if (!file) fail(name, errno);
    const bool written = std::fwrite(content.data(), 1, content.size(), file) == content.size() && std::fflush(file) == 0;
    int error = written ? 0 : errno;
    if (std::fclose(file) != 0 && error == 0) error = errno;
    if (error == 0 && std::rename(part.c_str(), name.c_str()) != 0) error = errno;
    if (error == 0) return;
    std::remove(part.c_str());
    fail(name, error);
}

ordered_json json(const Texts& texts)
{
    ordered_json j = ordered_json::object();
    for (const auto& [name, text] : texts) j[name] = text;
    return j;
}

ordered_json json(const Spread& s)
{
    return {{"median", s.median}, {"low", s.low}, {"high", s.high}, {"frames", s.frames}};
}

ordered_json json(const Figures& f)
{
    ordered_json j;
    for (const FigureColumn& column : figureColumns) j[column.name] = f.*column.value;
    j["resolved"] = f.resolved;
    return j;
}

ordered_json json(const Report& report, const Summary& summary, size_t index)
{
    const Point& p = report.points[index];
    ordered_json j = {{"sweep", p.sweep}, {"value", p.value}, {"number", p.number}, {"settings", json(p.settings)}};
    j["failed"] = p.failed;
    if (p.failed) j["failure"] = p.failure;
    j["milliseconds"] = json(p.frame);
    j["passes"] = ordered_json::object();
    for (const auto& [name, time] : p.passes) j["passes"][name] = json(time);
    j["beauty"] = json(p.beauty);
    j["terms"] = ordered_json::object();
    for (const auto& [name, figures] : p.terms) j["terms"][name] = json(figures);
    j["front"] = std::find(summary.front.begin(), summary.front.end(), index) != summary.front.end();
    j["dominated"] = isDominated(report.points, index);
    return j;
}

ordered_json json(const Choice& choice)
{
    return choice ? ordered_json(*choice) : ordered_json();
}

ordered_json sharesOf(const Report& report)
{
    ordered_json j = ordered_json::object();
    for (const TermPictures& term : report.pictures) {
        j[term.term]["sentence"] = term.sentence;
        for (const auto& [name, share] : term.shares) j[term.term]["shares"][name] = share;
    }
    return j;
}

std::string jsonText(const Report& report)
{
    const Summary summary(report);
    ordered_json j = {{"title", report.title},
                      {"headline", headline(report, summary)},
                      {"scene", report.scene},
                      {"map", report.map},
                      {"size", {report.width, report.height}},
                      {"date", report.date},
                      {"command", report.command},
                      {"quick", report.quick},
                      {"interrupted", report.interrupted},
                      {"interruption", report.interruption},
                      {"hardware", json(report.hardware)},
                      {"defaults", json(report.defaults)},
                      {"time", report.timeStatement},
                      {"reference", report.referenceStatement},
                      {"error", report.errorStatement},
                      {"exposure", report.exposure},
                      {"notes", report.notes},
                      {"default", json(summary.usual)},
                      {"knee", json(summary.knee)}};
    j["targets"] = ordered_json::array();
    for (const Target& t : report.targets)
        j["targets"].push_back({{"kind", t.kind == Target::ERROR ? "error" : "milliseconds"},
                                {"value", t.value},
                                {"point", json(answerTo(t, report.points))}});
    j["terms"] = sharesOf(report);
    j["points"] = ordered_json::array();
    for (size_t i = 0; i < report.points.size(); ++i) j["points"].push_back(json(report, summary, i));
    return j.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace

void makeReportFolder(const std::string& folder)
{
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error) throw std::runtime_error(folder + ": can't be made: " + error.message());
    // A file that nothing else has the name of: an earlier report stays until there is another.
    const std::string trial = folder + "/tradeoff.trial";
    writeFile(trial, "");
    std::remove(trial.c_str());
}

void writeReport(const Report& report, const std::string& folder)
{
    makeReportFolder(folder);
    writeFile(folder + "/tradeoff.json", jsonText(report));
    writeFile(folder + "/tradeoff.csv", csvText(report));
    writeFile(folder + "/index.html", htmlPage(report));
}

}  // namespace tradeoff

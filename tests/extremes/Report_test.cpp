// SPDX-License-Identifier: MIT
// The report as a browser shows it, and as files.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "Browser.h"
#include "Process.h"
#include "SampleReport.h"

using namespace tradeoff;
using nlohmann::json;

namespace
{

const std::string awkward = "<b id=\"injected\">&amp; \"quoted\" 'ü' </script></style>, ;\n";

// Of the visible plots: how many pairs of texts lie on each other. The rest is what pages are asked below.
const char* const probe = R"js(
    const all = (selector) => [...document.querySelectorAll(selector)];
    const texts = (svg) => [...svg.querySelectorAll("text")].map((t) => t.getBoundingClientRect());
    const touch = (a, b) => a.left < b.right - 1 && b.left < a.right - 1 && a.top < b.bottom - 4 && b.top < a.bottom - 4;
    const covered = (boxes) => boxes.filter((a, i) => a.width > 0 && boxes.slice(i + 1).some((b) => touch(a, b))).length;
    const findings = {
        images: all("img").map((image) => image.naturalWidth),
        without: all("img").filter((image) => !image.alt).length,
        overflow: document.documentElement.scrollWidth - document.documentElement.clientWidth,
        dangling: all("a").filter((a) => !document.getElementById(a.getAttribute("href").slice(1))).length,
        twice: all("[id]").length - new Set(all("[id]").map((e) => e.id)).size,
        overlapping: all("svg.chart").map((svg) => covered(texts(svg))).reduce((a, b) => a + b, 0),
        notNumbers: all("svg *").filter((e) => [...e.attributes].some((a) => /nan|inf/.test(a.value) && a.name !== "class")).length,
        injected: all("#injected").length,
        heading: document.querySelector("h1").textContent,
        warning: document.querySelector(".warning")?.textContent ?? "",
        marks: all("svg.wide .mark").length,
        front: all("svg.wide .mark.front").length,
        arrows: all("svg.wide .arrow").length,
        rings: all("svg.wide .ring").length,
        sweeps: all(".sweep-figure").length,
        rows: all(".points tbody tr").length,
        failures: all(".points tr.failed").map((row) => row.textContent),
        settings: all(".cards pre").map((pre) => pre.textContent),
        cards: all(".cards article").map((card) => card.textContent),
    };
    const range = document.querySelector("#comparison input");
    if (range) {
        const clip = () => getComputedStyle(document.querySelector(".view.over")).clipPath;
        findings.clips = [clip()];
        range.value = 25;
        range.dispatchEvent(new Event("input"));
        findings.clips.push(clip());
    }
    const heading = all(".points thead th")[1];
    if (heading) {
        const keys = () => all(".points tbody tr").map((row) => row.cells[1].dataset.key);
        findings.keys = [keys()];
        for (let i = 0; i < 2; ++i) {
            heading.querySelector("button").click();
            findings.keys.push(keys());
        }
        const pass = document.querySelector("td.pass");
        if (pass) {
            findings.passes = [pass.offsetWidth > 0];
            document.getElementById("passes").click();
            findings.passes.push(pass.offsetWidth > 0);
            findings.overflowWithPasses = document.documentElement.scrollWidth - document.documentElement.clientWidth;
        }
    }
    const button = document.querySelector(".legend button");
    if (button) {
        button.click();
        findings.faded = all("svg.wide .mark.faded").length;
    }
    return findings;
)js";

Report failing()
{
    Report r = sampleReport();
    for (Point& p : r.points)
        if (p.sweep != "combine") p.failed = true;
    r.points[2].failure = "out of <memory>";
    return r;
}

Report huge()
{
    Report r;
    const double times[] = {1e-3, 1.0, 1e9, 1e300, 1e-300, 5.0, 5.0, 5.0};
    const double errors[] = {1e100, 0.1, 0.0, 1e-150, 1e150, 0.0, 0.2, unknown};
    for (size_t i = 0; i < 8; ++i) {
        Point p = samplePoint("occlusionLights", std::to_string(i), {{"occlusionLights", "1" + std::string(8 * i, '0')}});
        p.number = std::pow(10.0, 30.0 * double(i));
        p.frame.median = times[i];
        for (auto& term : p.terms) term.second.tRMSE = errors[i];
        p.beauty.tRMSE = errors[i];
        p.beauty.bias = -1e300;
        p.beauty.resolved = i != 1;
        r.points.push_back(p);
    }
    r.targets = {{Target::ERROR, 1e-200}, {Target::MILLISECONDS, 1e308}};
    return r;
}

Report withNames()
{
    Report r = sampleReport();
    r.title = r.scene = r.map = r.date = r.command = r.timeStatement = r.referenceStatement = r.errorStatement = awkward;
    r.hardware = r.defaults = {{awkward, awkward}};
    r.notes = {awkward, awkward};
    for (Point& p : r.points) {
        if (p.sweep == "diffuseLights") p.sweep = awkward;
        for (auto& pass : p.passes) pass.first += awkward;
        p.terms[awkward] = p.beauty;
        if (!p.settings.empty()) p.settings.emplace_back(awkward, awkward);
    }
    for (TermPictures& t : r.pictures) {
        t.term = t.sentence = t.differenceLegend = awkward;
        t.shares[0].first = awkward;
    }
    return r;
}

Report interrupted()
{
    Report r = sampleReport();
    r.interrupted = true;
    r.quick = true;
    r.interruption = "After 12 of 39 settings.";
    r.points.resize(12);
    r.pictures.resize(1);
    return r;
}

Report withoutTerms()
{
    Report r = sampleReport();
    r.ours = r.reference = {};
    r.pictures.clear();
    for (Point& p : r.points) {
        p.terms.clear();
        p.passes.clear();
    }
    return r;
}

Report onePoint()
{
    Report r = sampleReport();
    r.points = {r.points[2]};
    return r;
}

// More sweeps than there are colours, in a narrow range.
Report crowded()
{
    Report r;
    for (int i = 0; i < 60; ++i) {
        Point p = samplePoint("setting " + std::to_string(i % 12), std::to_string(i), {{"setting", std::to_string(i)}});
        p.number = i;
        p.frame.median = 100.0 + i;
        p.beauty.tRMSE = 1e-2 * (1.0 - 0.0025 * i);
        r.points.push_back(p);
    }
    return r;
}

// All pages in one run of the browser, which takes seconds.
class ReportPage : public testing::Test
{
  protected:
    static void SetUpTestSuite()
    {
        if (browserCommand().empty()) return;
        const std::map<std::string, Report> reports = {
            {"normal", sampleReport()},     {"empty", Report()},       {"one", onePoint()},
            {"failing", failing()},         {"huge", huge()},          {"names", withNames()},
            {"interrupted", interrupted()}, {"terms", withoutTerms()}, {"crowded", crowded()}};
        const TemporaryFolder folder;
        std::vector<std::string> names;
        for (const auto& [name, report] : reports) {
            writeReport(report, folder.file(name));
            names.push_back(name);
        }
        findings = new Findings(probePages(folder.file(""), names, {360, 1400}, probe));
        ASSERT_EQ(2 * reports.size(), findings->pages.size());
    }
    static void TearDownTestSuite() { delete findings; }

    void SetUp() override
    {
        if (!findings) GTEST_SKIP() << "Chromium is not installed";
    }

    static const json& page(const std::string& name, int width = 1400) { return findings->pages.at({name, width}); }

    static Findings* findings;
};

Findings* ReportPage::findings = nullptr;

}  // namespace

TEST_F(ReportPage, NothingIsWrongAnywhere)
{
    EXPECT_EQ(std::vector<std::string>(), findings->console);
    for (const auto& [where, found] : findings->pages) {
        SCOPED_TRACE(where.first + " " + std::to_string(where.second));
        EXPECT_EQ(json::array(), found["exceptions"]);
        EXPECT_LE(found["overflow"], 0);
        EXPECT_LE(found.value("overflowWithPasses", 0), 0);
        for (const char* fault : {"without", "dangling", "twice", "notNumbers", "injected"}) EXPECT_EQ(0, found[fault]) << fault;
        for (const json& width : found["images"]) EXPECT_GT(width, 0);
    }
}

TEST_F(ReportPage, TextsOfPlotsDoNotOverlap)
{
    for (const auto& [where, found] : findings->pages) EXPECT_EQ(0, found["overlapping"]) << where.first << " " << where.second;
}

TEST_F(ReportPage, AllPicturesAreShown)
{
    EXPECT_EQ(11u, page("normal")["images"].size());
    EXPECT_EQ(5u, page("interrupted")["images"].size());
    EXPECT_EQ(11u, page("names")["images"].size());
    for (const char* name : {"empty", "terms", "huge"}) EXPECT_EQ(0u, page(name)["images"].size()) << name;
}

TEST_F(ReportPage, TheEssentialSentence)
{
    EXPECT_EQ(
        "Default settings: 510\u00a0ms a frame, 2.5\u00a0% error (tone-mapped RMSE); in half the time the error is 4.9\u00a0%; "
        "half the error costs 7828\u00a0ms.",
        page("normal")["heading"]);
    EXPECT_EQ("Nothing could be measured.", page("empty")["heading"]);
    EXPECT_NE(std::string::npos, page("one")["heading"].get<std::string>().find("nothing measured is twice as fast"));
    EXPECT_EQ("", page("normal")["warning"]);
    EXPECT_EQ(0u, page("interrupted")["warning"].get<std::string>().find("Interrupted. After 12 of 39 settings."));
}

TEST_F(ReportPage, EveryMeasuredPointIsAMarkAndARow)
{
    EXPECT_EQ(39, page("normal")["marks"]);
    EXPECT_EQ(39, page("normal")["rows"]);
    EXPECT_EQ(2, page("normal")["rings"]);
    EXPECT_EQ(6, page("normal")["sweeps"]);
    EXPECT_EQ(0, page("empty")["marks"]);
    EXPECT_EQ(1, page("one")["marks"]);
    EXPECT_EQ(60, page("crowded")["marks"]);
    EXPECT_EQ(60, page("crowded")["front"]);
    EXPECT_EQ(2, page("failing")["marks"]);
    EXPECT_EQ(39, page("failing")["rows"]);
    ASSERT_EQ(37u, page("failing")["failures"].size());
    EXPECT_NE(std::string::npos, page("failing")["failures"][2].get<std::string>().find("out of <memory>"));
    EXPECT_EQ(7, page("huge")["marks"]);
    EXPECT_EQ(3, page("huge")["arrows"]);  // two errors of 0 and one that the reference can't tell
}

TEST_F(ReportPage, SettingsToPaste)
{
    const json& blocks = page("normal")["settings"];  // of knee and targets: the defaults need none
    ASSERT_EQ(3u, blocks.size());
    const auto settingsOf = [&](size_t i) { return json::parse("{" + blocks[i].get<std::string>() + "}")["settings"]; };
    EXPECT_EQ(json({{"occlusionSteps", 32}}), settingsOf(0));
    EXPECT_EQ(128, settingsOf(1)["occlusionLights"]);
    EXPECT_EQ(0.3, settingsOf(2)["occlusionRadius"]);
    EXPECT_EQ(4u, page("huge")["cards"].size());
    EXPECT_NE(std::string::npos, page("one")["cards"][2].get<std::string>().find("No measured settings are as fast"));
}

TEST_F(ReportPage, SliderMovesTheBorder)
{
    for (int width : {360, 1400})
        EXPECT_EQ(json({"inset(0px 50% 0px 0px)", "inset(0px 75% 0px 0px)"}), page("normal", width)["clips"]) << width;
}

TEST_F(ReportPage, HeadingsSort)
{
    const auto numbers = [](const json& keys) {
        std::vector<double> result;
        for (const json& k : keys)
            if (k != "") result.push_back(std::stod(k.get<std::string>()));
        return result;
    };
    const json& keys = page("normal")["keys"];
    EXPECT_NE(keys[0], keys[1]);
    const std::vector<double> rising = numbers(keys[1]);
    const std::vector<double> falling = numbers(keys[2]);
    EXPECT_EQ(39u, rising.size());
    EXPECT_TRUE(std::is_sorted(rising.begin(), rising.end()));
    EXPECT_TRUE(std::is_sorted(falling.rbegin(), falling.rend()));
    // Failed points stay behind the others in both directions.
    for (int i : {1, 2}) {
        const json& failed = page("failing")["keys"][size_t(i)];
        EXPECT_NE("", failed[0]);
        EXPECT_NE("", failed[1]);
        EXPECT_EQ("", failed[2]);
    }
}

TEST_F(ReportPage, SwitchAndLegend)
{
    EXPECT_EQ(json({false, true}), page("normal")["passes"]);
    EXPECT_EQ(34, page("normal")["faded"]);  // all but the five presets
}

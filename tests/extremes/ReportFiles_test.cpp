// SPDX-License-Identifier: MIT
// tradeoff.csv and tradeoff.json, and what happens when files can't be written.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <sstream>

#include <nlohmann/json.hpp>

#include "Process.h"
#include "SampleReport.h"

using namespace tradeoff;
using nlohmann::json;

namespace
{

using Row = std::vector<std::string>;

// RFC 4180
std::vector<Row> readCsv(const std::string& text)
{
    std::vector<Row> rows(1, Row(1));
    bool inside = false;
    for (size_t i = 0; i < text.size(); ++i) {
        if (inside && text.compare(i, 2, "\"\"") == 0)
            rows.back().back() += text[i++];
        else if (text[i] == '"')
            inside = !inside;
        else if (inside || (text[i] != ',' && text[i] != '\n'))
            rows.back().back() += text[i];
        else if (text[i] == ',')
            rows.back().emplace_back();
        else
            rows.emplace_back(1);
    }
    rows.pop_back();  // behind the last line's end
    return rows;
}

std::string failureOf(const Report& report, const std::string& folder)
{
    try {
        writeReport(report, folder);
    } catch (const std::runtime_error& e) {
        return e.what();
    }
    return "";
}

size_t filesIn(const std::string& folder)
{
    const std::filesystem::directory_iterator entries(folder);
    return size_t(std::distance(begin(entries), end(entries)));
}

}  // namespace

class ReportFiles : public testing::Test
{
  protected:
    std::vector<Row> csv() const { return readCsv(readFile(folder.file("tradeoff.csv"))); }
    json content() const { return json::parse(readFile(folder.file("tradeoff.json"))); }

    std::string at(const Row& row, const std::string& name) const
    {
        const Row header = csv()[0];
        const auto column = std::find(header.begin(), header.end(), name);
        return column == header.end() ? "no column " + name : row[size_t(column - header.begin())];
    }

    TemporaryFolder folder;
};

TEST_F(ReportFiles, CsvHasARowForEachPoint)
{
    Report r = sampleReport();
    r.points[1].failed = true;
    r.points[1].failure = "lost, \"the\" context";
    r.points[3].beauty.flip = unknown;
    writeReport(r, folder.file(""));
    const std::vector<Row> rows = csv();
    ASSERT_EQ(1 + r.points.size(), rows.size());
    for (size_t i = 0; i < rows.size(); ++i) EXPECT_EQ(rows[0].size(), rows[i].size()) << i;
    EXPECT_EQ("draft", at(rows[1], "value"));
    EXPECT_EQ("128", at(rows[1], "occlusionLights"));
    EXPECT_EQ("1024", at(rows[4], "occlusionLights"));
    EXPECT_EQ("16", at(rows[3], "occlusionSteps"));  // the default
    EXPECT_EQ("1", at(rows[3], "default"));
    EXPECT_EQ("lost, \"the\" context", at(rows[2], "failure"));
    EXPECT_EQ("", at(rows[4], "flip"));
    for (size_t i = 0; i < r.points.size(); ++i) {
        EXPECT_EQ(r.points[i].frame.median, std::stod(at(rows[i + 1], "ms")));
        EXPECT_EQ(r.points[i].beauty.tRMSE, std::stod(at(rows[i + 1], "tRMSE")));
        EXPECT_EQ(r.points[i].terms.at("specular").bias, std::stod(at(rows[i + 1], "specular bias")));
        EXPECT_EQ(r.points[i].passes[3].second.median, std::stod(at(rows[i + 1], "occlusion ms")));
    }
}

TEST_F(ReportFiles, CsvOfAPointThatLacksATerm)
{
    Report r = sampleReport();
    r.points[1].terms.clear();
    writeReport(r, folder.file(""));
    const std::vector<Row> rows = csv();
    EXPECT_EQ(rows[0].size(), rows[2].size());
    EXPECT_EQ("", at(rows[2], "specular resolved"));
    EXPECT_EQ(r.points[1].passes[3].second.median, std::stod(at(rows[2], "occlusion ms")));
}

TEST_F(ReportFiles, JsonHasEverything)
{
    Report r = sampleReport();
    r.scene = "ü \"<\\\xff";
    r.points[3].beauty.flip = unknown;
    r.points[4].beauty.p99 = std::numeric_limits<double>::infinity();
    writeReport(r, folder.file("new/folder"));
    const json j = json::parse(readFile(folder.file("new/folder/tradeoff.json")));
    EXPECT_EQ("ü \"<\\\uFFFD", j["scene"]);
    ASSERT_EQ(r.points.size(), j["points"].size());
    EXPECT_EQ(r.points[0].beauty.tRMSE, j["points"][0]["beauty"]["tRMSE"]);
    EXPECT_EQ(r.points[0].frame.high, j["points"][0]["milliseconds"]["high"]);
    EXPECT_EQ("128", j["points"][0]["settings"]["occlusionLights"]);
    EXPECT_TRUE(j["points"][3]["beauty"]["flip"].is_null());
    EXPECT_TRUE(j["points"][4]["beauty"]["p99"].is_null());
    EXPECT_TRUE(j["points"][0]["number"].is_null());
    EXPECT_EQ(2, j["default"]);
    EXPECT_EQ("occlusionSteps", j["points"][j["knee"].get<size_t>()]["sweep"]);
    EXPECT_EQ(0, j["targets"][0]["point"]);
    EXPECT_EQ(4, j["targets"][1]["point"]);
    EXPECT_EQ(0.72, j["terms"]["occlusion"]["shares"]["blockers outside the view"]);
    EXPECT_EQ(3u, filesIn(folder.file("new/folder")));
}

TEST_F(ReportFiles, EmptyReport)
{
    writeReport(Report(), folder.file(""));
    EXPECT_EQ(1u, csv().size());
    EXPECT_TRUE(content()["knee"].is_null());
    EXPECT_EQ(json::array(), content()["points"]);
}

TEST_F(ReportFiles, AFullDiskIsNoticedAndTheOldFileStays)
{
    if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full";
    folder.write("tradeoff.csv", "old");
    std::filesystem::create_symlink("/dev/full", folder.file("tradeoff.csv.part"));
    const std::string failure = failureOf(sampleReport(), folder.file(""));
    EXPECT_NE(std::string::npos, failure.find("tradeoff.csv")) << failure;
    EXPECT_NE(std::string::npos, failure.find("No space left")) << failure;
    EXPECT_EQ("old", readFile(folder.file("tradeoff.csv")));
    EXPECT_FALSE(std::filesystem::exists(folder.file("tradeoff.csv.part")));
    EXPECT_TRUE(std::filesystem::exists("/dev/full"));
}

TEST_F(ReportFiles, WhereNoFileCanBe)
{
    const std::string file = folder.write("file", "");
    const std::string below = failureOf(Report(), file + "/report");
    EXPECT_NE(std::string::npos, below.find(file + "/report")) << below;
    EXPECT_NE(std::string::npos, below.find("Not a directory")) << below;
    std::filesystem::create_directories(folder.file("report/index.html/full"));
    const std::string taken = failureOf(Report(), folder.file("report"));
    EXPECT_NE(std::string::npos, taken.find("index.html")) << taken;
    EXPECT_NE(std::string::npos, taken.find("directory")) << taken;
    EXPECT_EQ(3u, filesIn(folder.file("report")));
}

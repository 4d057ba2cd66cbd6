// SPDX-License-Identifier: MIT
// The table of measured figures, and the bounds that follow from it.
#include "Suite.h"

#include <cmath>
#include <fstream>
#include <locale>
#include <sstream>
#include <stdexcept>

namespace suite
{

namespace
{

// One more CPU's last bits, another driver's filters.
const double tolerance = 1.15;

std::string measuredHeader()
{
    std::string line = "row";
    for (const char* name : figureNames) line += std::string(",") + name;
    return line + ",1-SSIM of the noise,tRMSE without O,bounced without,S at half the samples";
}

const char* const scalarHeader = "row,relMSE,tRMSE,standard error of relMSE,of tRMSE";

// Lines by the row's name.
std::map<std::string, std::string> readLines(const std::string& fileName, const std::string& header)
{
    std::map<std::string, std::string> result;
    std::ifstream in(fileName);
    std::string line;
    if (!std::getline(in, line)) return result;
    if (line != header) throw std::runtime_error(fileName + ": other columns than " + header);
    while (std::getline(in, line)) result[line.substr(0, line.find(','))] = line;
    return result;
}

template <class Array>
std::map<std::string, Array> readFigures(const std::string& fileName, const std::string& header)
{
    std::map<std::string, Array> result;
    for (const auto& [name, line] : readLines(fileName, header)) {
        std::istringstream in(line.substr(name.size()));
        in.imbue(std::locale::classic());
        char comma = 0;
        for (double& figure : result[name])
            if (!(in >> comma >> figure)) throw std::runtime_error(fileName + ": no figures in " + line);
    }
    if (result.empty()) throw std::runtime_error(fileName + ": can't be read");
    return result;
}

// A row without a line keeps the one that was there.
void writeLines(const std::string& fileName, const std::string& header, const std::map<std::string, std::string>& lines)
{
    std::map<std::string, std::string> all = lines;
    try {
        all.merge(readLines(fileName, header));
    } catch (const std::runtime_error&) {
        // Of other columns: nothing to keep.
    }
    std::ofstream out(fileName);
    out << header << "\n";
    for (const Row& row : rows())
        if (all.count(row.name())) out << all[row.name()] << "\n";
    out.close();
    if (!out) throw std::runtime_error(fileName + ": can't be written");
}

template <class Array>
std::string lineOf(const std::string& name, const Array& figures)
{
    std::ostringstream out;
    out.imbue(std::locale::classic());
    out.precision(3);
    out << name;
    for (double figure : figures) out << "," << figure;
    return out.str();
}

}  // namespace

std::map<std::string, Figures> readMeasured(const std::string& fileName)
{
    return readFigures<Figures>(fileName, measuredHeader());
}

void writeMeasured(const std::string& fileName)
{
    std::map<std::string, std::string> lines;
    for (const Row& row : rows()) {
        if (!hasResult(row) || !result(row).installed) continue;
        const Result& r = result(row);
        const double more[] = {r.dissimilarNoise, r.withoutOcclusion, r.withoutBounce, r.halfSamples};
        lines[row.name()] = lineOf(lineOf(row.name(), r.figures), more);
    }
    writeLines(fileName, measuredHeader(), lines);
}

std::map<std::string, ScalarFigures> readScalar(const std::string& fileName)
{
    return readFigures<ScalarFigures>(fileName, scalarHeader);
}

void writeScalar(const std::string& fileName, const std::map<std::string, ScalarFigures>& figures)
{
    std::map<std::string, std::string> lines;
    for (const auto& [name, values] : figures) lines[name] = lineOf(name, values);
    writeLines(fileName, scalarHeader, lines);
}

double bound(Figure figure, double measured, double noise)
{
    switch (figure) {
        case REL_MSE:  // a square
            return tolerance * tolerance * measured + noise * noise;
        case DISSIMILARITY:
            return tolerance * measured;
        case SILHOUETTE:
            return measured + 4.0 / (width * height);
        default:
            return std::hypot(tolerance * measured, noise);
    }
}

bool bounded(Figure figure, double measured)
{
    // Above 1 it is made by the few pixels of the reference that are nearly black.
    return figure != REL_MSE || measured <= 1.0;
}

}  // namespace suite

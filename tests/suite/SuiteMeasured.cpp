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

std::string header()
{
    std::string line = "row";
    for (const char* name : figureNames) line += std::string(",") + name;
    return line + ",1-SSIM of the noise,tRMSE without O,bounced without,S at half the samples";
}

// Lines by the row's name.
std::map<std::string, std::string> readLines(const std::string& fileName)
{
    std::map<std::string, std::string> result;
    std::ifstream in(fileName);
    std::string line;
    if (!std::getline(in, line)) return result;
    if (line != header()) throw std::runtime_error(fileName + ": other columns than " + header());
    while (std::getline(in, line)) result[line.substr(0, line.find(','))] = line;
    return result;
}

std::string lineOf(const Row& row, const Result& r)
{
    std::ostringstream out;
    out.imbue(std::locale::classic());
    out.precision(3);
    out << row.name();
    for (double figure : r.figures) out << "," << figure;
    out << "," << r.dissimilarNoise << "," << r.withoutOcclusion << "," << r.withoutBounce << "," << r.halfSamples;
    return out.str();
}

}  // namespace

std::map<std::string, Figures> readMeasured(const std::string& fileName)
{
    std::map<std::string, Figures> result;
    for (const auto& [name, line] : readLines(fileName)) {
        std::istringstream in(line.substr(name.size()));
        in.imbue(std::locale::classic());
        char comma = 0;
        for (double& figure : result[name])
            if (!(in >> comma >> figure)) throw std::runtime_error(fileName + ": no figures in " + line);
    }
    if (result.empty()) throw std::runtime_error(fileName + ": can't be read");
    return result;
}

void writeMeasured(const std::string& fileName)
{
    std::map<std::string, std::string> former;
    try {
        former = readLines(fileName);
    } catch (const std::runtime_error&) {
        // Of other columns: nothing to keep.
    }
    std::ofstream out(fileName);
    out << header() << "\n";
    for (const Row& row : rows()) {
        const Result& r = result(row);
        if (r.installed)
            out << lineOf(row, r) << "\n";
        else if (former.count(row.name()))
            out << former[row.name()] << "\n";
    }
    out.close();
    if (!out) throw std::runtime_error(fileName + ": can't be written");
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

// SPDX-License-Identifier: MIT
#include "Attribution.h"

#include <metrics/Display>
#include <metrics/FalseColor>
#include <metrics/Metrics>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace tradeoff
{

namespace
{

using osgEnvLight::Layer;
using osgEnvLight::Picture;

// A part that the error may be made of. A remainder is what is left of the parts before it that belong to it: taking one of
// these away takes it out of the remainder, too.
struct Part {
    std::string name;
    Picture picture;
    bool ofRemainder = false;
    bool remainder = false;
};

Picture scaled(const Picture& p, float factor)
{
    Picture result = p;
    for (float& v : result.rgba) v *= factor;
    return result;
}

Picture difference(const Picture& a, const Picture& b)
{
    Picture result = a;
    for (size_t i = 0; i < result.rgba.size(); ++i) result.rgba[i] -= b.rgba[i];
    return result;
}

double squared(const Picture& p, const osgEnvLight::Mask& mask)
{
    double sum = 0.0;
    for (int y = 0; y < p.height; ++y)
        for (int x = 0; x < p.width; ++x)
            if (mask.at(x, y)) sum += p.color(x, y).length2();
    return sum;
}

std::string rounded(double percent)
{
    std::ostringstream text;
    text.imbue(std::locale::classic());
    text << std::lround(percent) << "\u00a0%";
    return text.str();
}

// As much of the part as the error holds: of what occludes, ours may know some.
Picture heldOf(const Picture& error, const Part& part, const osgEnvLight::Mask& mask)
{
    double both = 0.0, own = 0.0;
    for (int y = 0; y < error.height; ++y)
        for (int x = 0; x < error.width; ++x)
            if (mask.at(x, y)) {
                both += error.color(x, y) * part.picture.color(x, y);
                own += part.picture.color(x, y).length2();
            }
    return scaled(part.picture, own > 0.0 ? float(std::clamp(both / own, 0.0, 1.0)) : 0.0f);
}

// The part whose removal leaves the least squared error; parts.size() if none lessens it by 1 % of total.
size_t bestPart(const Picture& error, const std::vector<Part>& parts, bool remainders, double total,
                const osgEnvLight::Mask& mask)
{
    size_t best = parts.size();
    double least = squared(error, mask) - 0.01 * total;
    for (size_t i = 0; i < parts.size(); ++i) {
        if (parts[i].remainder != remainders) continue;
        const double without = squared(difference(error, heldOf(error, parts[i], mask)), mask);
        if (without > least) continue;
        least = without;
        best = i;
    }
    return best;
}

// Greedy: the best part, then the best of what remains; remainders, which hold all that has no other name, last.
std::vector<std::pair<std::string, double>> sharesOf(Picture error, std::vector<Part> parts, const osgEnvLight::Mask& mask)
{
    std::vector<std::pair<std::string, double>> shares;
    const double total = squared(error, mask);
    while (total > 0.0) {
        size_t best = bestPart(error, parts, false, total, mask);
        if (best == parts.size()) best = bestPart(error, parts, true, total, mask);
        if (best == parts.size()) break;
        const Part part = parts[best];
        const Picture held = heldOf(error, part, mask);
        const Picture without = difference(error, held);
        shares.emplace_back(part.name, (squared(error, mask) - squared(without, mask)) / total);
        error = without;
        const auto after =
            std::find_if(parts.begin() + ptrdiff_t(best) + 1, parts.end(), [](const Part& p) { return p.remainder; });
        if (part.ofRemainder) after->picture = difference(after->picture, held);
        parts.erase(parts.begin() + ptrdiff_t(best));
    }
    std::sort(shares.begin(), shares.end(), [](const auto& x, const auto& y) { return x.second > y.second; });
    return shares;
}

// Where the error sits: its share in the hundredth of the pixels where it is largest.
double shareOfWorst(const Picture& error, const osgEnvLight::Mask& mask)
{
    std::vector<double> squares;
    double total = 0.0;
    for (int y = 0; y < error.height; ++y)
        for (int x = 0; x < error.width; ++x)
            if (mask.at(x, y)) {
                squares.push_back(error.color(x, y).length2());
                total += squares.back();
            }
    const size_t n = std::max<size_t>(squares.size() / 100, 1);
    if (squares.empty() || total <= 0.0) return 0.0;
    std::nth_element(squares.begin(), squares.begin() + ptrdiff_t(n - 1), squares.end(), std::greater<>());
    double worst = 0.0;
    for (size_t i = 0; i < n; ++i) worst += squares[i];
    return worst / total;
}

// Of a constant, the same for all pixels.
double offsetShare(const Picture& error, const osgEnvLight::Mask& mask)
{
    osg::Vec3d sum;
    for (int y = 0; y < error.height; ++y)
        for (int x = 0; x < error.width; ++x)
            if (mask.at(x, y)) sum += error.color(x, y);
    const double total = squared(error, mask);
    return total > 0.0 ? sum.length2() / (double(mask.pixels()) * total) : 0.0;
}

std::string sentenceOf(const TermPictures& t, const Picture& error, const Truth& truth, Layer layer)
{
    const Figures f = figuresOf(t.ours, truth, layer);
    if (!f.resolved) return "The difference is no larger than what the reference itself is uncertain by.";
    std::string text;
    if (t.shares.empty())
        text = rounded(100.0 * offsetShare(error, truth.maskOf(layer))) +
               " of the squared error is a common offset; the rest is too bright in some places and too dark in others.";
    else
        text = rounded(100.0 * t.shares[0].second) + " of the squared error is " + t.shares[0].first + ".";
    const osgEnvLight::Mask& mask = truth.maskOf(layer);
    const double total = squared(error, mask);
    const double noise = total > 0.0 ? std::min(1.0, squared(truth.standardErrors.at(layer), mask) / total) : 0.0;
    if (noise > 0.05) text += " " + rounded(100.0 * noise) + " of it is the reference's own noise.";
    const double worst = shareOfWorst(error, mask);
    if (worst > 0.3) text += " " + rounded(100.0 * worst) + " of it sits in 1\u00a0% of the pixels.";
    return text;
}

TermPictures entry(const std::string& term, const Picture& ours, Layer layer, const std::vector<Part>& parts, const Truth& truth)
{
    TermPictures t;
    t.term = term;
    t.ours = ours;
    t.reference = truth[layer];
    const Picture error = difference(ours, truth[layer]);
    std::vector<double> magnitudes;
    for (int y = 0; y < error.height; ++y)
        for (int x = 0; x < error.width; ++x)
            if (truth.maskOf(layer).at(x, y)) magnitudes.push_back(std::abs(osgEnvLight::luminance(error.color(x, y))));
    const double scale = std::max(osgEnvLight::percentile(magnitudes, 980), 1e-12);
    t.difference = osgEnvLight::signedDifference(ours, truth[layer], scale);
    std::ostringstream legend;
    legend.imbue(std::locale::classic());
    legend.precision(2);
    legend << "red: too bright, blue: too dark; full colour from a radiance of " << scale << ", which 2 % of the pixels exceed";
    t.differenceLegend = legend.str();
    t.shares = sharesOf(error, parts, truth.maskOf(layer));
    t.sentence = sentenceOf(t, error, truth, layer);
    return t;
}

// The occlusion's error, by what occludes; sign 1 where too little of it is too much.
std::vector<Part> occlusionParts(const Truth& truth, float sign, const Picture& error)
{
    return {
        {"occlusion by objects outside the view", scaled(truth[Layer::OCCLUSION_OUTSIDE], sign), true},
        {"occlusion by surfaces that others hide from the camera", scaled(truth[Layer::OCCLUSION_HIDDEN], sign), true},
        {"occlusion beyond the reach of the rays (occlusionRadius)", scaled(truth[Layer::OCCLUSION_FAR], sign), true},
        {"how occlusion is found: the lights, their shadow maps or points on the screen, and the filter", error, false, true}};
}

}  // namespace

std::vector<TermPictures> attribute(const Terms& ours, const Truth& truth)
{
    std::vector<TermPictures> result;
    const Picture occlusion = difference(ours.occlusion, truth[Layer::OCCLUSION]);
    const Picture specular = difference(ours.specular, truth[Layer::SPECULAR]);
    const Picture diffuse = difference(ours.diffuse, truth[Layer::DIFFUSE]);
    // Too little occlusion is too much light: the occlusion's error counts against beauty's.
    std::vector<Part> parts = occlusionParts(truth, 1.0f, scaled(occlusion, -1.0f));
    parts.push_back({"reflections that nothing occludes", difference(truth[Layer::SPECULAR], truth[Layer::SPECULAR_VISIBLE])});
    // What the reference can't tell from its own noise, which is in beauty too, is no cause.
    if (figuresOf(ours.specular, truth, Layer::SPECULAR).resolved)
        parts.push_back({"noise and blur of the reflections (specularSamples)", specular});
    if (figuresOf(ours.diffuse, truth, Layer::DIFFUSE).resolved)
        parts.push_back({"the diffuse term before occlusion (the lights or harmonics that stand for the map)", diffuse});
    if (truth.full) parts.push_back({"light from other surfaces", scaled(truth[Layer::INDIRECT], -1.0f)});
    result.push_back(entry("beauty", ours.beauty, Layer::BEAUTY, parts, truth));
    result.push_back(entry("diffuse", ours.diffuse, Layer::DIFFUSE, {}, truth));
    result.push_back(entry("specular", ours.specular, Layer::SPECULAR, {}, truth));
    result.push_back(entry("occlusion", ours.occlusion, Layer::OCCLUSION, occlusionParts(truth, -1.0f, occlusion), truth));
    return result;
}

}  // namespace tradeoff

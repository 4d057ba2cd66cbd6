// SPDX-License-Identifier: MIT
#include <metrics/Ssim>

#include <metrics/Display>

namespace osgEnvLight
{

namespace
{

ScalarMap windowMean(const ScalarMap& map)
{
    static const std::vector<double> window = gaussianKernel(1.5, 5);
    return filtered(map, window, window, Border::RENORMALISED);
}

ScalarMap encodedLuminance(const Picture& picture, double stops)
{
    const Picture encoded = displayEncoded(picture, stops);
    ScalarMap map(picture.width, picture.height);
    for (int y = 0; y < map.height; ++y)
        for (int x = 0; x < map.width; ++x) map.at(x, y) = luminance(encoded.color(x, y));
    return map;
}

ScalarMap product(ScalarMap a, const ScalarMap& b)
{
    for (size_t i = 0; i < a.values.size(); ++i) a.values[i] *= b.values[i];
    return a;
}

}  // namespace

ScalarMap ssim(const Picture& picture, const Picture& reference, double stops)
{
    requireSameSize(picture, reference);
    const ScalarMap x = encodedLuminance(picture, stops);
    const ScalarMap r = encodedLuminance(reference, stops);
    const ScalarMap meanX = windowMean(x);
    const ScalarMap meanR = windowMean(r);
    const ScalarMap xx = windowMean(product(x, x));
    const ScalarMap rr = windowMean(product(r, r));
    const ScalarMap xr = windowMean(product(x, r));
    const double c1 = 0.01 * 0.01;
    const double c2 = 0.03 * 0.03;
    ScalarMap result(x.width, x.height);
    for (size_t i = 0; i < result.values.size(); ++i) {
        const double mx = meanX.values[i];
        const double mr = meanR.values[i];
        const double varianceX = xx.values[i] - mx * mx;
        const double varianceR = rr.values[i] - mr * mr;
        const double covariance = xr.values[i] - mx * mr;
        result.values[i] =
            (2.0 * mx * mr + c1) * (2.0 * covariance + c2) / ((mx * mx + mr * mr + c1) * (varianceX + varianceR + c2));
    }
    return result;
}

}  // namespace osgEnvLight

// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "lights/LightStream.h"

#include <cstring>
#include <iostream>

#include "LightJudge.h"
#include "StudyMaps.h"

namespace LightStream_test
{

using namespace testmaths;
using glsl::vec3;
using osgEnvLight::LightList;
using osgEnvLight::LightStream;
using osgEnvLight::MapOptions;
using osgEnvLight::RadianceMap;

namespace
{

const double degree = pi / 180.0;

MapOptions noFloor()
{
    MapOptions options;
    options.sampling.floor = 0.0;  // as the study measured
    return options;
}

bool sameBytes(const LightList& a, const LightList& b)
{
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(a[0])) == 0;
}

// The frames of a sequence, each a map.
using Sequence = std::function<osg::ref_ptr<osg::Image>(int)>;

// A sky with a lamp of that radius [degrees] that holds 30 % of the flux and moves one texel a frame over the seam.
Sequence movingLamp(double radius, int width)
{
    return [=](int frame) {
        const double texel = 2.0 * pi / width;
        const double azimuth = pi + (frame - 15) * texel;
        const vec3 centre(std::cos(azimuth) * std::cos(0.5), std::sin(azimuth) * std::cos(0.5), std::sin(0.5));
        osg::ref_ptr<osg::Image> image = makeMap(
            width, width / 2, [](const vec3& d) { return vec3(d.z > 0.0 ? 0.3 + 0.5 * (1.0 - d.z) * (1.0 - d.z) : 0.12); });
        const double sky = 4.0 * pi * 0.31;  // mean of the above
        const double l = 0.3 / 0.7 * sky / (2.0 * pi * (1.0 - std::cos(radius * degree)));
        for (int y = 0; y < width / 2; ++y)
            for (int x = 0; x < width; ++x) {
                if (glsl::dot(texelDirection(x, y, width, width / 2), centre) < std::cos(radius * degree + 2.0 * texel)) continue;
                int inside = 0;
                for (int k = 0; k < 64; ++k)
                    inside += glsl::dot(texelDirection(8 * x + k % 8, 8 * y + k / 8, 8 * width, 4 * width), centre) >
                              std::cos(radius * degree);
                for (int c = 0; c < 3; ++c) texelOf(*image, x, y)[c] += float(l * inside / 64.0);
            }
        return image;
    };
}

struct Motion {
    double rms = 0.0;
    double worst = 0.0;
    double jump = 0.0;  // share of the flux without a predecessor within 2.9 degrees, mean over the frames
};

double jumped(const LightList& list, const LightList& former)
{
    double flux = 0.0;
    double lost = 0.0;
    for (const auto& l : list) {
        double cosine = -1.0;
        for (const auto& f : former)
            if (f.flux.length2() > 0.0) cosine = std::max(cosine, l.direction * f.direction);
        const double share = l.flux * osg::Vec3d(1, 1, 1);
        flux += share;
        if (cosine < std::cos(2.9 * degree)) lost += share;
    }
    return lost / flux;
}

// Change of E' - E from frame to frame over the RMS of E (sampling.md 4).
Motion motionOf(const Sequence& sequence, int frames, const MapOptions& options)
{
    Motion m;
    LightStream stream;
    std::vector<vec3> former;
    LightList formerList;
    for (int i = 0; i < frames; ++i) {
        const auto map = radianceOf(sequence(i));
        const LightJudge judge(*map, false);
        const LightList list = stream.next(*map, 128, options);
        const std::vector<vec3> difference = judge.unoccludedDifference(list);
        if (i > 0) {
            double sum = 0.0;
            for (size_t k = 0; k < difference.size(); ++k) {
                const vec3 change = (difference[k] - former[k]) / judge.scale();
                sum += glsl::dot(change, change) / double(difference.size());
                m.worst = std::max(m.worst, glsl::length(change));
            }
            m.rms += sum / (frames - 1);
            m.jump += jumped(list, formerList) / (frames - 1);
        }
        former = difference;
        formerList = list;
    }
    m.rms = std::sqrt(m.rms);
    return m;
}

void report(const char* name, const Motion& m)
{
    std::cout << name << ": ripple " << 100.0 * m.rms << " % rms, " << 100.0 * m.worst << " % worst, jump " << 100.0 * m.jump
              << " % of the flux\n";
}

}  // namespace

TEST(LightStream, StartsCold)
{
    const auto map = radianceOf(syntheticMaps(256)[1].image);
    const MapOptions options;
    LightStream stream;
    EXPECT_TRUE(sameBytes(stream.next(*map, 128, options),
                          osgEnvLight::LightSampler::create("auto")->sample(*map, 128, options.sampling)));
    EXPECT_TRUE(stream.settled());
    LightStream dealt(LightStream::DEALT);
    EXPECT_TRUE(sameBytes(dealt.next(*map, 256, options),
                          osgEnvLight::dealt(osgEnvLight::LightSampler::create("auto")->sample(*map, 256, options.sampling))));
}

TEST(LightStream, SettlesToTheColdList)
{
    // After a change, eight steps on the still map end at its cold list, whatever came before.
    const auto a = radianceOf(turned(*syntheticMaps(256)[1].image, 0.02, 0.0));
    const auto b = radianceOf(syntheticMaps(256)[1].image);
    const MapOptions options;
    for (auto order : {LightStream::PLAIN, LightStream::DEALT}) {
        LightStream cold(order);
        LightStream stream(order);
        cold.next(*b, 128, options);
        stream.next(*a, 128, options);
        stream.next(*b, 128, options);
        EXPECT_FALSE(stream.settled());
        EXPECT_FALSE(sameBytes(stream.lights(), cold.lights()));
        for (int i = 0; i < 8; ++i) {
            EXPECT_FALSE(stream.settled()) << i;
            stream.settle(*b, 128, options);
        }
        EXPECT_TRUE(stream.settled());
        EXPECT_TRUE(sameBytes(stream.lights(), cold.lights()));
    }
}

TEST(LightStream, EveryListIsSound)
{
    // Through a cut to another map, black frames and back: exact count, the map's flux, no error out of the ordinary.
    const std::vector<StudyMap> maps = syntheticMaps(256);
    const auto black = makeMap(256, 128, [](const vec3&) { return vec3(0.0); });
    LightStream stream(LightStream::DEALT);
    for (int i = 0; i < 40; ++i) {
        const auto map = radianceOf(i == 20 ? black : maps[size_t(i / 10)].image);
        const LightList& lights = stream.next(*map, 128, MapOptions());
        EXPECT_EQ(lights.size(), i == 20 ? 0u : 128u) << i;
        osg::Vec3d sum;
        for (const auto& l : lights) {
            EXPECT_NEAR(l.direction.length(), 1.0, 1e-9);
            for (int k = 0; k < 3; ++k) EXPECT_GE(l.flux[k], 0.0);
            sum += l.flux;
        }
        for (int k = 0; k < 3; ++k) EXPECT_NEAR(sum[k], map->flux[k], 1e-6 * map->flux[k]) << i;
        // Twice what the worst of the cold lists has, in the middle of a fade too.
        EXPECT_LT(LightJudge(*map, false).unoccludedError(lights), 0.01) << i;
    }
}

TEST(LightStream, MovingSun)
{
    // sampling.md 8 asks .05 % rms, .4 % worst, 1 % jump; its prototype reached .029, .29, .4.
    const Motion m = motionOf(movingLamp(0.5, 1024), 30, noFloor());
    report("moving sun", m);
    EXPECT_LT(m.rms, 0.0005);
    EXPECT_LT(m.worst, 0.004);
    EXPECT_LT(m.jump, 0.01);
}

TEST(LightStream, MovingLamp)
{
    const Motion m = motionOf(movingLamp(3.0, 1024), 30, noFloor());
    report("moving lamp", m);
    EXPECT_LT(m.rms, 0.0005);
    EXPECT_LT(m.worst, 0.004);
    EXPECT_LT(m.jump, 0.01);
}

TEST(LightStream, TurningMap)
{
    // Asked .03 % and .15 %; the prototype .014 and .09.
    const std::vector<StudyMap> maps = realMaps(1024);
    if (maps.empty()) GTEST_SKIP() << "blender-data is not installed";
    const Motion m = motionOf([&](int i) { return turned(*maps[1].image, 0.1 * degree * i, 0.0); }, 20, noFloor());
    report("courtyard turned", m);
    EXPECT_LT(m.rms, 0.0003);
    EXPECT_LT(m.worst, 0.0015);
    EXPECT_LT(m.jump, 0.01);
}

TEST(LightStream, FadedMaps)
{
    // The prototype: .040, .23, 1.9 %; asked half as much again.
    const std::vector<StudyMap> maps = realMaps(512);
    if (maps.empty()) GTEST_SKIP() << "blender-data is not installed";
    const Motion m = motionOf(
        [&](int i) {
            osg::ref_ptr<osg::Image> image = new osg::Image(*maps[1].image, osg::CopyOp::DEEP_COPY_ALL);
            float* out = reinterpret_cast<float*>(image->data());
            const float* to = reinterpret_cast<const float*>(maps[3].image->data());
            const float t = float(i) / 39.0f;
            for (size_t k = 0; k < image->getTotalSizeInBytes() / sizeof(float); ++k) out[k] += t * (to[k] - out[k]);
            return image;
        },
        40, noFloor());
    report("courtyard to interior", m);
    EXPECT_LT(m.rms, 0.0006);
    EXPECT_LT(m.worst, 0.0035);
    EXPECT_LT(m.jump, 0.03);
}

TEST(LightStream, AtMostOneTeleportAndGroupsAreKept)
{
    const Sequence sequence = movingLamp(3.0, 256);
    LightStream stream(LightStream::DEALT);
    LightList former;
    for (int i = 0; i < 20; ++i) {
        const LightList list = stream.next(*radianceOf(sequence(i)), 128, noFloor());
        for (size_t k = 0; i > 0 && k < list.size(); ++k)
            // A light near its own former place, not only near some other's: its index is its group.
            EXPECT_TRUE(int(k) == stream.teleported() || list[k].direction * former[k].direction > std::cos(20.0 * degree));
        former = list;
    }
}

}  // namespace LightStream_test

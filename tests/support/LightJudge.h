// SPDX-License-Identifier: MIT
// The two errors of a light list (sampling.md 1), against the sum over all texels: U, irradiance without occluders, and
// V, with random ones. Knows nothing of how lists are made.
#pragma once

#include <osgEnvLight/LightSampler>

#include "Maps.h"

namespace testmaths
{

/** A surface element and what it can't see: nothing, a half-space, an endless wall, or boxes. */
struct Receiver {
    enum Kind { FREE, HALF_SPACE, WALL, BOXES };
    struct Box {
        glsl::vec3 centre;
        glsl::vec3 half;
    };
    Kind kind = FREE;
    glsl::vec3 normal = glsl::vec3(0.0);
    glsl::vec3 toward = glsl::vec3(0.0);
    double limit = 0.0;
    glsl::mat3 axes = glsl::mat3(1.0);
    std::vector<Box> boxes;

    /** Cosine to d, 0 where d is occluded. */
    double cosine(const glsl::vec3& d) const;
};

/** 512: a quarter half-spaces, a quarter walls of random height, half one to three random boxes. */
std::vector<Receiver> occludedReceivers();

class LightJudge
{
  public:
    /** @param occluded  whether occludedError() will be asked: its reference takes most of the time */
    explicit LightJudge(const osgEnvLight::RadianceMap& map, bool occluded);

    /** U: sqrt(sum |E' - E|^2 / sum |E|^2) over 256 normals and RGB. */
    double unoccludedError(const osgEnvLight::LightList& lights) const;
    /** V: the same over the occluded receivers. */
    double occludedError(const osgEnvLight::LightList& lights) const;
    /** RMS error of ambient visibility over the occluded receivers, when each light stands for the solid angle of the
     * directions nearest to it: the share of the cosine that is not occluded.*/
    double visibilityError(const osgEnvLight::LightList& lights) const;

    /** Irradiance of the list over the 256 normals, minus the map's: what ripples from frame to frame. */
    std::vector<glsl::vec3> unoccludedDifference(const osgEnvLight::LightList& lights) const;
    /** RMS of the map's irradiance over the 256 normals. */
    double scale() const;

  private:
    std::vector<Receiver> _free;
    std::vector<Receiver> _occluded;
    std::vector<glsl::vec3> _freeTruth;
    std::vector<glsl::vec3> _occludedTruth;
};

/** The relative difference of two sets of irradiances. */
double relativeError(const std::vector<glsl::vec3>& e, const std::vector<glsl::vec3>& truth);

/** Irradiances of a list. */
std::vector<glsl::vec3> irradiance(const osgEnvLight::LightList& lights, const std::vector<Receiver>& receivers);

}  // namespace testmaths

/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include <osgEnvLight/LightSampler>

#include <functional>
#include <string>

namespace osgEnvLight
{

/** What carries the unoccluded diffuse term, and how well: relative RMS error of irradiance, RGB, over all normals
 * (sampling.md 1, U).*/
struct OSGENVLIGHT_EXPORT DiffuseCarrier {
    unsigned harmonics = 0;  // 9 (bands 0 to 2), 18 (bands 0, 1, 2, 4), or 0: lights
    unsigned lights = 0;     // or 0: harmonics
    double error = -1.0;     // of what was chosen; negative when not asked for
    double bound = 0.0;      // that was to be kept
    bool given = false;      // the application's own lights

    /** "9 spherical harmonics", and the error with its bound when it was asked for. */
    std::string describe() const;
};

/** Relative RMS error of irradiance from 9 and from 18 harmonics, predicted from the map's bands up to 8: within 5 % of
 * itself (sampling.md 7).*/
struct HarmonicsError {
    double nine;
    double eighteen;
};
OSGENVLIGHT_EXPORT HarmonicsError predictHarmonicsError(const RadianceMap& map);

/** The same of a list, measured over 64 normals against quadrature over the map. */
OSGENVLIGHT_EXPORT double measureLights(const RadianceMap& map, const LightList& lights);

/** The cheapest of 9 harmonics, 18, and 32, 64, 128 ... lights that errs by no more than bound; where none does, the
 * most exact.
 * @param most   lights at most
 * @param list   makes the map's list of a count
 * @param former of the map's last state, or null: it stays up to 1.2 times the bound, and something cheaper must keep
 *               bound / 1.2, so that a slowly changing map does not flicker between two*/
OSGENVLIGHT_EXPORT DiffuseCarrier chooseCarrier(const RadianceMap& map, double bound, unsigned most,
                                                const std::function<const LightList&(unsigned)>& list,
                                                const DiffuseCarrier* former = nullptr);

}  // namespace osgEnvLight

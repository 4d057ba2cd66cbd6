/* -*-c++-*- osgEnvLight, SPDX-License-Identifier: MIT */
#pragma once

#include "shadow/LitSides.h"

#include <vector>

namespace osgEnvLight
{

/** How much of the light that surfaces get comes from each side: by flux. */
std::vector<double> weightsByFlux(const std::vector<LitSide>& sides);
/** The same by what arrives at some places on surfaces, for each of which all light counts as much: the columns of a matrix of
 * lights and places, of which these are rows [Hasan, Pellacini, Bala 2007, "Matrix Row-Column Sampling for the Many-Light
 * Problem"]. A tenth is by flux: other surfaces may count, too. */
OSGENVLIGHT_EXPORT std::vector<double> weightsAt(const std::vector<LitSide>& sides, const std::vector<osg::Vec3d>& places);

/** A part of a side that is chosen, which stands for `scale` as much. */
struct ChosenPart {
    size_t side = 0;
    SidePart part;
    double scale = 0.0;

    bool isOf(const ChosenPart& o) const { return side == o.side && part.part == o.part.part && part.parts == o.part.parts; }
};

/** Parts of more sides than there may be points, by weights: heavy ones have a part each for so much of the weight as a point
 * stands for. Together they stand for all weights; sums over those chosen are on average sums over all, nearly; and where weights
 * change a little, few parts do [Duffield, Lund, Thorup 2007, "Priority Sampling for Estimation of Arbitrary Subset Sums"].
 * @param round  of choices, each independent */
OSGENVLIGHT_EXPORT std::vector<ChosenPart> chooseParts(const std::vector<double>& weights, unsigned count, unsigned round);

/** Their points. */
std::vector<EmitterPoint> chosenPoints(const std::vector<LitSide>& sides, const std::vector<double>& weights, unsigned count,
                                       unsigned round);

/** Points of many lights for a view: those that light what it shows. A point keeps its number while it is chosen, so its shadow
 * map stays; a few change in a frame. */
class OSGENVLIGHT_EXPORT PointChoice
{
  public:
    /** @param places  on surfaces that the view shows, newly measured; null: those of the last call, and by flux if there were
     * none
     * @param budget   points that may change, at most; a light's change together */
    const std::vector<EmitterPoint>& update(const std::vector<Emitter>& lights, unsigned count,
                                            const std::vector<osg::Vec3d>* places, unsigned budget);
    /** A set of its own for a frame of a still view's average, by the same weights. */
    std::vector<EmitterPoint> ofRound(const std::vector<Emitter>& lights, unsigned count, unsigned round) const;

    /** Of the lights of update(), for the front of each and then its back: 1 where there is a point of it, else 0. */
    std::vector<unsigned char> sidesWithPoints() const;

    /** Points that update() has changed, and that are yet to change. */
    unsigned changed() const { return _changed; }
    unsigned waiting() const { return _waiting; }

  private:
    void choose(const std::vector<LitSide>& sides, unsigned count);
    void exchange(unsigned budget);
    std::vector<double> weightsOf(const std::vector<LitSide>& sides) const;

    std::vector<osg::Vec3d> _places;
    std::vector<Emitter> _lights;
    std::vector<ChosenPart> _wanted, _shown;
    std::vector<EmitterPoint> _points;
    size_t _sides = 0;
    unsigned _changed = 0, _waiting = 0;
};

}  // namespace osgEnvLight

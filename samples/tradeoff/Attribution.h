// SPDX-License-Identifier: MIT
// What an error is made of, in one sentence.
#pragma once

#include "Truth.h"

namespace tradeoff
{

/** The pictures of one set of settings: beauty, and the terms as envlight-render shows them. */
struct Terms {
    osgEnvLight::Picture beauty;
    osgEnvLight::Picture diffuse;
    osgEnvLight::Picture specular;
    osgEnvLight::Picture occlusion;
};

/** For beauty and each term: the pictures, the difference, and what the error is made of. The differences between ours and
 * the reference are sums of known parts: occlusion by what is outside the view, hidden, or beyond the rays' reach; reflections
 * that nothing occludes; light from other surfaces; and what is left in each term. The part that lessens the squared error most
 * when it is taken away comes first, then the next of what remains: shares that add up. */
std::vector<TermPictures> attribute(const Terms& ours, const Truth& truth);

}  // namespace tradeoff

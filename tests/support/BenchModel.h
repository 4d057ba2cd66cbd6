// SPDX-License-Identifier: MIT
// What the frames of the benchmarks show.
#pragma once

#include <osg/Group>

class SceneRenderer;

/** Sixteen spheres on a plane, with together about that many triangles; a quarter of them metal, a quarter Phong. */
osg::ref_ptr<osg::Group> makeBenchModel(int triangles);

/** Where it is seen from. */
void lookAtBenchModel(SceneRenderer& renderer);

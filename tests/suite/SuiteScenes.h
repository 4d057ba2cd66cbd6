// SPDX-License-Identifier: MIT
// What the image suite lights, from where, and by which maps.
#pragma once

#include <SceneRenderer.h>

#include <string>

namespace suite
{

/** A scene and the view of it. */
struct SuiteScene {
    osg::ref_ptr<osgEnvLight::LitScene> lit;  // linear output, everything made at once; null where its file is not
                                              // installed
    osg::Vec3d eye;
    osg::Vec3d target;
    double fovy = 40.0;

    void add(const osg::ref_ptr<osg::Geode>& geode) { lit->addChild(geode); }
};

/** A demonstration scene (chess, atrium, swing, spheres, cornell) as the build makes it,
 * a model of assimp-testmodels (spider, wuson, fels), or one of those made by
 * code. Throws std::runtime_error for any other name. */
SuiteScene makeScene(const std::string& name);

/** The scenes made by code; lit is empty if the name is none of theirs. */
void buildScene(const std::string& name, SuiteScene& scene);

/** Put a map on the node; its rotation and intensity stay. "sky" and "studio"
 * are built in, "lamps" is red from one side and blue from the other, others
 * are blender-data's. False where that is not installed. */
bool setMap(osgEnvLight::LitScene& lit, const std::string& name);

}  // namespace suite

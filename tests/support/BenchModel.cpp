// SPDX-License-Identifier: MIT
#include "BenchModel.h"

#include <SceneRenderer.h>

#include <osgEnvLight/Material>

#include <cmath>

osg::ref_ptr<osg::Group> makeBenchModel(int triangles)
{
    using osgEnvLight::Material;
    osg::ref_ptr<osg::Group> group = new osg::Group;
    group->addChild(makeQuad(osg::Vec3d(-5, -5, -0.9), osg::Vec3d(10, 0, 0), osg::Vec3d(0, 10, 0)));
    const int segments = int(std::sqrt(triangles / 16.0));
    for (int i = 0; i < 16; ++i) {
        osg::ref_ptr<osg::Geode> sphere = makeSphere(osg::Vec3d(-3 + 2 * (i % 4), -3 + 2 * (i / 4), 0), 0.9, segments);
        osg::StateSet& s = *sphere->getOrCreateStateSet();
        if (i % 4 == 0) Material::setCookTorrance(s, osg::Vec3f(0.9f, 0.7f, 0.3f), 1.0f, 0.3f);
        if (i % 4 == 1) Material::setPhong(s, osg::Vec3f(0.4f, 0.1f, 0.1f), osg::Vec3f(0.3f, 0.3f, 0.3f), 60.0f);
        group->addChild(sphere);
    }
    return group;
}

void lookAtBenchModel(SceneRenderer& renderer)
{
    renderer.lookAt(osg::Vec3d(1, -11, 7), osg::Vec3d(0, 0, -0.5), osg::Vec3d(0, 0, 1), 35.0);
}

// SPDX-License-Identifier: MIT
// The map lights, reflects and shows in the background from the same side, in Blender's convention.
#include <SceneRenderer.h>

#include <osgEnvLight/Material>

#include <gtest/gtest.h>

namespace Orientation_test
{

using osgEnvLight::LitScene;
using osgEnvLight::Material;

namespace
{

const osg::Vec3d axes[6] = {osg::Vec3d(1, 0, 0),  osg::Vec3d(-1, 0, 0), osg::Vec3d(0, 1, 0),
                            osg::Vec3d(0, -1, 0), osg::Vec3d(0, 0, 1),  osg::Vec3d(0, 0, -1)};

osg::Vec3d upFor(const osg::Vec3d& d)
{
    return std::abs(d.z()) > 0.5 ? osg::Vec3d(1, 0, 0) : osg::Vec3d(0, 0, 1);
}

void expectColor(const osg::Vec3d& found, const osg::Vec3d& expected, const char* what, const osg::Vec3d& d)
{
    for (int k = 0; k < 3; ++k)
        EXPECT_NEAR(found[k], expected[k], 0.02) << what << " towards " << d.x() << " " << d.y() << " " << d.z();
}

// A map of 8 x 4 texels as Blender would show it, written by hand: the columns of the second row (above the horizon)
// look, from left to right, towards -X+, -Y.. : the centre +X, a quarter right of it -Y.
osg::ref_ptr<osg::Image> handMade()
{
    osg::ref_ptr<osg::Image> image = new osg::Image;
    image->allocateImage(360, 180, 1, GL_RGB, GL_FLOAT);
    for (int y = 0; y < 180; ++y)  // from the top
        for (int x = 0; x < 360; ++x) {
            osg::Vec3f c(0, 0, 0);
            if (y < 20)
                c = osg::Vec3f(0, 0, 1);  // +Z
            else if (y >= 160)
                c = osg::Vec3f(1, 1, 0);  // -Z
            else if (x >= 150 && x < 210)
                c = osg::Vec3f(1, 0, 0);  // centre: +X
            else if (x >= 240 && x < 300)
                c = osg::Vec3f(1, 0, 1);  // a quarter right of it: -Y
            else if (x >= 60 && x < 120)
                c = osg::Vec3f(0, 1, 0);  // a quarter left of it: +Y
            else if (x < 30 || x >= 330)
                c = osg::Vec3f(0, 1, 1);  // the edges: -X
            *reinterpret_cast<osg::Vec3f*>(image->data(unsigned(x), unsigned(179 - y))) = c;
        }
    return image;
}

}  // namespace

TEST(Orientation, BackgroundMirrorAndLightAgree)
{
    SceneRenderer renderer(33, 33);
    for (double rotation : {0.0, 90.0}) {
        for (const osg::Vec3d& axis : axes) {
            const osg::Vec3d expected = sixDirectionColor(axis);
            // Turning the map counter-clockwise brings what lay towards d to the direction turned with it.
            const osg::Vec3d d = osg::Quat(osg::DegreesToRadians(rotation), osg::Vec3d(0, 0, 1)) * axis;
            osg::ref_ptr<LitScene> lit = makeLit(handMade().get());
            lit->getEnvironmentMap()->setRotation(rotation);
            lit->addChild(makeSphere(osg::Vec3d(), 1.0));
            Material::setCookTorrance(*lit->getChild(0)->getOrCreateStateSet(), osg::Vec3f(1, 1, 1), 1.0f, 0.0f);

            renderer.lookAt(d * 10.0, d * 20.0, upFor(d), 10.0);  // away from the sphere
            expectColor(renderer.render(lit).color(16, 16), expected, "background", d);

            renderer.lookAt(d * 4.0, osg::Vec3d(), upFor(d), 10.0);  // head-on: the mirror shows what lies behind the eye
            expectColor(renderer.render(lit).color(16, 16), expected, "mirror", d);

            Material::setLambert(*lit->getChild(0)->getOrCreateStateSet(), osg::Vec3f(1, 1, 1));
            const osg::Vec3d shade = renderer.render(lit).color(16, 16);
            for (int k = 0; k < 3; ++k)
                for (int j = 0; j < 3; ++j) {
                    if (expected[k] <= expected[j]) continue;
                    EXPECT_GT(shade[k], shade[j]) << "light from " << d.x() << " " << d.y() << " " << d.z();
                }
        }
    }
}

}  // namespace Orientation_test

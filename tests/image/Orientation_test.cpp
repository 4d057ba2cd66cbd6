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
        osg::ref_ptr<LitScene> lit = makeLit(handMade().get());
        lit->getEnvironmentMap()->setRotation(rotation);
        lit->addChild(makeSphere(osg::Vec3d(), 1.0));
        osg::StateSet& material = *lit->getChild(0)->getOrCreateStateSet();
        const auto seen = [&](const osg::Vec3d& eye, const osg::Vec3d& target, const osg::Vec3d& up) {
            renderer.lookAt(eye, target, up, 10.0);
            return renderer.render(lit).color(16, 16);
        };
        // Turning the map counter-clockwise brings what lay towards d to the direction turned with it.
        const auto turned = [&](const osg::Vec3d& axis) {
            return osg::Quat(osg::DegreesToRadians(rotation), osg::Vec3d(0, 0, 1)) * axis;
        };
        Material::setCookTorrance(material, osg::Vec3f(1, 1, 1), 1.0f, 0.0f);
        for (const osg::Vec3d& axis : axes) {
            const osg::Vec3d d = turned(axis);
            expectColor(seen(d * 10.0, d * 20.0, upFor(d)), sixDirectionColor(axis), "background", d);  // away from the sphere
            // Head-on the mirror shows what lies behind the eye.
            expectColor(seen(d * 4.0, osg::Vec3d(), upFor(d)), sixDirectionColor(axis), "mirror", d);
        }
        Material::setLambert(material, osg::Vec3f(1, 1, 1));
        for (const osg::Vec3d& axis : axes) {
            const osg::Vec3d d = turned(axis), expected = sixDirectionColor(axis);
            const osg::Vec3d shade = seen(d * 4.0, osg::Vec3d(), upFor(d));
            for (int k = 0; k < 3; ++k)
                for (int j = 0; j < 3; ++j) {
                    if (expected[k] <= expected[j]) continue;
                    EXPECT_GT(shade[k], shade[j]) << "light from " << d.x() << " " << d.y() << " " << d.z();
                }
        }
    }
}

}  // namespace Orientation_test

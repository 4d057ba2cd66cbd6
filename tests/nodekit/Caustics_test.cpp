// SPDX-License-Identifier: MIT
// What polished metal throws of lights onto other surfaces, against the integral of its lobe over the metal.
#include "LampScene.h"

#include <osg/MatrixTransform>

#include <cmath>

namespace Caustics_test
{

using namespace lampscene;

namespace
{

const int side = 256;              // of the picture, whose cells of 4x4 pixels are as wide as the narrowest lobe
const double screenAlbedo = 0.05;  // what comes back to the metal and again to the screen is a twentieth of what is compared

// GGX's lobe with height-correlated Smith masking, F = 1, in the frame of its normal [Heitz 2014].
double lobe(const osg::Vec3d& v, const osg::Vec3d& l, double alpha)
{
    if (v.z() <= 0.0 || l.z() <= 0.0) return 0.0;
    osg::Vec3d h = v + l;
    h.normalize();
    const double a2 = alpha * alpha, t = h.z() * h.z() * (a2 - 1.0) + 1.0;
    const auto lambda = [&](double c) { return 0.5 * (std::sqrt(1.0 + a2 * (1.0 - c * c) / (c * c)) - 1.0); };
    return a2 / (osg::PI * t * t) / (1.0 + lambda(v.z()) + lambda(l.z())) / (4.0 * v.z() * l.z());
}

// What that lobe reflects of light from l: the metal is white, and what is left out goes on between its facets and out, too.
double albedo(const osg::Vec3d& l, double alpha)
{
    const int count = 64;
    double sum = 0.0;
    for (int i = 0; i < count; ++i)
        for (int k = 0; k < count; ++k) {
            const double square = (i + 0.5) / count, turn = 2.0 * osg::PI * (k + 0.5) / count, r = std::sqrt(square);
            sum += lobe(osg::Vec3d(r * std::cos(turn), r * std::sin(turn), std::sqrt(1.0 - square)), l, alpha);
        }
    return osg::PI * sum / (count * count);
}

}  // namespace

// A metal plate below and before the screen, lit by a light so that it shines at the screen.
class CausticScene : public LampScene
{
  protected:
    CausticScene() : LampScene(side)
    {
        Settings& s = *lit->getSettings();
        s.bounce = Settings::BOUNCE_PROBES;
        s.caustics = Settings::CAUSTICS_ON;
        s.regeneration = Settings::IMMEDIATE;
        s.antialias = Settings::ANTIALIAS_OFF;
        Material::setLambert(*lit->getChild(0)->getOrCreateStateSet(), osg::Vec3f(1, 1, 1) * float(screenAlbedo));
        plate->addChild(makeQuad(corner, osg::Vec3d(edge, 0, 0), osg::Vec3d(0, edge, 0)));
        setRoughness(0.3);
        lit->addChild(plate);
    }

    void setRoughness(double r) { Material::setCookTorrance(*plate->getOrCreateStateSet(), osg::Vec3f(1, 1, 1), 1.0f, float(r)); }

    // What the screen sends of the plate's light, by what it sends without: pictures in which nothing else differs.
    Picture thrown()
    {
        Picture with = render();
        EXPECT_TRUE(lit->plan().runs("caustics")) << reasonOf(*lit, "reflectivemap");
        lit->getSettings()->bounce = Settings::BOUNCE_OFF;
        const Picture without = render();
        lit->getSettings()->bounce = Settings::BOUNCE_PROBES;
        for (size_t i = 0; i < with.rgba.size(); ++i) with.rgba[i] -= without.rgba[i];
        return with;
    }

    // The same by quadrature. position: of the light, as OpenGL has it; unattenuated, of colour 1.
    double expected(const osg::Vec3d& on, const osg::Vec4d& position, double roughness) const
    {
        const int count = 100;
        const osg::Vec3d at(position.x(), position.y(), position.z());
        osg::Vec3d middle = at - (corner + osg::Vec3d(edge, edge, 0.0) * 0.5) * position.w();
        middle.normalize();
        double sum = 0.0;
        for (int i = 0; i < count; ++i)
            for (int k = 0; k < count; ++k) {
                const osg::Vec3d p = corner + osg::Vec3d((i + 0.5) / count, (k + 0.5) / count, 0.0) * edge;
                osg::Vec3d l = at - p * position.w(), v = on - p;
                l.normalize();
                const double square = v.length2();
                v.normalize();
                sum += lobe(v, l, roughness * roughness) * l.z() * v.z() * v.y() / square;  // the light's irradiance is pi
            }
        return screenAlbedo * sum * edge * edge / (count * count) / albedo(middle, roughness * roughness);
    }

    // Of the pixels of the screen that show light of the plate: the root mean square of the difference over the mean.
    double error(const Picture& p, const osg::Vec4d& position, double roughness) const
    {
        double squares = 0.0, sum = 0.0;
        int pixels = 0;
        for (int y = side / 2; y < side; y += 8)  // above the plate
            for (int x = 0; x < side; x += 8, ++pixels) {
                const double e = expected(pointAt(x, y), position, roughness);
                squares += std::pow(p.color(x, y)[0] - e, 2);
                sum += e;
            }
        return std::sqrt(squares / pixels) / (sum / pixels);
    }

    static double meanAbove(const Picture& p)
    {
        double sum = 0.0;
        for (int y = side / 2; y < side; ++y)
            for (int x = 0; x < side; ++x) sum += p.color(x, y)[0];
        return sum / (side * side / 2);
    }

    osg::Vec3d pointAt(int x, int y) const { return osg::Vec3d(x + 0.5 - side / 2, 0.0, y + 0.5 - side / 2) * pixel; }

    const double pixel = 8.0 * std::tan(osg::DegreesToRadians(30.0)) / side;
    const osg::Vec3d corner{-0.5, -2.2, -1.2};
    const double edge = 1.0;  // of the plate
    const osg::ref_ptr<osg::MatrixTransform> plate = new osg::MatrixTransform;
};

TEST_F(CausticScene, IsTheIntegralOfTheLobe)
{
    const osg::Vec4d sun(0.1, -0.7, 0.7, 0.0), lamp(0.2, -3.0, 0.4, 1.0);
    for (const osg::Vec4d& position : {sun, lamp}) {
        const osg::ref_ptr<osg::LightSource> light = makeLight(1, osg::Vec4(position));
        root->insertChild(0, light);
        for (const double roughness : {0.2, 0.3, 0.5}) {
            setRoughness(roughness);
            const Picture p = thrown();
            // Measured: .070, .066, .029; .059, .034, .020. The narrowest lobe is blurred over the cells of pixels.
            EXPECT_LT(error(p, position, roughness), roughness < 0.4 ? 0.09 : 0.04) << roughness << " " << position.w();
        }
        root->removeChild(light);
    }
}

// Where the plate shines at a wall, the wall behind that one stays dark.
TEST_F(CausticScene, EndsAtWhatItMeets)
{
    root->insertChild(0, makeLight(1, osg::Vec4(0.1f, -0.7f, 0.7f, 0.0f)));
    const double open = meanAbove(thrown());
    lit->addChild(makeBox(osg::Vec3d(-3, -0.9, -1.15), osg::Vec3d(3, -0.85, 3)));
    renderer.lookAt(osg::Vec3d(0, -0.8, 0.4), osg::Vec3d(0, 0, 0.4), osg::Vec3d(0, 0, 1), 90.0);  // between both walls
    const Picture p = thrown();
    double most = 0.0;
    for (size_t i = 0; i < p.rgba.size(); i += 4) most = std::max(most, double(p.rgba[i]));
    EXPECT_LT(most, 0.1 * open);
}

// In the next frame.
TEST_F(CausticScene, FollowsTheMetal)
{
    root->insertChild(0, makeLight(1, osg::Vec4(0.0f, -0.7f, 0.7f, 0.0f)));
    const auto sides = [&] {
        const Picture p = renderer.render(root, 1);
        double left = 0.0, right = 0.0;
        for (int y = side / 2; y < side; ++y)
            for (int x = 0; x < side; ++x) (x < side / 2 ? left : right) += p.color(x, y)[0] - screenAlbedo * std::sqrt(0.5);
        return left / right;
    };
    renderer.render(root, 2);
    EXPECT_NEAR(1.0, sides(), 0.02);
    plate->setMatrix(osg::Matrixd::translate(-0.5, 0, 0));
    EXPECT_GT(sides(), 1.5);
    plate->setMatrix(osg::Matrixd::translate(0.5, 0, 0));
    EXPECT_LT(sides(), 0.67);
}

// The power does not go with the map's texels [systems.md E17], nor with the number of virtual lights.
TEST_F(CausticScene, IsAsBrightWithOtherMapsAndLights)
{
    const osg::ref_ptr<osg::LightSource> light = makeLight(1, osg::Vec4(0.2f, -3.0f, 0.4f, 1.0f));
    root->insertChild(0, light);
    Settings& s = *lit->getSettings();
    const double usual = meanAbove(thrown());
    for (const auto& [size, lights] : {std::pair(64, 512), std::pair(1000, 512), std::pair(256, 128), std::pair(256, 2040)}) {
        s.causticMapSize = size;
        s.causticLights = lights;
        EXPECT_NEAR(usual, meanAbove(thrown()), 0.01 * usual) << size << " " << lights;
    }
}

// Nothing of it where there is no metal, no light with a shadow map, or, by itself, too little metal.
TEST_F(CausticScene, RunsWhereMetalThrowsLight)
{
    const auto why = [&] {
        renderer.render(root, 12);  // what has moved joins what stands still after eight
        return reasonOf(*lit, "reflectivemap");
    };
    lit->getEnvironmentMap()->setImage(constantMap(0.1));
    EXPECT_EQ("off, no sun or lamp has a shadow map", why());
    root->insertChild(0, makeLight(1, osg::Vec4(0.1f, -0.7f, 0.7f, 0.0f)));
    EXPECT_EQ("what polished metal reflects of suns and lamps, where it changes, 1 map", why());
    for (const char* pass : {"virtuallights", "caustics", "causticrows", "causticfilter"})
        EXPECT_TRUE(lit->plan().runs(pass)) << pass;
    lit->getSettings()->caustics = Settings::CAUSTICS_AUTO;  // the plate's area is a thirty-seventh of all
    EXPECT_EQ("off, too little is of polished metal", why());
    EXPECT_FALSE(lit->plan().runs("caustics"));
    plate->setMatrix(osg::Matrixd::scale(2, 1, 1));
    EXPECT_EQ("what polished metal reflects of suns and lamps, where it changes, 1 map", why());
    lit->getSettings()->caustics = Settings::CAUSTICS_OFF;
    EXPECT_EQ("off, switched off", why());
    lit->getSettings()->caustics = Settings::CAUSTICS_ON;
    setRoughness(0.8);
    EXPECT_EQ("off, nothing is of polished metal", why());
}

}  // namespace Caustics_test

// SPDX-License-Identifier: MIT
// What the children's state means: materials, vertex colours, textures, transparency, programs of the user's own.
#include <SceneRenderer.h>

#include <osgEnvLight/GBufferCallback>
#include <osgEnvLight/Material>

#include <osg/AlphaFunc>
#include <osg/Geometry>
#include <osg/Material>
#include <osg/MatrixTransform>
#include <osg/Texture2D>

#include <gtest/gtest.h>

namespace Surfaces_test
{

using osgEnvLight::LitScene;
using osgEnvLight::Material;
using osgEnvLight::Settings;

namespace
{

// A quad that fills the view of a camera at (0,-4,0) looking along +Y, facing it.
osg::ref_ptr<osg::Geode> screen(double y = 0.0, double halfSize = 3.0)
{
    return makeQuad(osg::Vec3d(-halfSize, y, -halfSize), osg::Vec3d(2 * halfSize, 0, 0), osg::Vec3d(0, 0, 2 * halfSize));
}

osg::ref_ptr<LitScene> whiteFurnace()
{
    osg::ref_ptr<LitScene> lit = makeLit(constantMap(1.0).get());
    lit->getSettings()->occlusion = false;
    return lit;
}

osg::Vec3d centre(SceneRenderer& renderer, osg::Node* node)
{
    return renderer.render(node, 2).color(16, 16);
}

void setMaterial(osg::StateSet& s, const osg::Vec4& diffuse, const osg::Vec4& specular = osg::Vec4(0, 0, 0, 1),
                 osg::Material::ColorMode mode = osg::Material::OFF)
{
    osg::ref_ptr<osg::Material> m = new osg::Material;
    m->setDiffuse(osg::Material::FRONT_AND_BACK, diffuse);
    m->setSpecular(osg::Material::FRONT_AND_BACK, specular);
    m->setShininess(osg::Material::FRONT_AND_BACK, 20.0f);
    m->setColorMode(mode);
    s.setAttributeAndModes(m.get());
}

osg::ref_ptr<osg::Texture2D> texture(const osg::Vec4ub& color)
{
    osg::ref_ptr<osg::Image> image = new osg::Image;
    image->allocateImage(4, 4, 1, GL_RGBA, GL_UNSIGNED_BYTE);
    for (int i = 0; i < 16; ++i) reinterpret_cast<osg::Vec4ub*>(image->data())[i] = color;
    return new osg::Texture2D(image);
}

// sRGB, IEC 61966-2-1, above its toe.
double decoded(double display)
{
    return std::pow((display + 0.055) / 1.055, 2.4);
}

const double linear128 = decoded(128.0 / 255.0);
const double small = 0.003;  // SH of a constant map in half floats: .05 %; the rest is 8-bit input

}  // namespace

class Surfaces : public testing::Test
{
  protected:
    SceneRenderer renderer{32, 32};
};

TEST_F(Surfaces, OsgMaterialDiffuseIsLambert)
{
    osg::ref_ptr<LitScene> lit = whiteFurnace();
    lit->addChild(screen());
    setMaterial(*lit->getChild(0)->getOrCreateStateSet(), osg::Vec4(0.2f, 0.5f, 0.8f, 1));
    const osg::Vec3d c = centre(renderer, lit);
    EXPECT_NEAR(c[0], decoded(0.2), small);
    EXPECT_NEAR(c[1], decoded(0.5), small);
    EXPECT_NEAR(c[2], decoded(0.8), small);
    EXPECT_FALSE(lit->plan().runs("specular"));
    lit->getSettings()->materialColors = Settings::COLORS_LINEAR;
    EXPECT_NEAR(centre(renderer, lit)[1], 0.5, small);
}

TEST_F(Surfaces, OsgMaterialNeverReflectsMoreThanItReceives)
{
    osg::ref_ptr<LitScene> lit = whiteFurnace();
    lit->addChild(screen());
    setMaterial(*lit->getChild(0)->getOrCreateStateSet(), osg::Vec4(0.8f, 0.8f, 0.8f, 1), osg::Vec4(1, 1, 1, 1));
    const osg::Vec3d c = centre(renderer, lit);
    EXPECT_TRUE(lit->plan().runs("specular"));
    EXPECT_LE(c[0], 1.0 + small);
    EXPECT_GT(c[0], 0.9);  // at normal incidence the lobe of n = 20 loses a few per cent below the horizon at most
}

TEST_F(Surfaces, ColorModeTakesVertexColours)
{
    for (osg::Material::ColorMode mode : {osg::Material::OFF, osg::Material::DIFFUSE, osg::Material::AMBIENT_AND_DIFFUSE}) {
        osg::ref_ptr<LitScene> lit = whiteFurnace();
        osg::ref_ptr<osg::Geode> geode = screen();
        osg::ref_ptr<osg::Vec4Array> colors = new osg::Vec4Array;
        colors->push_back(osg::Vec4(0.1f, 0.6f, 0.3f, 1));
        geode->getDrawable(0)->asGeometry()->setColorArray(colors.get(), osg::Array::BIND_OVERALL);
        setMaterial(*geode->getOrCreateStateSet(), osg::Vec4(0.5f, 0.5f, 0.5f, 1), osg::Vec4(0, 0, 0, 1), mode);
        lit->addChild(geode);
        EXPECT_NEAR(centre(renderer, lit)[1], decoded(mode == osg::Material::OFF ? 0.5 : 0.6), small) << "mode " << mode;
    }
}

TEST_F(Surfaces, TexturesAreDecodedFromSrgbAndOnlyWhereSwitchedOn)
{
    for (bool on : {false, true}) {
        osg::ref_ptr<LitScene> lit = whiteFurnace();
        osg::ref_ptr<osg::Geode> geode = screen();
        osg::ref_ptr<osg::Vec2Array> st = new osg::Vec2Array(4);
        std::fill(st->begin(), st->end(), osg::Vec2(0.5f, 0.5f));  // away from the border that OSG clamps to
        geode->getDrawable(0)->asGeometry()->setTexCoordArray(0, st.get());
        osg::StateSet& s = *geode->getOrCreateStateSet();
        setMaterial(s, osg::Vec4(1, 1, 1, 1));
        s.setTextureAttribute(0, texture(osg::Vec4ub(128, 128, 128, 255)).get());
        s.setTextureMode(0, GL_TEXTURE_2D, on);
        lit->addChild(geode);
        EXPECT_NEAR(centre(renderer, lit)[0], on ? linear128 : 1.0, small);
    }
}

TEST_F(Surfaces, UnlitGeometryEmitsItsColour)
{
    osg::ref_ptr<LitScene> lit = whiteFurnace();
    lit->getEnvironmentMap()->setIntensity(0.0);  // nothing but emission
    osg::ref_ptr<osg::Geode> geode = screen();
    osg::ref_ptr<osg::Vec4Array> colors = new osg::Vec4Array;
    colors->push_back(osg::Vec4(128 / 255.0f, 1, 0, 1));
    geode->getDrawable(0)->asGeometry()->setColorArray(colors.get(), osg::Array::BIND_OVERALL);
    geode->getOrCreateStateSet()->setMode(GL_LIGHTING, osg::StateAttribute::OFF);
    lit->addChild(geode);
    const osg::Vec3d c = centre(renderer, lit);
    EXPECT_NEAR(c[0], linear128, small);
    EXPECT_NEAR(c[1], 1.0, small);
    EXPECT_FALSE(lit->plan().runs("diffuse"));  // a black map: the plan says so
}

TEST_F(Surfaces, BackFacesMissingNormalsAndMirroredTransformsAreLitFromTheirSeenSide)
{
    // Light comes from -Y only, where the camera is: a surface whose normal points away would be black.
    const auto map = makeMap(64, 32, [](const osg::Vec3d& d) { return d.y() < 0 ? osg::Vec3d(1, 1, 1) : osg::Vec3d(); });
    for (int kind = 0; kind < 4; ++kind) {
        osg::ref_ptr<LitScene> lit = makeLit(map.get());
        lit->getSettings()->occlusion = false;
        osg::ref_ptr<osg::Geode> geode = screen();
        Material::setLambert(*geode->getOrCreateStateSet(), osg::Vec3f(1, 1, 1));
        osg::ref_ptr<osg::MatrixTransform> transform = new osg::MatrixTransform;
        transform->addChild(geode);
        if (kind == 1) transform->setMatrix(osg::Matrix::rotate(osg::PI, 0, 0, 1));  // seen from behind
        if (kind == 2) transform->setMatrix(osg::Matrix::scale(-1, 1, 1));           // winding inverted
        if (kind == 3) geode->getDrawable(0)->asGeometry()->setNormalArray(nullptr);
        lit->addChild(transform);
        EXPECT_NEAR(centre(renderer, lit)[0], 1.0, 0.01) << "kind " << kind;  // the list's own error
    }
}

TEST_F(Surfaces, ParallelRaysMeetTheSideThatFacesThem)
{
    // A plane right of the axis that parallel rays meet from its right, while a line from the middle of the lens would meet
    // it from its left. Light comes from its right only: a normal on the other side would be black.
    const osg::Vec3d normal(0.9, -0.4, 0.0);
    const auto map = makeMap(64, 32, [&](const osg::Vec3d& d) { return d * normal > 0 ? osg::Vec3d(1, 1, 1) : osg::Vec3d(); });
    osg::Camera& camera = *renderer.viewer().getCamera();
    camera.setViewMatrixAsLookAt(osg::Vec3d(0, -4, 0), osg::Vec3d(), osg::Vec3d(0, 0, 1));
    camera.setProjectionMatrixAsOrtho(1.5, 2.5, -0.5, 0.5, 1.0, 100.0);
    for (bool transparent : {false, true})
        for (double sense : {1.0, -1.0}) {
            const osg::ref_ptr<LitScene> lit = makeLit(map.get());
            lit->getSettings()->occlusion = false;
            const osg::ref_ptr<osg::Geode> plane =
                makeQuad(osg::Vec3d(1.2, -1.8, -2 * sense), osg::Vec3d(1.6, 3.6, 0), osg::Vec3d(0, 0, 4 * sense));
            osg::StateSet& s = *plane->getOrCreateStateSet();
            Material::setLambert(s, osg::Vec3f(1, 1, 1));
            if (transparent) {
                s.setMode(GL_BLEND, osg::StateAttribute::ON);
                s.setRenderingHint(osg::StateSet::TRANSPARENT_BIN);
            }
            lit->addChild(plane);
            EXPECT_NEAR(centre(renderer, lit)[0], 1.0, 0.01) << "transparent " << transparent << ", winding " << sense;
        }
}

TEST_F(Surfaces, AlphaTestCutsHoles)
{
    osg::ref_ptr<LitScene> lit = whiteFurnace();
    lit->getSettings()->background = Settings::BACKGROUND_OFF;
    osg::ref_ptr<osg::Geode> geode = screen();
    setMaterial(*geode->getOrCreateStateSet(), osg::Vec4(1, 1, 1, 0.3f));
    geode->getOrCreateStateSet()->setAttributeAndModes(new osg::AlphaFunc(osg::AlphaFunc::GREATER, 0.5f));
    lit->addChild(geode);
    EXPECT_EQ(0.0f, renderer.render(lit, 2).alpha(16, 16));
    setMaterial(*geode->getOrCreateStateSet(), osg::Vec4(1, 1, 1, 0.7f));
    EXPECT_EQ(1.0f, renderer.render(lit, 2).alpha(16, 16));
}

TEST_F(Surfaces, TransparentOnesAreDrawnOverTheLitSceneAndBehindWhatHidesThem)
{
    osg::ref_ptr<LitScene> lit = whiteFurnace();
    lit->getSettings()->background = Settings::BACKGROUND_OFF;
    auto add = [&](double y, const osg::Vec4& color) {
        osg::ref_ptr<osg::Geode> geode = screen(y);
        setMaterial(*geode->getOrCreateStateSet(), color);
        if (color.a() < 1.0f) {
            geode->getOrCreateStateSet()->setMode(GL_BLEND, osg::StateAttribute::ON);
            geode->getOrCreateStateSet()->setRenderingHint(osg::StateSet::TRANSPARENT_BIN);
        }
        lit->addChild(geode);
        return geode;
    };
    add(0.0, osg::Vec4(1, 0, 0, 1));
    osg::ref_ptr<osg::Geode> pane = add(-1.0, osg::Vec4(0, 1, 0, 0.25f));
    const osg::Vec3d over = centre(renderer, lit);
    EXPECT_NEAR(over[0], 0.75, 0.01);  // .75 red + .25 green, both lit by the furnace
    EXPECT_NEAR(over[1], 0.25, 0.01);
    EXPECT_EQ(1u, lit->plan().surfaces.forward);
    lit->removeChild(pane);
    add(1.0, osg::Vec4(0, 1, 0, 0.25f));  // behind: the composite's depth hides it
    EXPECT_NEAR(centre(renderer, lit)[1], 0.0, 0.001);
}

TEST_F(Surfaces, AProgramOfTheUsersIsDrawnAsWithoutUs)
{
    osg::ref_ptr<osg::Geode> geode = screen(0.0, 0.7);
    osg::ref_ptr<osg::Program> program = new osg::Program;
    program->addShader(new osg::Shader(osg::Shader::FRAGMENT, "void main() { gl_FragColor = vec4(0.125, 0.5, 0.75, 1.0); }"));
    geode->getOrCreateStateSet()->setAttributeAndModes(program.get());
    osg::ref_ptr<osg::Group> plain = new osg::Group;
    plain->addChild(geode);
    const Picture before = renderer.render(plain, 2);
    osg::ref_ptr<LitScene> lit = whiteFurnace();
    lit->getSettings()->background = Settings::BACKGROUND_OFF;
    lit->addChild(geode);
    EXPECT_EQ(before.rgba, renderer.render(lit, 2).rgba);
}

TEST_F(Surfaces, ACameraOfTheApplicationsFillsTheGBuffer)
{
    osg::ref_ptr<osg::Geode> geode = screen(0.0, 1.0);
    Material::setCookTorrance(*geode->getOrCreateStateSet(), osg::Vec3f(0.4f, 0.6f, 0.2f), 0.0f, 0.5f);
    osg::ref_ptr<LitScene> own = whiteFurnace();
    own->addChild(geode);
    osg::Camera& host = *renderer.viewer().getCamera();
    host.setComputeNearFarMode(osg::CullSettings::DO_NOT_COMPUTE_NEAR_FAR);
    host.setProjectionMatrixAsPerspective(40, 1, 1, 20);
    const Picture expected = renderer.render(own, 2);

    osg::ref_ptr<LitScene> lit = whiteFurnace();
    osg::ref_ptr<osg::Camera> camera = new osg::Camera;
    camera->setRenderOrder(osg::Camera::PRE_RENDER);
    camera->setComputeNearFarMode(osg::CullSettings::DO_NOT_COMPUTE_NEAR_FAR);
    camera->setProjectionMatrix(host.getProjectionMatrix());
    camera->setReferenceFrame(osg::Transform::ABSOLUTE_RF);
    camera->setViewMatrix(host.getViewMatrix());
    osg::ref_ptr<osgEnvLight::GBufferCallback> fill = new osgEnvLight::GBufferCallback(32, 32);
    fill->attachTo(*camera);
    camera->addChild(geode);
    lit->addChild(camera);
    lit->setGBuffer(fill->getGBuffer());
    const Picture found = renderer.render(lit, 2);
    EXPECT_GT(found.alpha(16, 16), 0.5f);
    EXPECT_LT(largestDifference(expected, found), 1e-3);

    NotifyCatcher notify;
    lit->setGBuffer(osg::ref_ptr<osgEnvLight::GBufferCallback>(new osgEnvLight::GBufferCallback(16, 24))->getGBuffer());
    renderer.render(lit, 2);
    EXPECT_NE(std::string::npos, notify.text().find("16x24, expected the view's 32x32")) << notify.text();
}

// At a body's outline back and front have the same depth, and a pixel may show the back. Its normal must not point into the body,
// from where no sky is seen. A sheet that is seen from behind turns its normal at any angle.
TEST_F(Surfaces, NormalsFaceTheEyeAtOutlines)
{
    const int size = 160;
    SceneRenderer large(size, size);
    const osg::ref_ptr<LitScene> lit = whiteFurnace();
    lit->getSettings()->view = Settings::NORMAL;
    lit->getSettings()->background = Settings::BACKGROUND_OFF;
    for (int i = 0; i < 64; ++i) lit->addChild(makeSphere(osg::Vec3d(i % 8 * 1.1 - 3.85, 0, i / 8 * 1.1 - 3.85), 0.5, 48));
    large.lookAt(osg::Vec3d(0, -30, 0), osg::Vec3d(), osg::Vec3d(0, 0, 1), 17.0);
    const Picture p = large.render(lit, 2);
    const double halfWidth = 30.0 * std::tan(osg::DegreesToRadians(8.5));
    int outlines = 0, inward = 0;
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x) {
            if (p.rgba[size_t(4 * (y * size + x) + 3)] < 0.5f) continue;
            const osg::Vec2d place((2.0 * x + 1.0 - size) / size * halfWidth, (2.0 * y + 1.0 - size) / size * halfWidth);
            const osg::Vec2d outward(place[0] - 1.1 * (std::floor(place[0] / 1.1) + 0.5),
                                     place[1] - 1.1 * (std::floor(place[1] / 1.1) + 0.5));
            if (outward.length() < 0.4) continue;
            const osg::Vec3d n = p.color(x, y) * 2.0 - osg::Vec3d(1, 1, 1);
            ++outlines;
            if (osg::Vec2d(n[0], n[2]) * outward < 0.0) ++inward;
        }
    EXPECT_GT(outlines, 1000);
    EXPECT_EQ(0, inward);

    const osg::ref_ptr<LitScene> sheet = whiteFurnace();
    sheet->getSettings()->view = Settings::NORMAL;
    sheet->addChild(screen());
    for (const double degrees : {5.0, 60.0, 88.0}) {
        const double a = osg::DegreesToRadians(degrees);
        renderer.lookAt(osg::Vec3d(4 * std::sin(a), 4 * std::cos(a), 0), osg::Vec3d());
        EXPECT_NEAR(1.0, centre(renderer, sheet)[1], 0.01) << degrees;
    }
}

}  // namespace Surfaces_test

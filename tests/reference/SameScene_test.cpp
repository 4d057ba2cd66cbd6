// SPDX-License-Identifier: MIT
// The reference's albedo, normals, depth and emission are the rasteriser's: both mean the same scene.
#include <osgEnvLight/Material>

#include <metrics/Mask>

#include <osg/AlphaFunc>
#include <osg/AutoTransform>
#include <osg/Billboard>
#include <osg/CullFace>
#include <osg/FrontFace>
#include <osg/Geometry>
#include <osg/LOD>
#include <osg/Material>
#include <osg/MatrixTransform>
#include <osg/PagedLOD>
#include <osg/Switch>
#include <osg/TexEnv>
#include <osg/TexMat>
#include <osg/Texture2D>
#include <osgDB/WriteFile>

#include <gtest/gtest.h>

#include "Process.h"
#include "Traced.h"

namespace SameScene_test
{

using osgEnvLight::LitScene;
using osgEnvLight::Mask;
using osgEnvLight::Material;
using osgEnvLight::Settings;

namespace
{

const int size = 64;

// A quad facing a camera at (0,-4,0), with a little slant, texture coordinates 0..3 and a colour at each corner.
osg::ref_ptr<osg::Geode> card(double x = 0.0, double half = 0.9)
{
    osg::ref_ptr<osg::Geode> quad =
        makeQuad(osg::Vec3d(x - half, -0.2, -half), osg::Vec3d(2 * half, 0.3, 0), osg::Vec3d(0, 0.2, 2 * half));
    osg::Geometry& g = *quad->getDrawable(0)->asGeometry();
    const osg::ref_ptr<osg::Vec2Array> st = new osg::Vec2Array;
    for (const auto& [s, t] : {std::pair(-0.7f, -0.4f), {2.3f, -0.4f}, {2.3f, 1.6f}, {-0.7f, 1.6f}})
        st->push_back(osg::Vec2(s, t));
    g.setTexCoordArray(0, st);
    return quad;
}

osg::Geometry& geometryOf(osg::Geode& geode)
{
    return *geode.getDrawable(0)->asGeometry();
}

osg::ref_ptr<osg::Geode> coloured(const osg::ref_ptr<osg::Geode>& geode)
{
    const osg::ref_ptr<osg::Vec4Array> colours = new osg::Vec4Array;
    const unsigned n = geometryOf(*geode).getVertexArray()->getNumElements();
    for (unsigned i = 0; i < n; ++i)
        colours->push_back(osg::Vec4(0.2f + 0.2f * float(i % 4), 0.9f - 0.1f * float(i % 3), 0.5f, 1.0f));
    geometryOf(*geode).setColorArray(colours, osg::Array::BIND_PER_VERTEX);
    return geode;
}

osg::ref_ptr<osg::Material> hostMaterial(osg::Material::ColorMode mode)
{
    const osg::ref_ptr<osg::Material> m = new osg::Material;
    m->setDiffuse(osg::Material::FRONT_AND_BACK, osg::Vec4(0.3f, 0.5f, 0.7f, 1));
    m->setEmission(osg::Material::FRONT_AND_BACK, osg::Vec4(0.1f, 0.2f, 1.5f, 1));  // above 1: linear
    m->setColorMode(mode);
    return m;
}

osg::ref_ptr<osg::Texture2D> smoothTexture()
{
    const osg::ref_ptr<osg::Image> image = new osg::Image;
    image->allocateImage(8, 8, 1, GL_RGBA, GL_UNSIGNED_BYTE);
    for (unsigned i = 0; i < 64; ++i) {
        const float x = float(i % 8) / 7.0f, y = float(i / 8) / 7.0f;
        image->setColor(osg::Vec4(0.3f + 0.4f * x, 0.6f - 0.3f * y, 0.5f + 0.2f * x * y, x), i % 8, i / 8);
    }
    osg::ref_ptr<osg::Texture2D> t = new osg::Texture2D(image);
    t->setResizeNonPowerOfTwoHint(false);
    t->setFilter(osg::Texture::MIN_FILTER, osg::Texture::LINEAR);
    t->setFilter(osg::Texture::MAG_FILTER, osg::Texture::LINEAR);
    t->setWrap(osg::Texture::WRAP_S, osg::Texture::REPEAT);
    t->setWrap(osg::Texture::WRAP_T, osg::Texture::REPEAT);
    return t;
}

osg::ref_ptr<osg::Geode> textured(osg::Texture2D* texture)
{
    osg::ref_ptr<osg::Geode> geode = card();
    geode->getOrCreateStateSet()->setTextureAttributeAndModes(0, texture);
    return geode;
}

osg::ref_ptr<osg::MatrixTransform> moved(osg::Node* node, const osg::Matrixd& matrix)
{
    osg::ref_ptr<osg::MatrixTransform> transform = new osg::MatrixTransform(matrix);
    transform->addChild(node);
    return transform;
}

}  // namespace

class SameScene : public testing::Test
{
  protected:
    SceneRenderer renderer{size, size};

    Picture rasterised(LitScene& lit, int view)
    {
        lit.getSettings()->view = view;
        return renderer.render(&lit, 2);
    }

    // Largest differences over the pixels away from edges. Albedo and emission to `colour`, but for the share `outliers` of
    // the pixels; normals are octahedral in two 16-bit numbers, a step of 3e-5 an axis; depth of 24 bits, over a range of
    // far / near below 1e3 here, to 1e3 2^-24 of itself.
    void expectSame(osg::Node* node, const std::string& what, double colour = 1.5 / 65535.0, double outliers = 0.0)
    {
        SCOPED_TRACE(what);
        const osg::ref_ptr<LitScene> lit = makeLit(constantMap(1.0));
        lit->getSettings()->emissiveMeshes = false;  // a lamp's view of emission has what it adds as a light
        lit->addChild(node);
        osg::Camera& camera = *renderer.viewer().getCamera();
        const osg::ref_ptr<osg::FrameStamp> frame = new osg::FrameStamp;
        const osgEnvLight::TriangleScene triangles = osgEnvLight::flattenScene(*lit, camera, frame);
        EXPECT_TRUE(triangles.leftOut.empty()) << triangles.leftOut.front();
        const osgEnvLight::RayScene rays(triangles);
        const osgEnvLight::RayCamera rayCamera(camera.getViewMatrix(), camera.getProjectionMatrix(), size, size, 100.0);
        const FunctionEnvironment night([](const glm::dvec3&) { return 0.0; });
        const ReferenceResult result = osgEnvLight::Reference(rays, rayCamera, night)
                                           .render(makeOptions(ReferenceOptions::COSINE, 1, 1),
                                                   {Layer::ALBEDO, Layer::NORMAL, Layer::DEPTH, Layer::EMISSION});
        Picture normal = result.mean(Layer::NORMAL);
        const Picture depth = result.mean(Layer::DEPTH);
        const Mask inside = osgEnvLight::withoutEdges(Mask::everything(normal), normal, depth);
        const Mask mask = inside & Mask::geometry(normal);
        EXPECT_GT(mask.pixels(), size_t(size * size / 25));

        const Picture drawn = rasterised(*lit, Settings::ALBEDO);
        for (int y = 0; y < size; ++y)
            for (int x = 0; x < size; ++x)
                if (inside.at(x, y)) {
                    ASSERT_EQ(drawn.alpha(x, y) > 0.5f, normal.alpha(x, y) > 0.5f) << "at " << x << " " << y;
                }
        expectLayer(drawn, result.mean(Layer::ALBEDO), mask, colour, outliers, "albedo");
        expectLayer(rasterised(*lit, Settings::EMISSION), result.mean(Layer::EMISSION), mask, std::max(colour, 1e-3), outliers,
                    "emission");  // half floats
        for (float& v : normal.rgba) v = 0.5f * v + 0.5f;
        expectLayer(rasterised(*lit, Settings::NORMAL), normal, mask, 6e-5, 0.0, "normal");
        Picture scaled = depth;
        for (float& v : scaled.rgba) v /= float(4.0 * double(lit->getBound().radius()));
        expectLayer(rasterised(*lit, Settings::DEPTH), scaled, mask, 1e-4, 0.0, "depth");
    }

    void expectLayer(const Picture& drawn, const Picture& traced, const Mask& mask, double tolerance, double outliers,
                     const char* layer)
    {
        double worst = 0.0;
        size_t beyond = 0;
        for (int y = 0; y < size; ++y)
            for (int x = 0; x < size; ++x) {
                if (!mask.at(x, y)) continue;
                double d = 0.0;
                for (int k = 0; k < 3; ++k) d = std::max(d, std::abs(drawn.color(x, y)[k] - traced.color(x, y)[k]));
                beyond += d > tolerance;
                worst = std::max(worst, d);
            }
        EXPECT_LE(double(beyond), outliers * double(mask.pixels())) << layer << ": worst " << worst;
    }
};

TEST_F(SameScene, HostMaterialsInAllColourModes)
{
    for (auto mode : {osg::Material::OFF, osg::Material::DIFFUSE, osg::Material::AMBIENT_AND_DIFFUSE, osg::Material::AMBIENT,
                      osg::Material::SPECULAR}) {
        const osg::ref_ptr<osg::Geode> with = coloured(card()), without = card();
        for (const auto& geode : {with, without}) geode->getOrCreateStateSet()->setAttributeAndModes(hostMaterial(mode));
        expectSame(with, "colour mode " + std::to_string(mode));
        expectSame(without, "no colours, mode " + std::to_string(mode));
    }
    const osg::ref_ptr<osg::Geode> shiny = card();
    const osg::ref_ptr<osg::Material> m = hostMaterial(osg::Material::OFF);
    m->setSpecular(osg::Material::FRONT_AND_BACK, osg::Vec4(0.8f, 0.7f, 0.6f, 1));
    m->setShininess(osg::Material::FRONT_AND_BACK, 30.0f);
    shiny->getOrCreateStateSet()->setAttributeAndModes(m);
    expectSame(shiny, "specular, scaled");
    expectSame(coloured(card()), "colours without a material");
    expectSame(card(), "nothing at all");
}

TEST_F(SameScene, Bindings)
{
    for (auto binding : {osg::Array::BIND_OVERALL, osg::Array::BIND_PER_PRIMITIVE_SET}) {
        osg::ref_ptr<osg::Geode> geode = card();
        osg::Geometry& g = geometryOf(*geode);
        g.removePrimitiveSet(0, g.getNumPrimitiveSets());
        g.addPrimitiveSet(new osg::DrawArrays(GL_TRIANGLE_STRIP, 0, 3));
        const osg::ref_ptr<osg::DrawElementsUShort> second = new osg::DrawElementsUShort(GL_TRIANGLES);
        for (GLushort i : {GLushort(0), GLushort(2), GLushort(3)}) second->push_back(i);
        g.addPrimitiveSet(second);
        const osg::ref_ptr<osg::Vec4ubArray> colours = new osg::Vec4ubArray;
        colours->push_back(osg::Vec4ub(200, 100, 50, 255));
        colours->push_back(osg::Vec4ub(20, 100, 150, 255));
        colours->setNormalize(true);
        g.setColorArray(colours, binding);
        expectSame(geode, "binding " + std::to_string(binding));
    }
}

TEST_F(SameScene, NormalsOrNone)
{
    osg::ref_ptr<osg::Geode> sphere = makeSphere(osg::Vec3d(), 1.0, 16);
    expectSame(sphere, "smooth");
    geometryOf(*sphere).setNormalArray(nullptr);
    expectSame(sphere, "faceted");
    // Facing away, and of any length.
    osg::ref_ptr<osg::Geode> reversed = makeSphere(osg::Vec3d(), 1.0, 64);
    for (osg::Vec3& n : static_cast<osg::Vec3Array&>(*geometryOf(*reversed).getNormalArray())) n *= -7.0f;
    expectSame(reversed, "reversed");
}

TEST_F(SameScene, Transforms)
{
    const osg::ref_ptr<osg::Geode> sphere = makeSphere(osg::Vec3d(), 0.7, 64);
    const osg::Matrixd turn = osg::Matrixd::rotate(0.6, osg::Vec3d(1, 2, 3));
    expectSame(moved(sphere, osg::Matrixd::scale(1.0, 0.5, 1.4) * turn), "stretched");
    expectSame(moved(sphere, osg::Matrixd::scale(-1.0, 0.5, 1.4) * turn), "mirrored");
    expectSame(moved(sphere, osg::Matrixd::scale(-1.0, -0.7, -1.2) * turn * osg::Matrixd::translate(0.1, 0.2, 0.3)), "inverted");
    osg::Matrixd shear;
    shear(1, 0) = 0.5;
    expectSame(moved(moved(sphere, shear), turn), "sheared");
}

TEST_F(SameScene, Faces)
{
    for (auto face : {osg::CullFace::BACK, osg::CullFace::FRONT})
        for (auto winding : {osg::FrontFace::COUNTER_CLOCKWISE, osg::FrontFace::CLOCKWISE})
            for (double mirror : {1.0, -1.0}) {
                // A card, and a sphere whose far side shows through.
                const osg::ref_ptr<osg::Group> group = together({card(0.0, 0.9), makeSphere(osg::Vec3d(0, -0.8, 0), 0.6, 48)});
                group->getOrCreateStateSet()->setAttributeAndModes(new osg::CullFace(face));
                group->getOrCreateStateSet()->setAttribute(new osg::FrontFace(winding));
                expectSame(
                    moved(group, osg::Matrixd::scale(mirror, 1, 1)),
                    "culls " + std::to_string(face) + ", front " + std::to_string(winding) + ", " + std::to_string(mirror));
            }
}

// Filtered with weights of 8 bits along two axes, between texels up to .4 apart before decoding, whose slope is below 2.
const double filtering = 2.0 * 0.8 / 256.0;

TEST_F(SameScene, TextureWrapAndFilter)
{
    for (auto wrap : {osg::Texture::REPEAT, osg::Texture::MIRROR, osg::Texture::CLAMP_TO_EDGE, osg::Texture::CLAMP_TO_BORDER}) {
        const osg::ref_ptr<osg::Texture2D> texture = smoothTexture();
        texture->setWrap(osg::Texture::WRAP_S, wrap);
        texture->setWrap(osg::Texture::WRAP_T, wrap);
        texture->setBorderColor(osg::Vec4d(0.4, 0.5, 0.6, 1.0));
        expectSame(textured(texture), "wrap " + std::to_string(wrap), filtering);
    }
    const osg::ref_ptr<osg::Texture2D> nearest = smoothTexture();
    nearest->setFilter(osg::Texture::MIN_FILTER, osg::Texture::NEAREST);
    nearest->setFilter(osg::Texture::MAG_FILTER, osg::Texture::NEAREST);
    // Pixel centres on the line between two texels may take either.
    expectSame(textured(nearest), "nearest", 1.5 / 65535.0, 0.005);
    // Mipmaps: OpenGL leaves the level of detail to the driver within bounds; between like levels the colours differ little.
    const osg::ref_ptr<osg::Texture2D> mipmapped = smoothTexture();
    mipmapped->setFilter(osg::Texture::MIN_FILTER, osg::Texture::LINEAR_MIPMAP_LINEAR);
    const osg::ref_ptr<osg::TexMat> often = new osg::TexMat(osg::Matrix::scale(10, 7, 1));
    const osg::ref_ptr<osg::Geode> minified = textured(mipmapped);
    minified->getOrCreateStateSet()->setTextureAttribute(0, often);
    expectSame(minified, "mipmapped", 0.03);
}

TEST_F(SameScene, TextureMatrixAndEnvironment)
{
    const osg::ref_ptr<osg::Geode> turned = textured(smoothTexture());
    turned->getOrCreateStateSet()->setTextureAttribute(
        0, new osg::TexMat(osg::Matrix::scale(0.8, 1.3, 1) * osg::Matrix::rotate(0.5, osg::Vec3d(0, 0, 1)) *
                           osg::Matrix::translate(0.3, 0.1, 0)));
    expectSame(turned, "texture matrix", filtering);
    for (auto mode : {osg::TexEnv::MODULATE, osg::TexEnv::REPLACE, osg::TexEnv::DECAL, osg::TexEnv::BLEND, osg::TexEnv::ADD}) {
        const osg::ref_ptr<osg::Geode> geode = textured(smoothTexture());
        osg::StateSet& s = *geode->getOrCreateStateSet();
        const osg::ref_ptr<osg::TexEnv> environment = new osg::TexEnv(mode);
        environment->setColor(osg::Vec4(0.9f, 0.3f, 0.1f, 1));
        s.setTextureAttribute(0, environment);
        s.setAttributeAndModes(hostMaterial(osg::Material::OFF));
        expectSame(geode, "environment " + std::to_string(mode), filtering);
    }
    const osg::ref_ptr<osg::Geode> tested = textured(smoothTexture());
    tested->getOrCreateStateSet()->setAttributeAndModes(new osg::AlphaFunc(osg::AlphaFunc::GREATER, 0.5f));
    expectSame(tested, "alpha test", filtering);
    const osg::ref_ptr<osg::Geode> unlit = coloured(textured(smoothTexture()));
    unlit->getOrCreateStateSet()->setMode(GL_LIGHTING, osg::StateAttribute::OFF);
    expectSame(unlit, "unlit", filtering);
}

TEST_F(SameScene, OurMaterials)
{
    const osg::ref_ptr<osg::Geode> a = makeSphere(osg::Vec3d(-0.7, 0, 0), 0.6, 48),
                                   b = makeSphere(osg::Vec3d(0.7, 0, 0), 0.6, 48), c = makeSphere(osg::Vec3d(0, 0, 0.8), 0.5, 48);
    Material::setLambert(*a->getOrCreateStateSet(), osg::Vec3f(0.2f, 0.4f, 0.6f));
    Material::setPhong(*b->getOrCreateStateSet(), osg::Vec3f(0.3f, 0.4f, 0.1f), osg::Vec3f(0.3f, 0.2f, 0.1f), 50.0f);
    Material::setCookTorrance(*c->getOrCreateStateSet(), osg::Vec3f(0.7f, 0.5f, 0.2f), 0.4f, 0.3f);
    expectSame(together({a, b, c}), "three models");
    Material::setStrauss(*a->getOrCreateStateSet(), osg::Vec3f(0.2f, 0.4f, 0.6f), 0.6f, 0.3f);
    Material::setBlinnPhong(*b->getOrCreateStateSet(), osg::Vec3f(0.3f, 0.4f, 0.1f), osg::Vec3f(0.3f, 0.2f, 0.1f), 50.0f);
    Material::setCookTorrance(*c->getOrCreateStateSet(), osg::Vec3f(0.7f, 0.5f, 0.2f), 0.4f, 0.3f, Material::BECKMANN_NORMALS);
    expectSame(together({a, b, c}), "three more");
    osg::ref_ptr<osg::Vec4Array> colors = new osg::Vec4Array(osg::Array::BIND_OVERALL, 1);
    (*colors)[0] = osg::Vec4(0.8f, 0.5f, 0.2f, 1.0f);
    c->getDrawable(0)->asGeometry()->setColorArray(colors);
    Material::setVertexColors(*c->getStateSet());
    expectSame(together({a, b, c}), "colours of vertices");
}

TEST_F(SameScene, NodesThatDependOnTheView)
{
    const osg::ref_ptr<osg::LOD> lod = new osg::LOD;
    lod->addChild(makeSphere(osg::Vec3d(), 1.0, 32), 0.0f, 3.9f);
    lod->addChild(card(), 3.9f, 4.5f);
    lod->addChild(makeBox(osg::Vec3d(-0.5, -0.5, -0.5), osg::Vec3d(0.5, 0.5, 0.5)), 4.5f, 1e6f);
    lod->setCenterMode(osg::LOD::USER_DEFINED_CENTER);
    lod->setCenter(osg::Vec3());
    for (double distance : {3.5, 4.2, 6.0}) {
        renderer.lookAt(osg::Vec3d(0.3, -distance, 0.1), osg::Vec3d());
        expectSame(lod, "LOD from " + std::to_string(distance));
    }
    renderer.lookAt(osg::Vec3d(0.5, -4, 0.7), osg::Vec3d());
    const osg::ref_ptr<osg::Switch> choice = new osg::Switch;
    choice->addChild(makeSphere(osg::Vec3d(), 1.0, 32), false);
    choice->addChild(card(), true);
    expectSame(choice, "switch");

    const osg::ref_ptr<osg::Billboard> billboard = new osg::Billboard;
    billboard->setMode(osg::Billboard::POINT_ROT_EYE);
    billboard->setNormal(osg::Vec3(0, -1, 0));
    billboard->addDrawable(&geometryOf(*card()), osg::Vec3(0.2f, 0.1f, 0.0f));
    expectSame(billboard, "billboard");

    const osg::ref_ptr<osg::AutoTransform> automatic = new osg::AutoTransform;
    automatic->setAutoRotateMode(osg::AutoTransform::ROTATE_TO_CAMERA);
    automatic->addChild(makeQuad(osg::Vec3d(-0.8, -0.8, 0), osg::Vec3d(1.6, 0, 0), osg::Vec3d(0, 1.6, 0)));
    expectSame(automatic, "auto transform");
}

TEST_F(SameScene, PagedFilesAreLoaded)
{
    const TemporaryFolder folder;
    const std::string file = folder.file("page.osgt");
    ASSERT_TRUE(osgDB::writeNodeFile(*makeSphere(osg::Vec3d(0.2, 0, 0), 0.9, 32), file));
    const osg::ref_ptr<osg::PagedLOD> paged = new osg::PagedLOD;
    paged->addChild(card(), 50.0f, 1e6f);
    paged->setFileName(1, file);
    paged->setRange(1, 0.0f, 50.0f);
    paged->setCenterMode(osg::LOD::USER_DEFINED_CENTER);
    paged->setCenter(osg::Vec3());
    paged->setRadius(1.0f);
    expectSame(paged, "page");
    EXPECT_EQ(2u, paged->getNumChildren());
}

TEST_F(SameScene, ShadowCatchersAreLeftOutAndNamed)
{
    const osg::ref_ptr<LitScene> lit = makeLit(constantMap(1.0));
    lit->addChild(makeSphere(osg::Vec3d(), 0.5, 16));
    lit->addChild(card());
    Material::setShadowCatcher(*lit->getChild(1)->getOrCreateStateSet());
    const osgEnvLight::TriangleScene triangles =
        osgEnvLight::flattenScene(*lit, *renderer.viewer().getCamera(), new osg::FrameStamp);
    EXPECT_EQ(1u, triangles.meshes.size());
    EXPECT_EQ(std::vector<std::string>{"shadow catchers (1 drawable)"}, triangles.leftOut);
}

TEST_F(SameScene, Projections)
{
    const osg::ref_ptr<osg::Group> scene = together({card(), makeSphere(osg::Vec3d(0.3, -0.8, 0.1), 0.5, 48)});
    osg::Camera& camera = *renderer.viewer().getCamera();
    camera.setViewMatrixAsLookAt(osg::Vec3d(1, -4, 1), osg::Vec3d(), osg::Vec3d(0.2, 0, 1));
    camera.setProjectionMatrixAsOrtho(-1.5, 1.2, -1.1, 1.4, 1.0, 100.0);
    expectSame(scene, "orthographic");
    camera.setProjectionMatrixAsFrustum(-0.2, 0.5, -0.3, 0.3, 1.0, 100.0);
    expectSame(scene, "off-axis");
    camera.setProjectionMatrix(osg::Matrixd::perspective(40, 1, 1, 100) * osg::Matrixd::scale(-1, 1, 1));
    expectSame(scene, "mirrored projection");
}

}  // namespace SameScene_test

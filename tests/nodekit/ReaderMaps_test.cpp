// SPDX-License-Identifier: MIT
// Maps that a reader leaves in texture units without coordinates, as OpenSceneGraph's reader of OBJ does; fixed function
// multiplies the colour by some one of their texels.
#include <osgDB/FileUtils>
#include <osgDB/ReadFile>
#include <osgDB/WriteFile>

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "FeatureCards.h"
#include "surface/CasterState.h"

namespace ReaderMaps_test
{

using namespace feature_cards;
using osgEnvLight::SurfaceFacts;
using osgEnvLight::TexelKind;

namespace
{

// Normals: by 30 degrees to the right, as much to the left, upright.
const osg::Vec4ub right(191, 128, 238, 255), left(64, 128, 238, 255), upright(128, 128, 255, 255);
const osg::Vec4ub black(0, 0, 0, 255), white(255, 255, 255, 255);
const int evenColumn = 20, oddColumn = 12;  // of striped(), in pixels of the picture

osg::ref_ptr<osg::Image> striped(const osg::Vec4ub& even, const osg::Vec4ub& odd)
{
    osg::ref_ptr<osg::Image> image = new osg::Image;
    image->allocateImage(8, 8, 1, GL_RGBA, GL_UNSIGNED_BYTE);
    for (unsigned y = 0; y < 8; ++y)
        for (unsigned x = 0; x < 8; ++x) *reinterpret_cast<osg::Vec4ub*>(image->data(x, y)) = x % 2 ? odd : even;
    return image;
}

TexelKind kindOf(osg::Image* image)
{
    return SurfaceFacts::measure(*texture(image)).texels;
}

void addMap(osg::Node& model, unsigned unit, osg::Image* image)
{
    model.getOrCreateStateSet()->setTextureAttributeAndModes(unit, texture(image).get());
}

// With coordinates for the first unit alone.
osg::ref_ptr<osg::Geode> loaded()
{
    osg::ref_ptr<osg::Geode> model = card();
    model->getDrawable(0)->asGeometry()->setTexCoordArray(1, nullptr);
    addMap(*model, 0, twoHalves(red, red));
    return model;
}

double leanOf(const osg::ref_ptr<osg::Node>& model, SceneRenderer& renderer, int x)
{
    const osg::ref_ptr<LitScene> scene = furnace(model);
    scene->getSettings()->view = Settings::NORMAL;
    return renderer.render(scene, 2).color(x, size / 2)[0] * 2.0 - 1.0;
}

}  // namespace

using ReaderMaps = Features;

TEST_F(ReaderMaps, TexelsSayWhatAnImageIs)
{
    EXPECT_EQ(kindOf(striped(right, left)), TexelKind::NORMALS);
    EXPECT_EQ(kindOf(striped(right, right)), TexelKind::COLORS) << "all lean";
    EXPECT_EQ(kindOf(striped(upright, upright)), TexelKind::NORMALS_PERHAPS) << "as likely a colour";
    EXPECT_EQ(kindOf(striped(osg::Vec4ub(120, 130, 245, 255), osg::Vec4ub(115, 125, 230, 255))), TexelKind::NORMALS_PERHAPS)
        << "lavender";
    EXPECT_EQ(kindOf(striped(osg::Vec4ub(135, 180, 240, 255), osg::Vec4ub(128, 170, 230, 255))), TexelKind::COLORS) << "a sky";
    EXPECT_EQ(kindOf(striped(osg::Vec4ub(40, 60, 200, 255), osg::Vec4ub(230, 200, 250, 255))), TexelKind::COLORS);
    EXPECT_EQ(kindOf(striped(black, white)), TexelKind::MASK);
    EXPECT_EQ(kindOf(striped(white, white)), TexelKind::COLORS);
    EXPECT_EQ(kindOf(striped(grey, white)), TexelKind::COLORS) << "gloss";
    EXPECT_EQ(kindOf(striped(red, white)), TexelKind::COLORS);
}

TEST_F(ReaderMaps, ANormalMapBendsNormalsInWhateverUnit)
{
    for (const unsigned unit : {1u, 3u, 6u}) {
        const osg::ref_ptr<osg::Geode> model = loaded();
        // As a map of ambient light.
        addMap(*model, 1, model->getStateSet()->getTextureAttribute(0, osg::StateAttribute::TEXTURE)->asTexture()->getImage(0));
        addMap(*model, unit, striped(right, left));
        NotifyCatcher notify;
        const osg::Vec3d c = lit(model);
        EXPECT_EQ(notify.text(), "") << "no new image is left out";
        EXPECT_NEAR(c[0], 1.0, small) << "no tint, unit " << unit;
        EXPECT_NEAR(c[1], 0.0, small);
        EXPECT_NEAR(leanOf(model, renderer, evenColumn), 0.5, 0.01) << "unit " << unit;
        EXPECT_NEAR(leanOf(model, renderer, oddColumn), -0.5, 0.01) << "unit " << unit;
    }
}

TEST_F(ReaderMaps, ANormalMapAloneIsNoPicture)
{
    const osg::ref_ptr<osg::Geode> model = card(3.0, osg::Vec4(0, 1, 0, 1));
    addMap(*model, 0, striped(right, left));
    const osg::Vec3d c = lit(model);
    EXPECT_NEAR(c[0], 0.0, small);
    EXPECT_NEAR(c[1], 1.0, small);
    EXPECT_NEAR(leanOf(model, renderer, evenColumn), 0.5, 0.01);
    model->getOrCreateStateSet()->setMode(GL_LIGHTING, osg::StateAttribute::OFF);
    EXPECT_NEAR(lit(model, 2)[0], 0.0, small) << "shown unlit, it is a picture, over green";
    EXPECT_NEAR(lit(model, 2)[1], decoded(0.5), small);
}

TEST_F(ReaderMaps, OtherMapsAreLeftOutAndNamedOnce)
{
    const osg::ref_ptr<osg::Geode> model = loaded();
    addMap(*model, 1, striped(grey, osg::Vec4ub(90, 90, 90, 255)));
    NotifyCatcher notify;
    EXPECT_NEAR(lit(model)[0], 1.0, small);
    const std::string said = "without texture coordinates";
    const size_t first = notify.text().find(said);
    EXPECT_NE(first, std::string::npos) << notify.text();
    EXPECT_EQ(notify.text().find(said, first + 1), std::string::npos) << notify.text();
    model->getDrawable(0)->asGeometry()->setTexCoordArray(1, model->getDrawable(0)->asGeometry()->getTexCoordArray(0));
    EXPECT_NEAR(lit(model, 2)[0], decoded(128.0 / 255.0), 0.01) << "with coordinates it is a detail map";
}

// The card before another one is closed at the right.
TEST_F(ReaderMaps, AMaskMakesHolesThatCastNoShadow)
{
    for (const bool open : {false, true}) {
        const osg::ref_ptr<osg::Geode> masked = loaded();
        addMap(*masked, 1, twoHalves(open ? black : white, open ? black : white));
        if (open) addMap(*masked, 1, twoHalves(black, white));
        const osg::ref_ptr<LitScene> scene = furnace(masked);
        scene->getSettings()->background = Settings::BACKGROUND_ON;
        const Picture alone = renderer.render(scene, 2);
        EXPECT_NEAR(alone.color(4, size / 2)[1], open ? 1.0 : 0.0, small) << "the white map through the hole";
        EXPECT_NEAR(alone.color(size - 5, size / 2)[1], 0.0, small);

        const osg::ref_ptr<osg::Geode> behind = card(3.0, osg::Vec4(0, 1, 0, 1));
        osg::ref_ptr<osg::MatrixTransform> farther = new osg::MatrixTransform(osg::Matrix::translate(0, 0.5, 0));
        farther->addChild(behind);
        const osg::ref_ptr<LitScene> both = furnace(masked);
        both->addChild(farther);
        both->getSettings()->occlusion = true;
        both->getSettings()->bounce = Settings::BOUNCE_OFF;
        const Picture picture = renderer.render(both, 20);
        if (open) {
            EXPECT_GT(picture.color(6, size / 2)[1], 0.5) << "the card behind, lit through the hole";
        }
        EXPECT_NEAR(picture.color(size - 5, size / 2)[1], 0.0, small);
    }
}

TEST_F(ReaderMaps, AMaskLetsItsShareOfLightPass)
{
    const osg::ref_ptr<osg::Geode> model = loaded();
    const osg::Geometry& geometry = *model->getDrawable(0)->asGeometry();
    const auto stateOf = [&] {
        osgEnvLight::CasterState state;
        state.merge(*model->getStateSet());
        return state;
    };
    addMap(*model, 1, striped(grey, white));
    EXPECT_FALSE(stateOf().perforated(geometry));
    addMap(*model, 1, twoHalves(black, white));
    EXPECT_TRUE(stateOf().perforated(geometry));
    EXPECT_NEAR(stateOf().opacity(geometry), 0.5, 1e-6);
}

// As a 3D artist's tool writes it: the image of the colour once more as that of ambient light, opacity and relief.
TEST_F(ReaderMaps, AnObjFileWithAllItsMaps)
{
    const std::filesystem::path folder = std::filesystem::temp_directory_path() / "envlight-reader-maps";
    std::filesystem::create_directories(folder);
    ASSERT_TRUE(osgDB::writeImageFile(*twoHalves(red, red), (folder / "color.png").string()));
    ASSERT_TRUE(osgDB::writeImageFile(*twoHalves(black, white), (folder / "mask.png").string()));
    ASSERT_TRUE(osgDB::writeImageFile(*striped(right, left), (folder / "relief.png").string()));
    std::ofstream(folder / "card.mtl") << "newmtl paper\nKd 1 1 1\nmap_Ka color.png\nmap_Kd color.png\nmap_d mask.png\n"
                                       << "map_bump relief.png\nmap_Ks color.png\n";
    std::ofstream(folder / "card.obj")
        << "mtllib card.mtl\nv -3 -3 0\nv 3 -3 0\nv 3 3 0\nv -3 3 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
        << "vn 0 0 1\nusemtl paper\nf 1/1/1 2/2/1 3/3/1 4/4/1\n";
    const osg::ref_ptr<osg::Node> model = osgDB::readRefNodeFile((folder / "card.obj").string());
    std::filesystem::remove_all(folder);
    ASSERT_TRUE(model);
    const osg::ref_ptr<LitScene> scene = furnace(model);
    scene->getSettings()->background = Settings::BACKGROUND_ON;
    const Picture picture = renderer.render(scene, 2);
    EXPECT_NEAR(picture.color(4, size / 2)[1], 1.0, small) << "the white map through the hole";
    EXPECT_NEAR(picture.color(size - 5, size / 2)[0], 1.0, small) << "red, without a tint";
    EXPECT_NEAR(picture.color(size - 5, size / 2)[1], 0.0, small);
    EXPECT_NEAR(leanOf(model, renderer, evenColumn), 0.5, 0.05) << "relief";
}

}  // namespace ReaderMaps_test

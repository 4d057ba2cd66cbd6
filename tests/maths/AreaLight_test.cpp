// SPDX-License-Identifier: MIT
// Area lights in a scene graph: what a cull finds of them. Without a context.
#include "surface/AreaLightPlace.h"

#include "surface/MaterialMaps.h"

#include <osg/FrontFace>
#include <osg/MatrixTransform>
#include <osg/PagedLOD>
#include <osg/Switch>
#include <osgUtil/CullVisitor>

#include <gtest/gtest.h>

#include <thread>

namespace AreaLight_test
{

using osgEnvLight::AreaLight;
using osgEnvLight::AreaLightPlace;
using osgEnvLight::Emitter;
using osgEnvLight::MetAreaLight;

namespace
{

// One cull of a graph, seen from above.
class Culled
{
  public:
    explicit Culled(osg::Node& node)
    {
        _visitor->setStateGraph(_root);
        _visitor->setRenderStage(_stage);
        _visitor->setComputeNearFarMode(osg::CullSettings::DO_NOT_COMPUTE_NEAR_FAR);
        _visitor->pushViewport(new osg::Viewport(0, 0, 100, 100));
        _visitor->pushProjectionMatrix(new osg::RefMatrix(osg::Matrixd::perspective(60.0, 1.0, 1.0, 100.0)));
        _visitor->pushModelViewMatrix(new osg::RefMatrix(view), osg::Transform::ABSOLUTE_RF);
        node.accept(*_visitor);
        _visitor->popModelViewMatrix();
        _visitor->popProjectionMatrix();
        _visitor->popViewport();
        collect(*_stage);
    }

    std::vector<Emitter> emitters(std::vector<std::string>* problems = nullptr)
    {
        return osgEnvLight::takeEmitters(*_stage, osg::Matrixd::inverse(view), problems);
    }

    osgUtil::RenderStage& stage() { return *_stage; }
    const std::vector<const osgUtil::RenderLeaf*>& leaves() const { return _leaves; }

    template <class T>
    static T uniform(const osgUtil::RenderLeaf& leaf, const char* name)
    {
        T value{};
        for (const osgUtil::StateGraph* graph = leaf._parent; graph; graph = graph->_parent)
            if (graph->getStateSet() && graph->getStateSet()->getUniform(name)) {
                graph->getStateSet()->getUniform(name)->get(value);
                return value;
            }
        ADD_FAILURE() << name;
        return value;
    }

    static const osg::Matrixd view;

  private:
    void collect(osgUtil::RenderBin& bin)
    {
        for (osgUtil::StateGraph* graph : bin.getStateGraphList())
            for (const auto& leaf : graph->_leaves) _leaves.push_back(leaf);
        for (const auto& [number, child] : bin.getRenderBinList()) collect(*child);
    }

    osg::ref_ptr<osgUtil::CullVisitor> _visitor = new osgUtil::CullVisitor;
    osg::ref_ptr<osgUtil::StateGraph> _root = new osgUtil::StateGraph;
    osg::ref_ptr<osgUtil::RenderStage> _stage = new osgUtil::RenderStage;
    std::vector<const osgUtil::RenderLeaf*> _leaves;
};

const osg::Matrixd Culled::view = osg::Matrixd::lookAt(osg::Vec3d(0, 0, 10), osg::Vec3d(), osg::Vec3d(0, 1, 0));

osg::ref_ptr<osg::MatrixTransform> below(const osg::Matrixd& matrix, osg::Node* node)
{
    osg::ref_ptr<osg::MatrixTransform> transform = new osg::MatrixTransform(matrix);
    transform->addChild(node);
    return transform;
}

osg::Vec3f emissionOf(const osgUtil::RenderLeaf& leaf)
{
    return Culled::uniform<osg::Vec3f>(leaf, osgEnvLight::MaterialMaps::light);
}

}  // namespace

TEST(AreaLight, EveryPathToItIsALight)
{
    const osg::ref_ptr<AreaLight> light = new AreaLight;
    const osg::ref_ptr<osg::Group> root = new osg::Group;
    root->addChild(below(osg::Matrixd::translate(1, 2, 3), light));
    root->addChild(below(osg::Matrixd::scale(2, 2, 2) * osg::Matrixd::translate(0, 0, -4), light));
    Culled culled(*root);
    const std::vector<Emitter> emitters = culled.emitters();
    ASSERT_EQ(2u, emitters.size());
    EXPECT_NEAR(0.0, (osg::Vec3d(1, 2, 3) - emitters[0].center).length(), 1e-12);
    EXPECT_NEAR(0.0, (osg::Vec3d(0, 0, -4) - emitters[1].center).length(), 1e-12);
    EXPECT_NEAR(4.0, emitters[1].area, 1e-12);
    EXPECT_TRUE(culled.emitters().empty());  // they are taken
    EXPECT_EQ(4u, culled.leaves().size());
}

TEST(AreaLight, LightsOutOfTheViewButNotWhereItIsSwitchedOff)
{
    const osg::ref_ptr<AreaLight> light = new AreaLight;
    const osg::ref_ptr<osg::Switch> root = new osg::Switch;
    root->addChild(below(osg::Matrixd::translate(0, 500, 50), light));
    EXPECT_EQ(1u, Culled(*root).emitters().size());
    EXPECT_TRUE(Culled(*root).leaves().empty());
    root->setAllChildrenOff();
    EXPECT_TRUE(Culled(*root).emitters().empty());
    root->setAllChildrenOn();
    light->setNodeMask(0);
    EXPECT_TRUE(Culled(*root).emitters().empty());
}

TEST(AreaLight, IsDrawnWithItsRadianceAndItsBackBlack)
{
    const osg::ref_ptr<AreaLight> light = new AreaLight;
    light->setRadiance(osg::Vec3f(1, 2, 3));
    Culled culled(*light);
    ASSERT_EQ(2u, culled.leaves().size());
    const std::vector<MetAreaLight> met = osgEnvLight::takeAreaLights(culled.stage());
    ASSERT_EQ(1u, met.size());
    osg::Vec3f sum;
    for (const auto* leaf : culled.leaves()) {
        EXPECT_EQ(met[0].place, AreaLightPlace::of(*leaf->getDrawable()));
        EXPECT_EQ(met[0].eyeFromLight, leaf->_modelview);
        EXPECT_EQ(osg::Vec3f(), Culled::uniform<osg::Vec3f>(*leaf, "envlightDiffuse"));
        sum += emissionOf(*leaf);
    }
    EXPECT_EQ(osg::Vec3f(1, 2, 3), sum);
    light->setTwoSided(true);
    EXPECT_EQ(1u, Culled(*light).leaves().size());
    light->setVisible(false);
    EXPECT_EQ(0u, Culled(*light).leaves().size());
    EXPECT_EQ(1u, Culled(*light).emitters().size());
    EXPECT_FALSE(Culled(*light).emitters()[0].drawn);
}

TEST(AreaLight, AFluxIsDrawnAsTheRadianceOfItsAreaInTheWorld)
{
    const osg::ref_ptr<AreaLight> light = new AreaLight;
    light->setSphere(osg::Vec3d(), 0.5);
    light->setFlux(osg::Vec3f(5, 5, 5));
    const osg::ref_ptr<osg::Group> root = new osg::Group;
    for (const double scale : {1.0, 2.0}) root->addChild(below(osg::Matrixd::scale(scale, scale, scale), light));
    Culled culled(*root);
    ASSERT_EQ(2u, culled.leaves().size());
    for (const auto* leaf : culled.leaves()) {
        const double scale = osg::Vec3d(leaf->_modelview->getScale()).x();
        EXPECT_NEAR(5.0 / (osg::PI * osg::PI * scale * scale), double(emissionOf(*leaf).x()), 1e-6);
    }
}

TEST(AreaLight, InAMirrorItsFrontFacesTurnClockwise)
{
    const osg::ref_ptr<AreaLight> light = new AreaLight;
    for (const bool mirrored : {false, true}) {
        const auto root = below(osg::Matrixd::scale(mirrored ? -1 : 1, 1, 1), light);
        Culled culled(*root);
        for (const auto* leaf : culled.leaves()) {
            const osg::StateAttribute* face = nullptr;
            for (const osgUtil::StateGraph* graph = leaf->_parent; graph && !face; graph = graph->_parent)
                if (graph->getStateSet()) face = graph->getStateSet()->getAttribute(osg::StateAttribute::FRONTFACE);
            ASSERT_TRUE(face);
            EXPECT_EQ(mirrored ? osg::FrontFace::CLOCKWISE : osg::FrontFace::COUNTER_CLOCKWISE,
                      static_cast<const osg::FrontFace*>(face)->getMode());
        }
    }
}

TEST(AreaLight, WhatCanNotLightIsNamed)
{
    const osg::ref_ptr<AreaLight> lamp = new AreaLight, black = new AreaLight, bare = new AreaLight;
    lamp->setName("lamp");
    lamp->setSphere(osg::Vec3d(), 0.0);
    black->setRadiance(osg::Vec3f());
    bare->setDisc(osg::Vec3d(), osg::Vec3d(), 1.0);
    const osg::ref_ptr<osg::Group> root = new osg::Group;
    for (const auto& light : {lamp, black, bare}) root->addChild(light);
    Culled culled(*root);
    EXPECT_EQ(2u, culled.leaves().size());  // the black one's
    std::vector<std::string> problems;
    EXPECT_TRUE(culled.emitters(&problems).empty());
    EXPECT_EQ((std::vector<std::string>{"area light 'lamp' has no area", "area light has no area"}), problems);
}

TEST(AreaLight, IsCopiedWithItsShape)
{
    const osg::ref_ptr<AreaLight> light = new AreaLight;
    const osg::ref_ptr<osg::Vec3Array> vertices = new osg::Vec3Array;
    for (const auto& p : {osg::Vec3(0, 0, 0), osg::Vec3(2, 0, 0), osg::Vec3(0, 3, 0)}) vertices->push_back(p);
    light->setPolygon(*vertices);
    light->setFlux(osg::Vec3f(1, 2, 3));
    light->setTwoSided(true);
    const osg::ref_ptr<AreaLight> copy = osg::clone(light.get(), osg::CopyOp::DEEP_COPY_ALL);
    light->setRectangle(osg::Vec3d(), osg::Vec3d(1, 0, 0), osg::Vec3d(0, 1, 0));
    const std::vector<Emitter> emitters = Culled(*copy).emitters();
    ASSERT_EQ(1u, emitters.size());
    EXPECT_EQ(AreaLight::POLYGON, emitters[0].shape);
    EXPECT_NEAR(3.0, emitters[0].area, 1e-6);
    EXPECT_NEAR(2.0, emitters[0].flux(), 1e-6);
    EXPECT_TRUE(emitters[0].twoSided);
}

TEST(AreaLight, ViewsMayCullItAtTheSameTime)
{
    const osg::ref_ptr<AreaLight> light = new AreaLight;
    light->setFlux(osg::Vec3f(1, 1, 1));
    const auto root = below(osg::Matrixd::scale(2, 2, 2), light);
    root->getBound();
    std::vector<std::thread> threads;
    for (int i = 0; i < 4; ++i)
        threads.emplace_back([&] {
            for (int k = 0; k < 50; ++k) EXPECT_EQ(2u, Culled(*root).leaves().size());
        });
    for (std::thread& t : threads) t.join();
}

}  // namespace AreaLight_test

// SPDX-License-Identifier: MIT
// Undo and redo of settings, of the map, its rotation and its intensity.
#include <SettingsHistory.h>

#include <gtest/gtest.h>

using osgEnvLight::EnvironmentMap;
using osgEnvLight::LitScene;

namespace
{

class History : public testing::Test
{
  protected:
    void setExposure(float stops)
    {
        _lit->getSettings()->exposure = stops;
        _history.record();
    }
    float exposure() const { return _lit->getSettings()->exposure; }

    const osg::ref_ptr<LitScene> _lit = new LitScene;
    SettingsHistory _history{*_lit};
};

}  // namespace

TEST_F(History, GoesBackAndForthStepByStep)
{
    EXPECT_FALSE(_history.undo());
    setExposure(1);
    setExposure(2);
    EXPECT_TRUE(_history.undo());
    EXPECT_EQ(1, exposure());
    EXPECT_TRUE(_history.undo());
    EXPECT_EQ(0, exposure());
    EXPECT_FALSE(_history.undo());
    EXPECT_EQ(0, exposure());
    EXPECT_TRUE(_history.redo());
    EXPECT_TRUE(_history.redo());
    EXPECT_EQ(2, exposure());
    EXPECT_FALSE(_history.redo());
}

TEST_F(History, AChangeAfterAnUndoTakesThePlaceOfWhatWasUndone)
{
    setExposure(1);
    setExposure(2);
    _history.undo();
    setExposure(3);
    EXPECT_FALSE(_history.canRedo());
    _history.undo();
    EXPECT_EQ(1, exposure());
}

TEST_F(History, WhatDidNotChangeIsNoStep)
{
    _history.record();
    _history.record();
    EXPECT_FALSE(_history.canUndo());
    setExposure(1);
    _history.undo();
    _history.record();
    EXPECT_TRUE(_history.canRedo());
}

TEST_F(History, AllThatAPresetChangesIsOneStep)
{
    std::string error;
    ASSERT_TRUE(_lit->getSettings()->setPreset("high", error));
    _history.record();
    ASSERT_TRUE(_history.undo());
    const osg::ref_ptr<osgEnvLight::Settings> usual = new osgEnvLight::Settings;
    for (const auto& p : osgEnvLight::Settings::table()) EXPECT_EQ(p.get(*usual), p.get(*_lit->getSettings())) << p.name;
    EXPECT_FALSE(_history.canUndo());
}

TEST_F(History, TheMapItsRotationAndItsIntensityComeBack)
{
    const osg::ref_ptr<EnvironmentMap> first = _lit->getEnvironmentMap();
    first->setRotation(30);
    _history.record();
    first->setIntensity(2);
    _history.record();
    const osg::ref_ptr<EnvironmentMap> second = new EnvironmentMap;
    _lit->setEnvironmentMap(second);
    _history.record();
    _history.undo();
    EXPECT_EQ(first.get(), _lit->getEnvironmentMap());
    EXPECT_EQ(2, first->getIntensity());
    _history.undo();
    EXPECT_EQ(1, first->getIntensity());
    EXPECT_EQ(30, first->getRotation());
    _history.undo();
    EXPECT_EQ(0, first->getRotation());
    _history.redo();
    _history.redo();
    EXPECT_EQ(2, first->getIntensity());
    _history.redo();
    EXPECT_EQ(second.get(), _lit->getEnvironmentMap());
}

TEST_F(History, ANewSceneBeginsANewOne)
{
    setExposure(1);
    _history.restart();
    EXPECT_FALSE(_history.undo());
    EXPECT_EQ(1, exposure());
}

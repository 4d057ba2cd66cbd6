// SPDX-License-Identifier: MIT
// The keys of envlight-viewer are those of its list.
#include <KeyTable.h>

#include <osgEnvLight/Settings>

#include <gtest/gtest.h>

#include <set>

namespace
{

InputEvent press(int key, bool control, bool repeated = false)
{
    InputEvent event;
    event.type = InputEvent::KEY;
    event.key = key;
    event.control = control;
    event.repeated = repeated;
    return event;
}

}  // namespace

TEST(KeyTable, EveryRowIsFoundByItsKey)
{
    for (const KeyBinding& row : keyTable()) EXPECT_EQ(&row, findBinding(press(row.key, row.control))) << row.label;
}

TEST(KeyTable, NoKeyLabelOrEffectIsThereTwice)
{
    std::set<std::pair<int, bool>> keys;
    std::set<std::string> labels;
    std::set<std::string> purposes;
    std::set<std::pair<Action, double>> effects;
    for (const KeyBinding& row : keyTable()) {
        EXPECT_TRUE(keys.emplace(row.key, row.control).second) << row.label;
        EXPECT_TRUE(labels.insert(row.label).second) << row.label;
        EXPECT_TRUE(purposes.insert(row.purpose).second) << row.purpose;
        EXPECT_TRUE(effects.emplace(row.action, row.value).second) << row.purpose;
    }
}

TEST(KeyTable, EveryPresetAndTenViewsHaveAKey)
{
    std::set<int> presets, views;
    for (const KeyBinding& row : keyTable()) {
        if (row.action == Action::PRESET) presets.insert(int(row.value));
        if (row.action == Action::VIEW) views.insert(int(row.value));
    }
    EXPECT_EQ(osgEnvLight::Settings::presets().size(), presets.size());
    EXPECT_EQ(10u, views.size());
}

TEST(KeyTable, AKeyHeldDownRepeatsStepsAlone)
{
    EXPECT_NE(nullptr, findBinding(press('+', false, true)));
    EXPECT_NE(nullptr, findBinding(press('z', true, true)));
    EXPECT_EQ(nullptr, findBinding(press('h', false, true)));
}

TEST(KeyTable, OtherKeysAndEventsDoNothing)
{
    EXPECT_EQ(nullptr, findBinding(press('z', false)));
    EXPECT_EQ(nullptr, findBinding(press('h', true)));
    EXPECT_EQ(nullptr, findBinding(press(0, false)));
    EXPECT_EQ(nullptr, findBinding(InputEvent()));
}

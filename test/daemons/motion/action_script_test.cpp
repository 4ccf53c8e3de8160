#include "daemons/motion/actions/action_script.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "common/error.h"
#include "test/daemons/motion/nao_model.h"
#include "test/support/temporary_folder.h"

namespace nao::motion {
namespace {

class ActionScriptTest : public testing::Test {
 protected:
  std::vector<ActionScript> load(const std::string& text) {
    const TemporaryFolder folder;
    const std::filesystem::path file = folder.path() / "actions.yaml";
    write_text(file, text);
    return ActionScript::load(nao_model(), file);
  }
  /** Expects that the text is refused with a message that contains the words. */
  void expect_refused(const std::string& text, const std::string& words) {
    try {
      load(text);
      ADD_FAILURE() << "accepted: " << text;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
    }
  }
};

constexpr const char* kFall =
    "actions:\n"
    "  - {name: fall, balance_gain: 0, end: gets-up, keyframes: [{duration: 0.2, joints: "
    "{LHipRoll: 0.4}}]}\n";

TEST_F(ActionScriptTest, ReadsTheRobotsOwn) {
  const auto scripts =
      ActionScript::load(nao_model(), nao_model().folder() / "actions/keeper.yaml");
  std::vector<std::string> names;
  for (const ActionScript& script : scripts) names.push_back(script.sequence.name);
  EXPECT_EQ(names, (std::vector<std::string>{"block", "dive-left", "dive-right"}));
}

TEST_F(ActionScriptTest, MirrorsAnAction) {
  const auto scripts = load(std::string(kFall) + "  - {name: other, mirrors: fall}\n");
  ASSERT_EQ(scripts.size(), 2u);
  EXPECT_EQ(scripts[1].end, ActionScript::End::kGetsUp);
  const auto& position = scripts[1].sequence.keyframes.at(0).position;
  EXPECT_DOUBLE_EQ(position[nao_model().find_motor("RHipRoll")], -0.4);
}

TEST_F(ActionScriptTest, SaysWhatIsWrongWithAFile) {
  expect_refused("actions:\n  - {name: a, mirrors: b}\n", "no such action");
  expect_refused(std::string(kFall) + "  - {name: fall, mirrors: fall}\n", "twice");
  expect_refused("actions:\n  - {name: a, balance_gain: 0, end: sleep, keyframes: []}\n",
                 "keyframe");
  expect_refused(
      "actions:\n  - {name: a, balance_gain: -1, end: on-feet, keyframes: "
      "[{duration: 1}]}\n",
      "balance_gain");
  expect_refused(
      "actions:\n  - {name: a, balance_gain: 0, end: sleep, keyframes: "
      "[{duration: 1}]}\n",
      "on-feet");
  expect_refused(
      "actions:\n  - {name: a, balance_gain: 0, end: on-feet, keyframes: "
      "[{duration: 1, joints: {Tail: 1}}]}\n",
      "Tail");
}

}  // namespace
}  // namespace nao::motion

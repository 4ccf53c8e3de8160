#include "tools/walk-tuner/gait_file.h"

#include <gtest/gtest.h>

#include "common/error.h"
#include "robot_import/gait_text.h"

namespace nao::tool {
namespace {

using motion::Gait;

const std::vector<Gait::Parameter> kHipHeight = {
    {"stance.hip_height", [](Gait& gait) -> double& { return gait.stance.hip_height; }}};

TEST(GaitFile, ReplacesValuesAndKeepsEverythingElse) {
  const std::string text =
      "# About steps.\n"
      "swing:\n"
      "  height: {value: 0.018, range: [0.008, 0.04]}\n"
      "  hip_height: {value: 5, range: [1, 9]}\n"
      "\n"
      "stance:\n"
      "  # hip_height: {value: 7\n"
      "  hip_height: {value: 0.2, range: [0.1, 0.3]}  # m\n";
  Gait gait;
  gait.stance.hip_height = 0.22500001;
  EXPECT_EQ(with_gait_values(text, gait, kHipHeight),
            "# About steps.\n"
            "swing:\n"
            "  height: {value: 0.018, range: [0.008, 0.04]}\n"
            "  hip_height: {value: 5, range: [1, 9]}\n"
            "\n"
            "stance:\n"
            "  # hip_height: {value: 7\n"
            "  hip_height: {value: 0.225, range: [0.1, 0.3]}  # m\n");
}

TEST(GaitFile, NoLongerSaysThatNobodyHasTunedTheGait) {
  const std::string text = "# Scaled, " + std::string(kUntunedGait) +
                           ".\nstance:\n  hip_height: {value: 1, range: [0, 2]}\n";
  EXPECT_EQ(with_gait_values(text, Gait(), kHipHeight),
            "# Scaled, then tuned.\nstance:\n  hip_height: {value: 0, range: [0, 2]}\n");
}

TEST(GaitFile, ReportsAParameterWithoutALine) {
  try {
    (void)with_gait_values("stance:\n  height: {value: 1}\n", Gait(), kHipHeight);
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("stance.hip_height"), std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace nao::tool

#include "tools/walk-tuner/gait_file.h"

#include <gtest/gtest.h>

#include "common/error.h"

namespace nao {
namespace {

using motion::Gait;

TEST(GaitFile, ChangesValuesAndNothingElse) {
  const std::string text =
      "# About steps.\n"
      "step_height: {value: 0.018, range: [0.008, 0.04]}\n"
      "hip_height: {value: 0.2, range: [0.1, 0.3]}  # m\n";
  Gait gait;
  gait.hip_height = 0.22500001;
  const std::vector<Gait::Parameter> parameters = {{"hip_height", &Gait::hip_height}};
  EXPECT_EQ(with_gait_values(text, gait, parameters),
            "# About steps.\n"
            "step_height: {value: 0.018, range: [0.008, 0.04]}\n"
            "hip_height: {value: 0.225, range: [0.1, 0.3]}  # m\n");
}

TEST(GaitFile, SaysWhichLineIsMissing) {
  const std::vector<Gait::Parameter> parameters = {{"hip_height", &Gait::hip_height}};
  EXPECT_THROW((void)with_gait_values("step_height: {value: 1}\n", Gait(), parameters), Error);
}

}  // namespace
}  // namespace nao

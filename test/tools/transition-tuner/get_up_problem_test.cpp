#include "tools/transition-tuner/get_up_problem.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "common/text_file.h"

namespace nao {
namespace {

TEST(GetUpCost, IsGreaterForEveryFailureThanForEverySuccess) {
  // The longest try has 14 s.
  const GetUpResult nearly_up = {.is_up = false, .time = 3, .height = 0.99};
  const GetUpResult lies = {.is_up = false, .time = 3, .height = 0.1};
  EXPECT_LT(cost_of({.is_up = true, .time = 4, .load = 0.8, .shaking = 20}),
            cost_of({.is_up = true, .time = 4, .load = 0.9, .shaking = 20}));
  EXPECT_LT(cost_of({.is_up = true, .time = 13, .load = 1, .shaking = 20}), cost_of(nearly_up));
  EXPECT_LT(cost_of(nearly_up), cost_of(lies));
}

TEST(GetUpProblem, RunsTheSameTrialForTheSameTaskAndAnotherWithOtherDisturbances) {
  const std::filesystem::path folder = std::filesystem::path(NAO_TEST_DATA) / "robots" / "nao";
  const auto model = std::make_shared<const RobotModel>(RobotModel::load(folder));
  GetUpProblemOptions options;
  options.trial.model = model;
  options.trial.scene = SceneFile::find("empty");
  options.start = "belly";
  options.trials = 2;
  const std::string text = read_file(folder / "transitions.yaml");
  const GetUpProblem problem(options, TrialConditions({"fast"}, {"default", "real"}),
                             TransitionText(*model, text, {"get-up-belly"}, {}));
  ASSERT_EQ(problem.num_trials(), 4);
  const Eigen::VectorXd start = problem.start();
  Task task{{start.begin(), start.end()}, 12, 0};
  const Figures first = problem.run(task);
  EXPECT_EQ(problem.run(task), first);
  task.trial = 1;
  EXPECT_NE(problem.run(task), first);
}

}  // namespace
}  // namespace nao

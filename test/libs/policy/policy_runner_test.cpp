#include "policy/policy_runner.h"

#include <gmock/gmock.h>

#include <limits>

#include "test/libs/policy/manifests.h"

namespace nao {
namespace {

/** Gives what a test tells it to. */
class FakeNetwork : public PolicyNetwork {
 public:
  double run(const std::vector<float>& observation, std::vector<float>& action) override {
    last_observation = observation;
    action = next;
    return time;
  }
  std::vector<float> next = {0, 0};
  double time = 1e-4;
  std::vector<float> last_observation;
};

class PolicyRunnerTest : public testing::Test {
 protected:
  PolicyRunnerTest() {
    input_.joint_position.assign(static_cast<size_t>(t1_model().num_motors()), 0.0);
    input_.joint_velocity = input_.joint_position;
  }
  /** @return The fault of the first of some control steps of 10 ms that has one. */
  std::string run(int num_ticks) {
    for (int i = 0; i < num_ticks; ++i) {
      if (const auto fault = runner_.step(input_, 0.01)) return *fault;
    }
    return "";
  }

  PolicyManifest manifest_ = parse_manifest(kSmallManifest);
  FakeNetwork network_;
  PolicyRunner runner_{t1_model(), manifest_, network_};
  PolicyInput input_;
};

TEST_F(PolicyRunnerTest, ScalesClippedActionsAroundTheDefaultAngles) {
  network_.next = {0.5F, 9};
  EXPECT_EQ(run(1), "");
  EXPECT_THAT(runner_.targets(), testing::ElementsAre(0.4 + 0.25, 0.4 + 0.5));
  EXPECT_THAT(runner_.action(), testing::ElementsAre(0.5F, 2));
}

TEST_F(PolicyRunnerTest, RunsAtItsOwnRate) {
  EXPECT_EQ(run(100), "");
  EXPECT_EQ(runner_.num_steps(), 50);
}

TEST_F(PolicyRunnerTest, StopsAtAnOutputThatIsNotFinite) {
  EXPECT_EQ(run(10), "");
  network_.next[1] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(run(2), "output 2 of 2, for Right_Knee_Pitch, is not finite");
}

TEST_F(PolicyRunnerTest, StopsAtTargetsThatStayFasterThanTheMotor) {
  // A robot that gets up may shake its joints for half a second.
  for (const auto& [kind, expected] :
       {std::pair{PolicyManifest::Kind::kWalk, 6}, {PolicyManifest::Kind::kGetUp, 26}}) {
    manifest_.kind = kind;
    runner_.start();
    // One jump is allowed, a joint that shakes is not.
    network_.next[0] = 1.9F;
    EXPECT_EQ(run(20), "");
    std::string fault;
    int num_steps = 0;
    while (fault.empty() && num_steps < 40) {
      network_.next[0] = -network_.next[0];
      fault = run(2);
      ++num_steps;
    }
    EXPECT_THAT(fault, testing::HasSubstr("it moves Left_Knee_Pitch at 95.0 rad/s"));
    EXPECT_EQ(num_steps, expected);
  }
}

TEST_F(PolicyRunnerTest, StopsAtAnOutputThatIsNoAngle) {
  manifest_.action_clip = std::numeric_limits<double>::infinity();
  network_.next[0] = 1e6F;
  EXPECT_THAT(run(1), testing::HasSubstr("turns Left_Knee_Pitch by 5e+05 rad"));
}

TEST_F(PolicyRunnerTest, StopsWhenAnInferenceTakes200Milliseconds) {
  EXPECT_EQ(run(10), "");
  network_.time = 0.2;
  EXPECT_EQ(run(2), "an inference took 200 ms; a step lasts 20 ms");
}

TEST_F(PolicyRunnerTest, StopsWhenInferencesStayLongerThanAStep) {
  network_.time = 0.03;
  EXPECT_EQ(run(6), "");
  EXPECT_EQ(run(2), "an inference took 30 ms; a step lasts 20 ms");
}

TEST_F(PolicyRunnerTest, BeginsAnewAfterAStart) {
  network_.next = {1, 1};
  run(4);
  runner_.start();
  EXPECT_THAT(runner_.targets(), testing::ElementsAre(0.4, 0.4));
  EXPECT_EQ(runner_.num_steps(), 0);
}

}  // namespace
}  // namespace nao

#include "tools/policy-train/reward_terms.h"

#include <gmock/gmock.h>

#include "test/tools/policy-train/small_policy.h"

namespace nao::policy_train {
namespace {

/** A robot of 1 m that stands with its soles 0.2 m apart. */
class RewardTerms : public testing::Test {
 protected:
  RewardTerms() {
    start_.torso.translation() = Eigen::Vector3d(0, 0, 1);
    start_.soles[0].translation() = Eigen::Vector3d(0, 0.1, 0);
    start_.soles[1].translation() = Eigen::Vector3d(0, -0.1, 0);
    start_.load = {0.5, 0.5};
    const int count = t1_model().num_motors();
    start_.velocity = start_.torque = Eigen::VectorXd::Zero(count);
    start_.position =
        Eigen::VectorXd::Map(manifest_.default_position.data(), static_cast<long>(count));
    start_.target = start_.position;
    before_ = after_ = start_;
  }

  double term(RewardTerm which, const Eigen::Vector3d& command = Eigen::Vector3d::Zero(),
              double phase = 0, bool fallen = false) {
    std::array<float, kNumRewardTerms> terms{};
    calc_reward_terms(t1_model(), manifest_, start_, before_, after_, command, phase, fallen,
                      terms.data());
    return static_cast<double>(terms[static_cast<size_t>(which)]);
  }

  PolicyManifest manifest_ = parse_manifest(kLegs);
  MotionSample start_;
  MotionSample before_;
  MotionSample after_;
};

TEST_F(RewardTerms, AreZeroForARobotThatStandsStill) {
  for (int i = static_cast<int>(RewardTerm::kTilt); i < static_cast<int>(RewardTerm::kAlive); ++i) {
    const auto which = static_cast<RewardTerm>(i);
    if (which == RewardTerm::kGait) continue;
    EXPECT_NEAR(term(which), 0, 1e-9) << reward_term_names()[static_cast<size_t>(i)];
  }
  EXPECT_EQ(term(RewardTerm::kAlive), 1);
  EXPECT_EQ(term(RewardTerm::kFallen, Eigen::Vector3d::Zero(), 0, true), 1);
}

TEST_F(RewardTerms, TrackTheVelocityInTheFrameOfTheHeading) {
  // It faces along y and moves along y.
  after_.torso.linear() = Eigen::AngleAxisd(M_PI / 2, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  after_.linear_velocity = {0.3, 0, 0};
  EXPECT_NEAR(term(RewardTerm::kVelocityTracking, {0.3, 0, 0}), 1, 1e-6);
  EXPECT_NEAR(term(RewardTerm::kVelocityTracking, {0, 0, 0}), std::exp(-0.09 / 0.25), 1e-6);
  after_.angular_velocity = {0, 0, 0.5};
  EXPECT_NEAR(term(RewardTerm::kTurnTracking, {0.3, 0, 0.5}), 1, 1e-6);
  EXPECT_NEAR(term(RewardTerm::kTurnTracking, {0.3, 0, 0}), std::exp(-1.0), 1e-6);
}

TEST_F(RewardTerms, TrackTheMeanVelocityMoreNarrowly) {
  EXPECT_EQ(term(RewardTerm::kMeanVelocity), 1);
  after_.velocity_error = {0.1, 0, 0.2};
  EXPECT_NEAR(term(RewardTerm::kMeanVelocity), std::exp(-1.0), 1e-6);
}

TEST_F(RewardTerms, PunishTiltUpsideDownMost) {
  const auto tilted = [this](double angle) {
    after_.torso.linear() = Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitX()).toRotationMatrix();
    return term(RewardTerm::kTilt);
  };
  EXPECT_NEAR(tilted(0.3), std::pow(std::sin(0.3), 2), 1e-6);
  EXPECT_LT(tilted(1.5), tilted(3.1));
}

TEST_F(RewardTerms, LetEachFootSwingInItsHalfOfTheCycle) {
  const Eigen::Vector3d ahead(0.3, 0, 0);
  after_.load = {0, 1};
  EXPECT_EQ(term(RewardTerm::kGait, ahead, 0.25), 2);
  EXPECT_EQ(term(RewardTerm::kGait, ahead, 0.75), 0);
  EXPECT_EQ(term(RewardTerm::kGait, ahead, 0), 1);
  after_.soles[0].translation().z() = 0.05;
  EXPECT_NEAR(term(RewardTerm::kClearance, ahead, 0.25), 0.05, 1e-6);
  EXPECT_EQ(term(RewardTerm::kClearance, ahead, 0.75), 0);
  // No foot swings at command 0 where the phase rests.
  manifest_.phase_at_rest = PolicyManifest::PhaseAtRest::kZeros;
  EXPECT_EQ(term(RewardTerm::kGait, Eigen::Vector3d::Zero(), 0.25), 1);
}

TEST_F(RewardTerms, TellARobotThatStandsFromOneThatKneelsOrLeans) {
  EXPECT_EQ(term(RewardTerm::kStanding), 1);
  manifest_.kind = PolicyManifest::Kind::kGetUp;
  after_.position.array() += 0.1;
  EXPECT_NEAR(term(RewardTerm::kRestPosture), 0.01, 1e-6);
  after_.torso.translation().z() = 0.7;
  EXPECT_EQ(term(RewardTerm::kStanding), 0);
  EXPECT_EQ(term(RewardTerm::kRestPosture), 0);
  after_.torso = start_.torso * Eigen::AngleAxisd(0.6, Eigen::Vector3d::UnitX());
  EXPECT_EQ(term(RewardTerm::kStanding), 0);
}

TEST_F(RewardTerms, PunishSlipOfFeetThatCarryOnly) {
  after_.soles[1].translation().x() += 0.01;
  EXPECT_NEAR(term(RewardTerm::kSlip), 0.25, 1e-6);
  after_.load[1] = 0;
  EXPECT_EQ(term(RewardTerm::kSlip), 0);
}

TEST_F(RewardTerms, TakeOnlyJointsOfRollAndYawForLateral) {
  const int pitch = t1_model().find_motor("Left_Hip_Pitch");
  const int roll = t1_model().find_motor("Left_Hip_Roll");
  after_.position[pitch] += 0.2;
  EXPECT_EQ(term(RewardTerm::kLateralPosture), 0);
  EXPECT_NEAR(term(RewardTerm::kPosture), 0.04 / 8, 1e-6);
  after_.position[roll] += 0.2;
  EXPECT_NEAR(term(RewardTerm::kLateralPosture), 0.04 / 8, 1e-6);
}

TEST_F(RewardTerms, PunishFeetThatAreCloserThanAtTheStart) {
  after_.soles[0].translation().y() = 0.05;
  EXPECT_NEAR(term(RewardTerm::kFootDistance), 0.0025, 1e-6);
  after_.soles[0].translation().y() = 0.2;
  EXPECT_EQ(term(RewardTerm::kFootDistance), 0);
}

}  // namespace
}  // namespace nao::policy_train

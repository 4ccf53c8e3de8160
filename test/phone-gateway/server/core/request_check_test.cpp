#include "phone-gateway/server/core/request_check.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "test/phone-gateway/server/core/test_robot.h"

namespace nao::gateway {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

template <class Checked>
bool is_refused(const Checked& checked) {
  return std::holds_alternative<Refusal>(checked);
}

naoremote::WalkTurn walk(double vx, double vy, double wz) {
  naoremote::WalkTurn request;
  request.set_vx(vx);
  request.set_vy(vy);
  request.set_wz(wz);
  return request;
}

TEST(RequestCheck, ClipsAWalkToTheRobotsLimits) {
  const naoremote::RobotDescription robot = make_test_robot();
  const auto slow = std::get<WalkCommand>(check(walk(0.15, -0.1, 0.5), robot));
  EXPECT_EQ(slow.vx, 0.15);
  EXPECT_EQ(slow.vy, -0.1);
  EXPECT_EQ(slow.wz, 0.5);
  const auto fast = std::get<WalkCommand>(check(walk(1e300, -7, 1.5), robot));
  EXPECT_EQ(fast.vx, 0.2);
  EXPECT_EQ(fast.vy, -0.15);
  EXPECT_EQ(fast.wz, 1);
  EXPECT_EQ(std::get<WalkCommand>(check(walk(-1, 0, 0), robot)).vx, -0.1);
}

TEST(RequestCheck, RefusesAWalkThatIsNotFinite) {
  const naoremote::RobotDescription robot = make_test_robot();
  for (const double bad : {kNaN, kInfinity, -kInfinity}) {
    EXPECT_TRUE(is_refused(check(walk(bad, 0, 0), robot))) << bad;
    EXPECT_TRUE(is_refused(check(walk(0, bad, 0), robot))) << bad;
    EXPECT_TRUE(is_refused(check(walk(0, 0, bad), robot))) << bad;
  }
}

TEST(RequestCheck, RefusesAGoalThatIsTooFarOrNotFinite) {
  naoremote::MoveTo request;
  request.set_x(10);
  request.set_theta(-3.15);
  EXPECT_FALSE(is_refused(check(request)));
  for (const double bad : {10.1, kNaN, -kInfinity}) {
    request.set_x(bad);
    EXPECT_TRUE(is_refused(check(request))) << bad;
  }
  request.set_x(0);
  request.set_theta(kNaN);
  EXPECT_TRUE(is_refused(check(request)));
}

TEST(RequestCheck, AcceptsTheRobotsPosturesOnly) {
  const naoremote::RobotDescription robot = make_test_robot();
  naoremote::GoToPosture request;
  request.set_posture("Crouch");
  const auto goal = std::get<PostureCommand>(check(request, robot));
  EXPECT_EQ(goal.posture, "Crouch");
  EXPECT_EQ(goal.speed, 0.5);
  for (const char* bad : {"", "crouch", "Split", "Crouch "}) {
    request.set_posture(bad);
    EXPECT_TRUE(is_refused(check(request, robot))) << bad;
  }
}

TEST(RequestCheck, RefusesSpeedsOutsideZeroToOne) {
  const naoremote::RobotDescription robot = make_test_robot();
  naoremote::GoToPosture request;
  request.set_posture("Crouch");
  for (const double bad : {-0.1, 1.1, kNaN, kInfinity}) {
    request.set_speed(bad);
    EXPECT_TRUE(is_refused(check(request, robot))) << bad;
  }
}

TEST(RequestCheck, QuotesAnUnknownNameSafely) {
  naoremote::GoToPosture request;
  request.set_posture(std::string("\x1b[2J\n") + std::string(1000, 'x'));
  const auto refusal = std::get<Refusal>(check(request, make_test_robot()));
  const std::string message = describe_reason(refusal.reason);
  EXPECT_EQ(message.find('\x1b'), std::string::npos);
  EXPECT_LT(message.size(), 120u);
}

TEST(RequestCheck, MapsGroupAndAxisToJoints) {
  const naoremote::RobotDescription robot = make_test_robot();
  naoremote::ChangeJoints request;
  request.set_group("head");
  request.set_yaw(0.2);
  request.set_pitch(-0.1);
  const auto change = std::get<JointChangeCommand>(check(request, robot));
  EXPECT_EQ(change.joint_names, (std::vector<std::string>{"HeadYaw", "HeadPitch"}));
  EXPECT_EQ(change.joint_position, (std::vector<double>{0.2, -0.1}));
  EXPECT_EQ(change.speed, 0.3);
  EXPECT_FALSE(change.allow_tipping);
}

TEST(RequestCheck, MirrorsAChangeOfBothSides) {
  naoremote::RobotDescription robot = make_test_robot();
  for (const std::string side : {"left", "right"}) {
    naoremote::JointGroup& hip = *robot.add_joint_groups();
    hip.set_name(side + " hip");
    hip.set_yaw_joint("LHipYawPitch");
    hip.set_pitch_joint(side == "left" ? "LHipPitch" : "RHipPitch");
    hip.set_roll_joint(side == "left" ? "LHipRoll" : "RHipRoll");
  }
  naoremote::ChangeJoints request;
  request.set_group("right hip");
  request.set_yaw(0.1);
  request.set_pitch(0.2);
  request.set_roll(0.3);
  request.set_both_sides(true);
  const auto change = std::get<JointChangeCommand>(check(request, robot));
  EXPECT_EQ(change.joint_names, (std::vector<std::string>{"LHipYawPitch", "RHipPitch", "RHipRoll",
                                                          "LHipPitch", "LHipRoll"}));
  EXPECT_EQ(change.joint_position, (std::vector<double>{0.1, 0.2, 0.3, 0.2, -0.3}));
}

TEST(RequestCheck, TurnsTheHeadOnceForBothSides) {
  naoremote::ChangeJoints request;
  request.set_group("head");
  request.set_yaw(0.2);
  request.set_both_sides(true);
  const auto change = std::get<JointChangeCommand>(check(request, make_test_robot()));
  EXPECT_EQ(change.joint_names, (std::vector<std::string>{"HeadYaw"}));
}

TEST(RequestCheck, RefusesAnAxisThatTheGroupLacks) {
  const naoremote::RobotDescription robot = make_test_robot();
  naoremote::ChangeJoints request;
  request.set_group("head");
  request.set_roll(0.1);
  EXPECT_TRUE(is_refused(check(request, robot)));
  request.set_group("tail");
  EXPECT_TRUE(is_refused(check(request, robot)));
}

TEST(RequestCheck, RefusesChangesThatAreOutOfRangeOrZero) {
  const naoremote::RobotDescription robot = make_test_robot();
  naoremote::ChangeJoints request;
  request.set_group("head");
  EXPECT_TRUE(is_refused(check(request, robot))) << "no change at all";
  for (const double bad : {kNaN, kInfinity, 7.0}) {
    request.set_yaw(bad);
    EXPECT_TRUE(is_refused(check(request, robot))) << bad;
  }
}

TEST(RequestCheck, LeavesAbsentDetailsToTheAction) {
  const naoremote::RobotDescription robot = make_test_robot();
  naoremote::DoAction request;
  request.set_action("kick-left");
  auto action = std::get<ActionCommand>(check(request, robot));
  EXPECT_TRUE(std::isnan(action.ball_x));
  EXPECT_TRUE(std::isnan(action.strength));
  request.set_ball_x(0.2);
  EXPECT_TRUE(is_refused(check(request, robot))) << "one coordinate only";
  request.set_ball_y(0.05);
  request.set_strength(0.7);
  action = std::get<ActionCommand>(check(request, robot));
  EXPECT_EQ(action.ball_x, 0.2);
  EXPECT_EQ(action.strength, 0.7);
  request.set_strength(0);
  EXPECT_TRUE(is_refused(check(request, robot)));
  request.set_action("fly");
  EXPECT_TRUE(is_refused(check(request, robot)));
}

TEST(RequestCheck, FillsInAnImagesDefaultsAndRefusesOtherValues) {
  const naoremote::RobotDescription robot = make_test_robot();
  naoremote::ImageRequest request;
  EXPECT_EQ(std::get<ImageSelection>(check(request, robot)).width, 320u);
  EXPECT_EQ(std::get<ImageSelection>(check(request, robot)).camera, "top");
  for (const unsigned bad : {1u, 319u, 641u, 4294967295u}) {
    request.set_width(bad);
    EXPECT_TRUE(is_refused(check(request, robot))) << bad;
  }
  request.set_width(640);
  request.set_quality(96);
  EXPECT_TRUE(is_refused(check(request, robot)));
  request.set_quality(95);
  request.set_camera("bottom");
  EXPECT_EQ(std::get<ImageSelection>(check(request, robot)).camera, "bottom");
  request.set_camera("left");
  EXPECT_TRUE(is_refused(check(request, robot)));
}

TEST(RequestCheck, BoundsTheRatesOfASubscription) {
  naoremote::Subscribe request;
  request.set_state_rate(60);
  request.set_image_rate(30);
  EXPECT_FALSE(is_refused(check(request, make_test_robot(), GatewayLimits{})));
  for (const double bad : {-1.0, 61.0, kNaN, kInfinity}) {
    request.set_state_rate(bad);
    EXPECT_TRUE(is_refused(check(request, make_test_robot(), GatewayLimits{}))) << bad;
  }
}

}  // namespace
}  // namespace nao::gateway

#include "tools/policy-train/push_schedule.h"

#include <gtest/gtest.h>

#include <cmath>

namespace nao::policy_train {
namespace {

constexpr double kAhead = 0.9;
constexpr double kAside = 0.5;

/** A policy that withstands less to the side than ahead and back, at one phase much less. */
bool falls(const PushSchedule::Push& push, double phase) {
  const double angle = std::atan2(push.impulse.y(), push.impulse.x());
  const bool is_aside = std::abs(std::sin(angle)) > std::sin(M_PI / 8);
  const bool is_left = angle > 0;
  const bool is_worst = std::abs(phase - (is_left ? 0.25 : 0.75)) < 0.1;
  return push.impulse.norm() > (!is_aside ? kAhead : is_worst ? 0.6 * kAside : kAside);
}

void teach(PushSchedule& schedule, int num_pushes) {
  Random random(1);
  for (int i = 0; i < num_pushes; ++i) {
    const double phase = random.uniform();
    const PushSchedule::Push push = schedule.draw(phase, random);
    schedule.learn(push, falls(push, phase));
  }
}

TEST(PushSchedule, BeginsWithLightPushes) {
  Random random(1);
  const PushSchedule schedule(1.5);
  for (int i = 0; i < 1000; ++i) EXPECT_LT(schedule.draw(0.5, random).impulse.norm(), 0.4);
}

TEST(PushSchedule, PushesNearWhatIsWithstood) {
  PushSchedule schedule(1.5);
  teach(schedule, 20000);
  Random random(2);
  for (int i = 0; i < 1000; ++i) {
    const PushSchedule::Push push = schedule.draw(0.0, random);
    const double side = std::abs(push.impulse.normalized().y());
    // Within the sector of the direction in which it withstands one impulse.
    if (side > 0.3 && side < 0.8) continue;
    const double withstood = side < 0.5 ? kAhead : kAside;
    EXPECT_NEAR(push.impulse.norm(), 0.87 * withstood, 0.35 * withstood);
  }
}

TEST(PushSchedule, PushesMostWhereLeastIsWithstood) {
  PushSchedule schedule(1.5);
  teach(schedule, 20000);
  Random random(2);
  int num_aside = 0;
  for (int i = 0; i < 1000; ++i) {
    num_aside += std::abs(schedule.draw(0.0, random).impulse.normalized().y()) > M_SQRT1_2 ? 1 : 0;
  }
  // Half of them if all directions were alike.
  EXPECT_GT(num_aside, 600);
}

TEST(PushSchedule, TakesAPushToTheRightForOneToTheLeftHalfACycleLater) {
  PushSchedule schedule(1.5);
  teach(schedule, 20000);
  Random random(2);
  double left = 0, right = 0;
  int num_left = 0, num_right = 0;
  for (int i = 0; i < 4000; ++i) {
    const PushSchedule::Push push = schedule.draw(0.25, random);
    const Eigen::Vector2d& p = push.impulse;
    if (std::abs(p.y()) < 0.9 * p.norm()) continue;
    (p.y() > 0 ? left : right) += p.norm();
    ++(p.y() > 0 ? num_left : num_right);
  }
  // At this phase the robot withstands less to the left.
  EXPECT_LT(left / num_left, 0.75 * right / num_right);
}

TEST(PushSchedule, PushesNoHarderThanItMay) {
  PushSchedule schedule(0.2);
  Random random(1);
  for (int i = 0; i < 10000; ++i) {
    const PushSchedule::Push push = schedule.draw(std::nullopt, random);
    EXPECT_LE(push.impulse.norm(), 0.2 + 1e-12);
    schedule.learn(push, false);
  }
}

}  // namespace
}  // namespace nao::policy_train

// Footstep planning, step timing, ZMP control and balance feedback together, on a simulated linear
// inverted pendulum in place of the robot.

#include <gtest/gtest.h>

#include <algorithm>

#include "daemons/motion/walk/step_planner.h"
#include "daemons/motion/walk/step_timing.h"
#include "daemons/motion/walk/zmp_control.h"
#include "kinematics/support_polygon.h"
#include "test/daemons/motion/walk/nao_gait.h"

namespace nao::motion {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kTick = 0.01;  // s
// A step lasts whole ticks: the DCM, about 0.1 m from the ZMP at touchdown, moves by 6 mm in one.
constexpr double kTickError = 6e-3;  // m

/** A pendulum that walks. */
class PendulumWalk {
 public:
  explicit PendulumWalk(const Vector3d& velocity) : velocity_(velocity) {
    feet_.start(FootstepPlanner(nao_model(), gait_).square_step(true));
    reference_.start(feet_.midpoint(), 0.26);
    steps_.start();
    plan();
    // Both begin on the plan.
    com_ = {feet_.midpoint(), Eigen::Vector2d::Zero()};
    com_.velocity = reference_.omega() * (steps_.dcm().start - com_.position);
    reference_.follow(com_, 1e9);
  }

  void push(const Vector2d& change_of_velocity) { com_.velocity += change_of_velocity; }

  void step() {
    const double omega = reference_.omega();
    double duration = gait_.timing.step_duration;
    for (double time = 0; time < duration - kTick / 2; time += kTick) {
      reference_.follow(com_, kTick);
      const Vector2d error = reference_.dcm_error(com_);
      const Vector2d dcm = reference_.dcm() + gait_.feedback.footstep_gain * error;
      const double zmp_y = -feet_.side() * feet_.support_zmp().y();
      duration = adapt_step_duration(
          gait_, {-feet_.side() * dcm.y() - zmp_y, -feet_.side() * steps_.dcm().end.y() - zmp_y},
          omega, time, duration);
      const double remaining = duration - time;
      if (remaining > kMinHorizon) {
        reference_.set_zmp(control_single_support(gait_.zmp, feet_.support_zmp(), reference_.dcm(),
                                                  steps_.dcm().end, omega, remaining));
        steps_.adapt_foothold(feet_, advance_dcm(dcm, reference_.zmp(), omega, remaining));
      }
      // The command of foot_loads.cpp to the ankle.
      const Vector2d zmp = clamp_to_sole(
          gait_.zmp, reference_.zmp() + gait_.feedback.ankle_dcm_gain * error, feet_.support_zmp());
      check_zmp(zmp);
      reference_.advance(kTick);
      com_ = advance(com_, zmp, omega, kTick);
    }
    change_support();
  }

  /** Tracking error, m. */
  double dcm_error() const { return reference_.dcm_error(com_).norm(); }
  /** Distance of the DCM from the plan for the beginning of the step, m. */
  double plan_error() const { return (com_.dcm(reference_.omega()) - steps_.dcm().start).norm(); }
  /** Least distance from the ZMP to the edge of the sole so far, m. */
  double zmp_margin() const { return zmp_margin_; }

 private:
  void plan() {
    steps_.begin_step(false);
    steps_.plan(feet_, reference_, velocity_, false, gait_.timing.step_duration);
  }

  void change_support() {
    const Spread spread = steps_.end_step(feet_, velocity_);
    feet_.swing().start(steps_.foothold(), 0);
    const Pose2 to_new = feet_.exchange(spread);
    reference_.change_frame(to_new);
    com_ = {to_new * com_.position, to_new.rotate(com_.velocity)};
    plan();
  }

  void check_zmp(const Vector2d& zmp) {
    const auto& outline = feet_.support_is_left() ? nao_model().left_sole_outline()
                                                  : nao_model().right_sole_outline();
    zmp_margin_ = std::min(zmp_margin_, margin_in_polygon(outline, zmp));
  }

  const Gait& gait_ = nao_gait();
  Vector3d velocity_;
  Feet feet_{gait_};
  ComReference reference_{gait_};
  StepPlanner steps_{nao_model(), gait_, 0};
  PendulumState com_;
  double zmp_margin_ = 1;
};

TEST(PendulumWalk, StaysOnThePlanUndisturbed) {
  PendulumWalk walk({0.2, 0, 0});
  for (int i = 0; i < 20; ++i) walk.step();
  EXPECT_LT(walk.dcm_error(), 1e-6);
  EXPECT_LT(walk.plan_error(), kTickError);
}

TEST(PendulumWalk, ReturnsToThePlanAfterAPush) {
  for (const Vector2d& push :
       {Vector2d(0.1, 0), Vector2d(-0.1, 0), Vector2d(0, 0.08), Vector2d(0, -0.08)}) {
    PendulumWalk walk({0.15, 0, 0});
    for (int i = 0; i < 6; ++i) walk.step();
    walk.push(push);
    EXPECT_GT(walk.dcm_error(), 0.01);
    // Without friction and servos the error decays at about 0.6 per s: omega, less the gains of the
    // reference and of the ankle.
    for (int i = 0; i < 40; ++i) walk.step();
    EXPECT_LT(walk.dcm_error(), 2e-3) << push.transpose();
    EXPECT_LT(walk.plan_error(), kTickError) << push.transpose();
    EXPECT_GT(walk.zmp_margin(), 0) << push.transpose();
  }
}

}  // namespace
}  // namespace nao::motion

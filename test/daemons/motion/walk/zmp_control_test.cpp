#include "daemons/motion/walk/zmp_control.h"

#include <gtest/gtest.h>

#include <cmath>

#include "daemons/motion/walk/pendulum.h"
#include "kinematics/support_polygon.h"
#include "test/daemons/motion/walk/nao_gait.h"

namespace nao::motion {
namespace {

using Eigen::Vector2d;

constexpr double kOmega = 6.1;  // 1/s

TEST(ZmpControl, BringsTheDcmToItsEndPoint) {
  Gait::Zmp gait = nao_gait().zmp;
  gait.gain = 1;
  const Vector2d nominal(0.005, -0.005);
  const Vector2d dcm(0.01, 0.03);
  const Vector2d end = advance_dcm(dcm, {0.012, 0.004}, kOmega, 0.15);
  const Vector2d zmp = control_single_support(gait, nominal, dcm, end, kOmega, 0.15);
  EXPECT_NEAR((advance_dcm(dcm, zmp, kOmega, 0.15) - end).norm(), 0, 1e-12);
}

TEST(ZmpControl, KeepsTheZmpOnTheSole) {
  const Feet feet(nao_gait());
  for (const bool is_left : {true, false}) {
    const auto& outline =
        is_left ? nao_model().left_sole_outline() : nao_model().right_sole_outline();
    for (int i = 0; i < 500; ++i) {
      const Vector2d dcm(0.3 * std::sin(i * 1.1), 0.3 * std::sin(i * 1.7));
      const Vector2d end(0.3 * std::sin(i * 2.3), 0.3 * std::sin(i * 2.9));
      const Vector2d zmp = control_single_support(nao_gait().zmp, feet.nominal_zmp(is_left), dcm,
                                                  end, kOmega, 0.06 + 0.001 * (i % 200));
      EXPECT_GT(margin_in_polygon(outline, zmp), 0) << zmp.transpose();
    }
  }
}

TEST(ZmpControl, KeepsTheZmpBetweenTheFeetInDoubleSupport) {
  Feet feet(nao_gait());
  const Pose2 right{{0, -0.1}, 0};
  feet.start(right);
  std::vector<Vector2d> corners = nao_model().left_sole_outline();
  for (const Vector2d& corner : nao_model().right_sole_outline()) corners.push_back(right * corner);
  const std::vector<Vector2d> hull = convex_hull(corners);
  for (int i = 0; i < 500; ++i) {
    const Vector2d dcm(0.3 * std::sin(i * 1.1), 0.3 * std::sin(i * 1.7));
    const Vector2d zmp =
        control_double_support(nao_gait().zmp, feet, dcm, feet.midpoint(), kOmega, 0.2);
    EXPECT_GT(margin_in_polygon(hull, zmp), 0) << zmp.transpose();
  }
}

TEST(ZmpControl, BringsTheCenterOfMassToRestInDoubleSupport) {
  Feet feet(nao_gait());
  feet.start({{0, -0.1}, 0});
  const Vector2d goal = feet.midpoint();
  PendulumState state{goal + Vector2d(0.01, 0.02), {0.05, -0.1}};
  for (int i = 0; i < 150; ++i) {
    const Vector2d zmp =
        control_double_support(nao_gait().zmp, feet, state.dcm(kOmega), goal, kOmega, 0.2);
    state = advance(state, zmp, kOmega, 0.01);
  }
  EXPECT_NEAR((state.position - goal).norm(), 0, 1e-3);
  EXPECT_NEAR(state.velocity.norm(), 0, 1e-2);
}

}  // namespace
}  // namespace nao::motion

#include "daemons/motion/walk/dcm_plan.h"

#include <gtest/gtest.h>

#include "daemons/motion/walk/pendulum.h"

namespace nao::motion {
namespace {

using Eigen::Vector2d;

constexpr double kOmega = 6.1;      // 1/s
constexpr double kDuration = 0.25;  // s
const std::vector<Vector2d> kZmps = {{0, -0.05}, {0.06, 0.05}, {0.12, -0.05}, {0.18, 0.06}};

TEST(DcmPlan, LeadsThePendulumThroughAllStepsToTheFinalDcm) {
  const Vector2d final_dcm(0.2, 0.01);
  const DcmPlan plan = plan_dcm(kZmps, final_dcm, kOmega, kDuration);
  // Any center of mass whose DCM is the planned one.
  PendulumState state{{-0.03, 0.02}, {}};
  state.velocity = kOmega * (plan.start - state.position);
  for (size_t i = 0; i < kZmps.size(); ++i) {
    state = advance(state, kZmps[i], kOmega, kDuration);
    if (i == 0) {
      EXPECT_NEAR((state.dcm(kOmega) - plan.end).norm(), 0, 1e-12);
    }
  }
  EXPECT_NEAR((state.dcm(kOmega) - final_dcm).norm(), 0, 1e-12);
}

TEST(DcmPlan, OfOneStepEndsAtTheFinalDcm) {
  const DcmPlan plan = plan_dcm({kZmps.front()}, {0.1, 0.02}, kOmega, kDuration);
  EXPECT_EQ(plan.end, Vector2d(0.1, 0.02));
}

TEST(DcmPlan, ForgetsTheFinalDcmExponentially) {
  const DcmPlan a = plan_dcm(kZmps, {0.2, 0}, kOmega, kDuration);
  const DcmPlan b = plan_dcm(kZmps, {0.3, 0}, kOmega, kDuration);
  EXPECT_NEAR(b.end.x() - a.end.x(), 0.1 * std::exp(-3 * kOmega * kDuration), 1e-12);
}

}  // namespace
}  // namespace nao::motion

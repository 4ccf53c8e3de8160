#include "daemons/motion/walk/foot_loads.h"

#include <gtest/gtest.h>

#include "common/constants.h"
#include "test/daemons/motion/walk/nao_gait.h"

namespace nao::motion {
namespace {

using Eigen::AngleAxisd;
using Eigen::Isometry3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kMass = 5;  // kg

class FootLoadsTest : public testing::Test {
 protected:
  FootLoadsTest() {
    feet_.start({{0.02, -0.1}, 0});
    reference_.start({0.01, -0.04}, 0.26);
    reference_.set_zmp({0.012, -0.004});
    torso_.translation() << 0.01, -0.05, 0.3;
    torso_.linear() = AngleAxisd(0.1, Vector3d::UnitY()).toRotationMatrix();
  }

  std::array<FootLoad, 2> plan(const LoadPlan& plan) const {
    return plan_foot_loads(nao_gait(), kMass, feet_, reference_, plan, torso_);
  }
  /** Force and point of a load in the support frame S. */
  Vector3d force(const FootLoad& load) const { return torso_.linear() * load.force; }
  Vector3d point(const FootLoad& load) const { return torso_ * load.point; }

  Feet feet_{nao_gait()};
  ComReference reference_{nao_gait()};
  Isometry3d torso_ = Isometry3d::Identity();
};

TEST_F(FootLoadsTest, TogetherCarryTheWeightAndAccelerateTheCenterOfMass) {
  const auto loads = plan({{0, 0}, 0.3, true});
  const Vector3d sum = force(loads[0]) + force(loads[1]);
  EXPECT_NEAR(sum.z(), kMass * kGravity, 1e-9);
  const double omega = reference_.omega();
  const Vector2d acceleration = omega * omega * (reference_.state().position - reference_.zmp());
  EXPECT_NEAR((sum.head<2>() - kMass * acceleration).norm(), 0, 1e-9);
  // The left foot is the support foot.
  EXPECT_NEAR(force(loads[1]).z(), 0.3 * kMass * kGravity, 1e-9);
}

TEST_F(FootLoadsTest, ActAtTheNominalPointsInDoubleSupport) {
  const auto loads = plan({{0, 0}, 0.5, true});
  EXPECT_NEAR((point(loads[0]).head<2>() - feet_.support_zmp()).norm(), 0, 1e-12);
  EXPECT_NEAR((point(loads[1]).head<2>() - feet_.other_zmp()).norm(), 0, 1e-12);
}

TEST_F(FootLoadsTest, ActAtTheZmpInSingleSupport) {
  const auto loads = plan({{0, 0}, 0, false});
  EXPECT_NEAR((point(loads[0]).head<2>() - reference_.zmp()).norm(), 0, 1e-12);
  EXPECT_EQ(loads[1].force, Vector3d(0, 0, 0));
}

TEST_F(FootLoadsTest, MoveAgainstADcmErrorAsFarAsTheSoleAllows) {
  const Vector2d error(0.01, 0.005);
  const Vector2d moved = point(plan({error, 0, false})[0]).head<2>() - reference_.zmp();
  EXPECT_NEAR((moved - nao_gait().feedback.ankle_dcm_gain * error).norm(), 0, 1e-12);
  const Vector2d farthest = point(plan({{1, 1}, 0, false})[0]).head<2>() - feet_.support_zmp();
  EXPECT_NEAR(farthest.x(), nao_gait().zmp.reach_forward, 1e-12);
  EXPECT_NEAR(farthest.y(), nao_gait().zmp.reach_sideways, 1e-12);
}

TEST_F(FootLoadsTest, BelongToTheRightFootWhenItIsTheSupportFoot) {
  reference_.change_frame(feet_.exchange({}));
  const auto loads = plan({{0, 0}, 0, false});
  EXPECT_EQ(loads[0].force, Vector3d(0, 0, 0));
  EXPECT_NEAR(force(loads[1]).z(), kMass * kGravity, 1e-9);
}

}  // namespace
}  // namespace nao::motion

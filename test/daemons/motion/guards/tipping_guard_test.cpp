#include "daemons/motion/guards/tipping_guard.h"

#include <gtest/gtest.h>

#include <cmath>

#include "common/constants.h"
#include "test/daemons/motion/nao_model.h"

namespace nao::motion {
namespace {

/** Up as measured in the torso of a robot whose soles are level, with an error of the inertial unit
 * about x and about y, rad. */
Eigen::Vector3d up_with_error(const std::vector<double>& position, double about_x, double about_y) {
  Kinematics kinematics(nao_model());
  kinematics.update(position);
  const Eigen::Vector3d level = kinematics.left_sole().linear().col(2);
  return Eigen::AngleAxisd(about_x, Eigen::Vector3d::UnitX()) *
         Eigen::AngleAxisd(about_y, Eigen::Vector3d::UnitY()) * level;
}

class TippingGuardTest : public ::testing::Test {
 protected:
  std::vector<double> turned(const std::string& joint, double angle) const {
    std::vector<double> position = stand_;
    position[nao_model().find_motor(joint)] = angle;
    return position;
  }

  const std::vector<double> stand_ = nao_model().find_posture("StandInit")->position;
  TippingGuard guard_{nao_model()};
  Equilibrium tipping_;
};

TEST_F(TippingGuardTest, LetsTheHeadTurnWithAnyErrorOfTheInertialUnit) {
  for (const double x : {-1.5, -1.0, -0.6, 0.0, 0.6, 1.0, 1.5}) {
    for (const double y : {-1.5, -0.6, 0.0, 0.6, 1.5}) {
      if (std::hypot(x, y) > 1.9) continue;
      const Eigen::Vector3d up = up_with_error(stand_, x * kDegree, y * kDegree);
      for (const double yaw : {-2.0, 2.0}) {
        EXPECT_EQ(guard_.find_safe_fraction(stand_, turned("HeadYaw", yaw), up, tipping_), 1)
            << "up is wrong by " << x << " and " << y << " degrees; yaw " << yaw;
      }
    }
  }
}

TEST_F(TippingGuardTest, StopsALegThatWouldTipTheRobotWithAnyErrorOfTheInertialUnit) {
  for (const double error : {-1.5, 0.0, 1.5}) {
    const Eigen::Vector3d up = up_with_error(stand_, 0, error * kDegree);
    EXPECT_LT(guard_.find_safe_fraction(stand_, turned("LAnklePitch", 0.6), up, tipping_), 1);
    EXPECT_LT(guard_.find_safe_fraction(stand_, turned("LKneePitch", 1.8), up, tipping_), 1);
  }
}

TEST_F(TippingGuardTest, TakesTheMeasurementOfARobotThatLeansFar) {
  const Eigen::Vector3d up = up_with_error(stand_, 5 * kDegree, 0);
  EXPECT_EQ(guard_.find_support_normal(stand_, up), up);
}

}  // namespace
}  // namespace nao::motion

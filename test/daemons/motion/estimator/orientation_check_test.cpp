#include "daemons/motion/estimator/orientation_check.h"

#include <gtest/gtest.h>

namespace nao::motion {
namespace {

Eigen::Quaterniond tilted(double degrees, double heading = 0) {
  return Eigen::AngleAxisd(heading, Eigen::Vector3d::UnitZ()) *
         Eigen::Quaterniond(Eigen::AngleAxisd(degrees * kDegree, Eigen::Vector3d::UnitY()));
}

double after(OrientationCheck& check, double degrees, double seconds) {
  for (double time = 0; time < seconds; time += 0.01) {
    check.update(tilted(degrees, 2), tilted(0), 0.01);
  }
  return check.doubt();
}

TEST(OrientationCheck, DoubtsADifferenceOfMoreThanFiveDegreesForASecond) {
  OrientationCheck check;
  EXPECT_EQ(after(check, 4.9, 10), 0);
  EXPECT_EQ(after(check, 6, 0.9), 0);
  EXPECT_EQ(after(check, 4, 0.1), 0);
  EXPECT_EQ(after(check, 6, 0.9), 0);
  EXPECT_NEAR(after(check, 6, 0.2), 6 * kDegree, 1e-9);
}

TEST(OrientationCheck, TrustsAgainAfterASecondOfAgreement) {
  OrientationCheck check;
  EXPECT_GT(after(check, 20, 1.1), 0);
  EXPECT_GT(after(check, 1, 0.9), 0);
  EXPECT_EQ(after(check, 1, 0.2), 0);
}

}  // namespace
}  // namespace nao::motion

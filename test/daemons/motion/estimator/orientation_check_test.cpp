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
  EXPECT_EQ(after(check, 0, 10), 0);
  EXPECT_EQ(after(check, 8, 0.9), 0);
  EXPECT_EQ(after(check, 0, 0.1), 0);
  EXPECT_EQ(after(check, 8, 0.9), 0);
  EXPECT_GT(after(check, 8, 0.2), 5 * kDegree);
  // As long as it lasts.
  EXPECT_GT(after(check, 8, 60), 5 * kDegree);
}

TEST(OrientationCheck, TrustsAgainAfterASecondOfAgreement) {
  OrientationCheck check;
  EXPECT_GT(after(check, 20, 1.1), 0);
  EXPECT_GT(after(check, 1, 0.9), 0);
  EXPECT_EQ(after(check, 1, 0.2), 0);
}

TEST(OrientationCheck, IgnoresASlowDrift) {
  OrientationCheck check;
  for (double degrees = 0; degrees < 10; degrees += 0.1) EXPECT_EQ(after(check, degrees, 0.3), 0);
}

TEST(OrientationCheck, StartsAnewAfterAFall) {
  OrientationCheck check;
  for (int i = 0; i < 10; ++i) check.update(tilted(90), tilted(75), 0.01);
  EXPECT_EQ(after(check, 15, 5), 0);
}

}  // namespace
}  // namespace nao::motion

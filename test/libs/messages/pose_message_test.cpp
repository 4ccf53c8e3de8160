#include "messages/pose_message.h"

#include <gtest/gtest.h>

#include <cmath>

#include "common/error.h"

namespace nao {
namespace {

TEST(PoseMessage, IsReadOrRejected) {
  const double position[3] = {1, 2, 3};
  const double quarter[4] = {std::sqrt(0.5), 0, 0, std::sqrt(0.5)};
  const Eigen::Isometry3d pose = decode_pose(position, quarter);
  EXPECT_LT((pose * Eigen::Vector3d(1, 0, 0) - Eigen::Vector3d(1, 3, 3)).norm(), 1e-12);
  const double not_finite[3] = {1, NAN, 3};
  EXPECT_THROW(decode_pose(not_finite, quarter), Error);
  const double zero[4] = {0, 0, 0, 0};
  EXPECT_THROW(decode_pose(position, zero), Error);
  const double nan_norm[4] = {NAN, 0, 0, 1};
  EXPECT_THROW(decode_pose(position, nan_norm), Error);
}

}  // namespace
}  // namespace nao

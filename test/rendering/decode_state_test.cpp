#include "rendering/decode_state.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "common/data_path.h"
#include "common/error.h"

namespace nao {
namespace {

class DecodeState : public testing::Test {
 protected:
  const RobotModel model_ = RobotModel::load(data_path() / "robots" / "nao");
};

TEST_F(DecodeState, PutsPositionsIntoMotorOrder) {
  const auto decoded = decode_positions(model_, {"HeadPitch", "HeadYaw"}, {0.2, -0.4});
  ASSERT_EQ(decoded.size(), static_cast<size_t>(model_.num_motors()));
  EXPECT_EQ(decoded[model_.find_motor("HeadPitch")], 0.2);
  EXPECT_EQ(decoded[model_.find_motor("HeadYaw")], -0.4);
}

TEST_F(DecodeState, ReportsTheFault) {
  const auto reason = [&](const std::vector<std::string>& names,
                          const std::vector<double>& position) -> std::string {
    try {
      decode_positions(model_, names, position);
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_THAT(reason({"Tail"}, {0}), testing::HasSubstr("Tail"));
  EXPECT_THAT(reason({"HeadYaw"}, {NAN}), testing::HasSubstr("HeadYaw"));
  EXPECT_THAT(reason({"HeadYaw"}, {INFINITY}), testing::HasSubstr("HeadYaw"));
  EXPECT_THAT(reason({"HeadYaw", "HeadPitch"}, {0}), testing::HasSubstr("2"));
  EXPECT_NE(reason({"HeadYaw", "HeadYaw"}, {0, 0}), "");
  // A mimic joint, which has no motor: messages do not list it.
  EXPECT_THAT(reason({"RHipYawPitch"}, {0}), testing::HasSubstr("RHipYawPitch"));
}

TEST_F(DecodeState, ReadsAPoseAndRejectsAnInvalidOne) {
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

#include "rendering/decode_state.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <naolcm/world_truth_t.hpp>

#include "common/data_path.h"
#include "common/error.h"

namespace nao {
namespace {

class DecodeState : public testing::Test {
 protected:
  const RobotModel model_ = RobotModel::load(data_path() / "robots" / "nao");
  RobotModels models_{model_};
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

TEST_F(DecodeState, ReadsTheLightsThatAreLit) {
  naolcm::world_truth_t truth{};
  truth.robots.resize(1);
  naolcm::robot_truth_t& robot = truth.robots[0];
  robot.orientation_torso_in_world[0] = 1;
  robot.light_names = {"chest", "skull"};
  robot.light_rgb = {{1, 0.5, 0}, {0, 0, 0}};
  const std::vector<LitLight> lights = decode_truth(models_, truth).robots.at(0).lights;
  ASSERT_EQ(lights.size(), 1u);
  EXPECT_EQ(lights[0].name, "chest");
  EXPECT_EQ(lights[0].rgb, Eigen::Vector3f(1, 0.5, 0));
  robot.light_rgb[1][2] = NAN;
  EXPECT_THROW(decode_truth(models_, truth), Error);
}

TEST_F(DecodeState, ReadsEachRobotByItsOwnModelAndItsTeam) {
  naolcm::world_truth_t truth{};
  truth.robots.resize(2);
  truth.robots[0].orientation_torso_in_world[0] = 1;
  truth.robots[0].model = "nao";
  truth.robots[1].orientation_torso_in_world[0] = 1;
  truth.robots[1].model = "t1";
  truth.robots[1].team = 1;
  truth.robots[1].number = 4;
  const WorldState state = decode_truth(models_, truth);
  EXPECT_EQ(state.robots[0].model, nullptr) << "the own one";
  ASSERT_NE(state.robots[1].model, nullptr);
  EXPECT_EQ(state.robots[1].position.size(),
            static_cast<size_t>(state.robots[1].model->num_motors()));
  EXPECT_NE(state.robots[1].position.size(), state.robots[0].position.size());
  EXPECT_EQ(state.robots[1].team, 1);
  EXPECT_EQ(state.robots[1].number, 4);
  EXPECT_EQ(decode_truth(models_, truth).robots[1].model, state.robots[1].model) << "loaded once";
  for (const char* name : {"r2d2", "../robots/t1", ".."}) {
    truth.robots[1].model = name;
    EXPECT_THROW(decode_truth(models_, truth), Error) << name;
  }
}

}  // namespace
}  // namespace nao

#include "daemons/play/play_parameters.h"

#include <gtest/gtest.h>

#include <fstream>

#include "common/error.h"

namespace nao::play {
namespace {

class PlayParametersTest : public testing::Test {
 protected:
  PlayParameters load(const std::string& robot_text) {
    const std::filesystem::path file = testing::TempDir() + "play_parameters_test.yaml";
    std::ofstream(file) << robot_text;
    return PlayParameters::load(file);
  }

  std::string error_of(const std::string& robot_text) {
    try {
      (void)load(robot_text);
    } catch (const ModelError& error) {
      return error.what();
    }
    return "";
  }
};

TEST_F(PlayParametersTest, OfARobotReplaceSingleOnes) {
  const PlayParameters common = PlayParameters::load("");
  EXPECT_GT(common.shot_aim.kick_distance, 0);
  const PlayParameters own = load("shot_aim: {kick_distance: 2.5}");
  EXPECT_EQ(own.shot_aim.kick_distance, 2.5);
  EXPECT_EQ(own.shot_aim.post_margin, common.shot_aim.post_margin);
}

TEST_F(PlayParametersTest, AreRefusedWithTheirPlace) {
  EXPECT_NE(error_of("shot_aim:\n  kick_distanc: 2").find(":2: shot_aim.kick_distanc is unknown"),
            std::string::npos);
  EXPECT_NE(error_of("keeper: {out: -1}").find("keeper.out"), std::string::npos);
  EXPECT_NE(error_of("keeper: {out: .nan}").find("keeper.out"), std::string::npos);
  EXPECT_NE(error_of("keeper: 3").find("keeper"), std::string::npos);
}

}  // namespace
}  // namespace nao::play

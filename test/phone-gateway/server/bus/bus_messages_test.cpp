#include "phone-gateway/server/bus/bus_messages.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "common/error.h"
#include "test/phone-gateway/server/core/test_robot.h"

namespace nao::gateway {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

naolcm::robot_state_t make_state() {
  naolcm::robot_state_t state{};
  state.utime = 5;
  state.num_joints = 4;
  state.joint_names = {"LHand", "HeadPitch", "LShoulderRoll", "HeadYaw"};
  state.joint_position = {4, 2, 3, 1};
  state.orientation_torso_in_odometry[0] = 1;
  state.position_torso_in_odometry[2] = 0.3;
  return state;
}

TEST(RobotStateReader, PutsJointsInTheOrderOfTheDescription) {
  const RobotStateReader reader(make_test_robot());
  const RobotSnapshot robot = reader.read(make_state());
  EXPECT_EQ(robot.joint_position, (std::vector<double>{1, 2, 3, 4}));
  EXPECT_EQ(robot.torso_position[2], 0.3);
}

TEST(RobotStateReader, RefusesUnknownJointsAndNumbersThatAreNotFinite) {
  const RobotStateReader reader(make_test_robot());
  auto unknown = make_state();
  unknown.joint_names[0] = "Tail";
  EXPECT_THROW((void)reader.read(unknown), Error);
  auto broken = make_state();
  broken.joint_position[2] = kNaN;
  EXPECT_THROW((void)reader.read(broken), Error);
  auto twisted = make_state();
  twisted.orientation_torso_in_odometry[1] = kNaN;
  EXPECT_THROW((void)reader.read(twisted), Error);
}

TEST(RobotStateReader, RefusesARepeatedJointThatHidesAMissingOne) {
  const RobotStateReader reader(make_test_robot());
  auto repeated = make_state();
  repeated.joint_names = {"LHand", "LHand", "LShoulderRoll", "HeadYaw"};
  EXPECT_THROW((void)reader.read(repeated), Error) << "HeadPitch would be 0";
  auto missing = make_state();
  missing.num_joints = 3;
  missing.joint_names.resize(3);
  missing.joint_position.resize(3);
  EXPECT_THROW((void)reader.read(missing), Error);
}

TEST(ReadMotionState, WritesAnOpenEndAsNegativeProgress) {
  naolcm::motion_state_t motion{};
  motion.mode = motion.MODE_WALKING;
  motion.command_kind = motion.COMMAND_KIND_WALK;
  motion.command_progress = kNaN;
  EXPECT_LT(read_motion_state(motion).progress, 0);
  EXPECT_EQ(read_motion_state(motion).activity->kind(), naoremote::COMMAND_KIND_WALK);
  motion.command_kind = motion.COMMAND_KIND_POSTURE;
  motion.command_name = "Crouch";
  motion.command_progress = 0.5;
  EXPECT_EQ(read_motion_state(motion).progress, 0.5);
  motion.stiffness = kNaN;
  EXPECT_THROW((void)read_motion_state(motion), Error);
}

TEST(ReadMotionState, HasTheKindAndNameOfTheActivity) {
  naolcm::motion_state_t motion{};
  motion.mode = motion.MODE_HOLDING;
  motion.command_kind = motion.COMMAND_KIND_NONE;
  EXPECT_FALSE(read_motion_state(motion).activity.has_value());
  motion.command_name = "get-up";
  EXPECT_EQ(read_motion_state(motion).activity->kind(), naoremote::COMMAND_KIND_NONE);
  EXPECT_EQ(read_motion_state(motion).activity->name(), "get-up");
  motion.command_kind = motion.COMMAND_KIND_STOP;
  EXPECT_EQ(read_motion_state(motion).activity->kind(), naoremote::COMMAND_KIND_STOP);
  motion.needs_help = 1;
  EXPECT_TRUE(read_motion_state(motion).activity->needs_help());
}

TEST(ReadMotionState, RefusesUnknownModesAndKinds) {
  naolcm::motion_state_t motion{};
  motion.mode = motion.MODE_NO_ROBOT + 1;
  EXPECT_THROW((void)read_motion_state(motion), Error);
  motion.mode = motion.MODE_HOLDING;
  motion.command_kind = motion.COMMAND_KIND_STOP + 1;
  EXPECT_THROW((void)read_motion_state(motion), Error);
}

TEST(ReadImage, TakesJpegsOnly) {
  naolcm::image_t image{};
  image.camera = "bottom";
  image.width = 320;
  image.height = 240;
  image.format = "jpeg";
  image.size_bytes = 3;
  image.data = {1, 2, 3};
  EXPECT_EQ(read_image(image).camera, "bottom");
  EXPECT_EQ(read_image(image).jpeg, "\1\2\3");
  image.format = "png";
  EXPECT_THROW((void)read_image(image), Error);
}

TEST(ReadResult, ForwardsTheReasonWithItsArguments) {
  naolcm::command_result_t message{};
  message.source = "phone.1.2";
  message.command_id = 7;
  message.command_kind = message.COMMAND_KIND_POSTURE;
  message.status = message.STATUS_REFUSED;
  message.reason_code = "no-path";
  message.num_reason_arguments = 2;
  message.reason_arguments = {"Sit", "Stand"};
  message.reason = "There is no path.";
  const CommandResult result = read_result(message);
  EXPECT_EQ(result.id, 7);
  EXPECT_EQ(result.kind, CommandKind::kPosture);
  EXPECT_EQ(result.status, ResultStatus::kRefused);
  EXPECT_EQ(result.reason.code, "no-path");
  EXPECT_EQ(result.reason.arguments, (std::vector<std::string>{"Sit", "Stand"}));
  EXPECT_EQ(result.sentence, "There is no path.");
  message.status = message.STATUS_FAILED + 1;
  EXPECT_THROW((void)read_result(message), Error);
}

TEST(ReadLights, PutsThemInTheOrderOfTheDescription) {
  naolcm::body_state_t body{};
  body.light_names = {"chest", "skull", "left-eye"};
  body.light_rgb = {{1, 0, 0}, {0, 1, 0}, {0, 0.2, 1}};
  EXPECT_EQ(read_lights(body, make_test_robot()), (std::vector<uint32_t>{0x0033ff, 0xff0000}));
  body.light_rgb[0][1] = kNaN;
  EXPECT_THROW(read_lights(body, make_test_robot()), Error);
  body.light_names.clear();
  body.light_rgb.clear();
  EXPECT_EQ(read_lights(body, make_test_robot()), (std::vector<uint32_t>{0, 0}));
}

TEST(ReadBody, PassesOnWhatIsKnownOfJointsOfTheDescription) {
  naolcm::body_state_t message{};
  message.battery_charge = kNaN;
  message.light_names = {"chest"};
  message.light_rgb = {{1, 0, 0}};
  EXPECT_FALSE(read_body(message, make_test_robot())) << "lights only, as of a simulated body";
  message.battery_charge = 0.2;
  const std::string joint = make_test_robot().joints(0).name();
  message.joint_names = {"Tail", joint};
  message.joint_temperature = {20, 81};
  message.joint_status = {naolcm::body_state_t::JOINT_STATUS_DEAD,
                          naolcm::body_state_t::JOINT_STATUS_HOT};
  message.warning_codes = {"battery-low", "joint-hot"};
  const auto body = read_body(message, make_test_robot());
  ASSERT_TRUE(body);
  EXPECT_FLOAT_EQ(body->battery_charge(), 0.2f);
  EXPECT_EQ(body->hottest_joint(), joint);
  EXPECT_FLOAT_EQ(body->hottest_temperature(), 81);
  EXPECT_EQ(body->warnings_size(), 2);
  ASSERT_EQ(body->faulty_joints_size(), 1);
  EXPECT_EQ(body->faulty_joints(0), joint);
}

TEST(ReadAudio, RefusesWhatPhonesCannotPlay) {
  naolcm::speech_audio_t audio{};
  audio.sample_rate = 22050;
  audio.format = "s16le";
  audio.data = {1, 2, 3, 4};
  audio.size_bytes = 4;
  EXPECT_EQ(read_audio(audio).samples, std::string("\x01\x02\x03\x04"));
  const auto refuses = [&audio](auto change) {
    naolcm::speech_audio_t changed = audio;
    change(changed);
    EXPECT_THROW((void)read_audio(changed), Error);
  };
  refuses([](auto& message) { message.format = "mp3"; });
  refuses([](auto& message) { message.size_bytes = 3; });
  refuses([](auto& message) { message.size_bytes = 1 << 20; });
  refuses([](auto& message) { message.sample_rate = 0; });
  refuses([](auto& message) { message.sample_rate = 1 << 30; });
  refuses([](auto& message) { message.first_sample = -1; });
}

naolcm::vision_state_t make_vision() {
  naolcm::vision_state_t message{};
  message.utime = 2000000;
  message.camera = "top";
  message.num_detections = 2;
  message.detections.resize(2);
  for (naolcm::detection_t& seen : message.detections) {
    std::fill_n(seen.line_px, 4, kNaN);
    std::fill_n(seen.end_in_heading, 2, kNaN);
    std::fill_n(seen.position_in_heading, 2, kNaN);
  }
  const double box[] = {160, 120, 320, 240};
  std::copy_n(box, 4, message.detections[0].box_px);
  message.detections[0].position_in_heading[0] = 1.5;
  message.detections[0].position_in_heading[1] = -0.5;
  message.detections[0].covariance[0][0] = 0.25;
  message.detections[1].kind = naolcm::detection_t::KIND_LINE;
  std::copy_n(box, 4, message.detections[1].line_px);
  return message;
}

TEST(ReadVision, GivesBoxesAsFractionsOfTheWidestImageOfItsTime) {
  ImageSizes sizes;
  naolcm::image_t image{};
  image.camera = "top";
  image.utime = 2000000;
  image.width = 320;
  image.height = 240;
  sizes.add(image);
  image.width = 640;
  image.height = 480;
  sizes.add(image);
  image.camera = "bottom";
  image.width = 160;
  sizes.add(image);
  const naoremote::Vision vision = read_vision(make_vision(), sizes);
  ASSERT_EQ(vision.detections_size(), 2);
  EXPECT_FLOAT_EQ(vision.detections(0).box(0), 0.25F);
  EXPECT_FLOAT_EQ(vision.detections(0).box(3), 0.5F);
  EXPECT_FLOAT_EQ(vision.detections(0).position(1), -0.5F);
  EXPECT_FLOAT_EQ(vision.detections(0).covariance(0), 0.25F);
  EXPECT_EQ(vision.detections(0).line_size(), 0);
  EXPECT_EQ(vision.detections(1).line_size(), 4);
  EXPECT_EQ(vision.detections(1).position_size(), 0);
  EXPECT_FALSE(vision.has_ball());
  EXPECT_FALSE(vision.has_field_pose());
}

TEST(ReadVision, HasBallAndPoseWhereTheyAreKnown) {
  naolcm::vision_state_t message = make_vision();
  message.has_ball = 1;
  message.ball_utime = 1500000;
  message.ball_position_in_odometry[0] = 2;
  message.has_field_pose = 1;
  message.torso_in_field[2] = 1.5;
  const naoremote::Vision vision = read_vision(message, {});
  EXPECT_EQ(vision.ball().x(), 2);
  EXPECT_NEAR(vision.ball().age(), 0.5, 1e-6);
  EXPECT_EQ(vision.field_pose().theta(), 1.5F);
  EXPECT_EQ(vision.field_pose().covariance_size(), 4);
}

TEST(ReadVision, RefusesWhatIsNotFiniteOrUnknown) {
  const auto refuses = [](auto change) {
    naolcm::vision_state_t message = make_vision();
    change(message);
    EXPECT_THROW((void)read_vision(message, {}), Error);
  };
  refuses([](auto& message) { message.image_status = 9; });
  refuses([](auto& message) { message.detections[0].kind = 99; });
  refuses([](auto& message) { message.detections[0].box_px[2] = kNaN; });
  refuses([](auto& message) {
    message.has_ball = 1;
    message.ball_velocity_in_odometry[1] = kNaN;
  });
}

TEST(ReadPlayState, HasATargetOnlyWhereThereIsOne) {
  naolcm::play_state_t message{};
  message.behavior = message.BEHAVIOR_SCORE;
  message.phase = message.PHASE_ALIGN;
  message.target_in_field[0] = kNaN;
  message.reason_code = "ball-not-in-sight";
  naoremote::PlayState state = read_play_state(message);
  EXPECT_EQ(state.behavior(), naoremote::Play::SCORE);
  EXPECT_EQ(state.phase(), naoremote::PlayState::ALIGN);
  EXPECT_FALSE(state.has_target_x());
  EXPECT_EQ(state.reason_code(), "ball-not-in-sight");
  message.target_in_field[0] = 4.5;
  state = read_play_state(message);
  EXPECT_EQ(state.target_x(), 4.5F);
  message.behavior = message.BEHAVIOR_AUTO;
  EXPECT_EQ(read_play_state(message).behavior(), naoremote::Play::NONE);
  EXPECT_TRUE(read_play_state(message).plays_match());
  message.phase = 77;
  EXPECT_THROW((void)read_play_state(message), Error);
}

TEST(MatchMessages, PlayersHaveATeamAndANumber) {
  MatchState state;
  state.players = {{"NAO2", 1, 3}};
  const std::vector<PlayerLabel> players = read_players(state);
  ASSERT_EQ(players.size(), 1u);
  EXPECT_EQ(players[0].robot, "NAO2");
  EXPECT_EQ(players[0].team, 1u);
  EXPECT_EQ(players[0].number, 3u);
}

TEST(MatchMessages, ClientsSeeScoreClockEventAndPenalties) {
  MatchState state;
  state.phase = MatchPhase::kPlaying;
  state.half = 2;
  state.time_left = 59.2;
  state.score = {2, 1};
  state.players = {{"NAO1", 0, 1},
                   {"NAO2", 1, 1, PlayRole::kNone, false, Penalty::kLeftField, 12.5}};
  state.event = {4, MatchEventKind::kGoal, 1, "", 7};
  const naoremote::Match match = read_match(state);
  EXPECT_EQ(match.phase(), naoremote::Match::PLAYING);
  EXPECT_EQ(match.half(), 2u);
  EXPECT_EQ(match.time_left(), 60u);
  EXPECT_EQ(match.score_0(), 2u);
  EXPECT_EQ(match.score_1(), 1u);
  EXPECT_EQ(match.event_id(), 4u);
  EXPECT_EQ(match.event(), naoremote::Match::GOAL);
  EXPECT_EQ(match.event_team(), 1u);
  ASSERT_EQ(match.penalties_size(), 1);
  EXPECT_EQ(match.penalties(0).robot(), "NAO2");
  EXPECT_EQ(match.penalties(0).time_left(), 13u);
  state.event = {5, MatchEventKind::kHalfEnd, -1, "", 8};
  EXPECT_FALSE(read_match(state).has_event_team());
}

}  // namespace
}  // namespace nao::gateway

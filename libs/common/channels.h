#pragma once

#include <string>

namespace nao {

/** Channels of the simulated world, of a match and of the programs; see lcmtypes/README.md. */
inline constexpr const char* kWorldTruthChannel = "WORLD_TRUTH";
inline constexpr const char* kWorldCommandChannel = "WORLD_COMMAND";
inline constexpr const char* kMatchStateChannel = "MATCH_STATE";
inline constexpr const char* kMatchCommandChannel = "MATCH_COMMAND";
inline constexpr const char* kMatchCommandResultChannel = "MATCH_COMMAND_RESULT";
inline constexpr const char* kDaemonStatusChannel = "DAEMON_STATUS";

/** Channels of one robot. Every name begins with the robot's name, so that several robots can share
 * a bus. */
struct RobotChannels {
  /** @param robot  Name of the robot, "NAO" by default: 1 to 20 of A-Z, 0-9 and '_'. */
  explicit RobotChannels(const std::string& robot = "NAO")
      : sensor_state(robot + "_SENSOR_STATE"),
        joint_command(robot + "_JOINT_COMMAND"),
        robot_state(robot + "_ROBOT_STATE"),
        policy_state(robot + "_POLICY_STATE"),
        motion_state(robot + "_MOTION_STATE"),
        walk_command(robot + "_WALK_COMMAND"),
        move_to_command(robot + "_MOVE_TO_COMMAND"),
        posture_command(robot + "_POSTURE_COMMAND"),
        joint_change_command(robot + "_JOINT_CHANGE_COMMAND"),
        action_command(robot + "_ACTION_COMMAND"),
        stop_command(robot + "_STOP_COMMAND"),
        command_result(robot + "_COMMAND_RESULT"),
        head_camera_image(robot + "_HEAD_CAMERA_IMAGE"),
        head_camera_command(robot + "_HEAD_CAMERA_COMMAND"),
        body_state(robot + "_BODY_STATE"),
        light_command(robot + "_LIGHT_COMMAND"),
        speech_command(robot + "_SPEECH_COMMAND"),
        speech_audio(robot + "_SPEECH_AUDIO"),
        vision_state(robot + "_VISION_STATE"),
        play_command(robot + "_PLAY_COMMAND"),
        play_state(robot + "_PLAY_STATE"),
        motion_file_command(robot + "_MOTION_FILE_COMMAND"),
        motion_file_result(robot + "_MOTION_FILE_RESULT"),
        keyframe_motion(robot + "_KEYFRAME_MOTION") {}

  std::string sensor_state;
  std::string joint_command;
  std::string robot_state;
  std::string policy_state;
  std::string motion_state;
  std::string walk_command;
  std::string move_to_command;
  std::string posture_command;
  std::string joint_change_command;
  std::string action_command;
  std::string stop_command;
  std::string command_result;
  std::string head_camera_image;
  std::string head_camera_command;
  std::string body_state;
  std::string light_command;
  std::string speech_command;
  std::string speech_audio;
  std::string vision_state;
  std::string play_command;
  std::string play_state;
  std::string motion_file_command;
  std::string motion_file_result;
  std::string keyframe_motion;
};

}  // namespace nao

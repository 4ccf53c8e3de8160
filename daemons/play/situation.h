#pragma once

#include <Eigen/Core>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "daemons/play/match_view.h"
#include "daemons/play/play_parameters.h"
#include "kinematics/pose2.h"
#include "messages/command.h"
#include "messages/play_command.h"
#include "robot_model/robot_description.h"

namespace nao::play {

/** A camera as it is turned now, seen from the ground: in the feet frame F, whose origin is the
 * middle between the soles on the ground, x along the torso's heading, y left, z up. */
struct CameraView {
  std::string name;
  /** m. */
  Eigen::Vector3d position_in_feet = Eigen::Vector3d::Zero();
  /** Direction of the optical axis, rad: to the left of x, and below the horizon. */
  double bearing = 0;
  double depression = 0;
};

/** The robot as it is now. */
struct RobotView {
  /** F in the odometry frame. */
  Pose2 feet_in_odometry;
  /** The torso's ground projection in the odometry frame. */
  Pose2 torso_in_odometry;
  /** Angles of the joints that turn the cameras, rad. */
  double head_yaw = 0;
  double head_pitch = 0;
  /** In the robot's order. */
  std::vector<CameraView> cameras;
};

/** The tracked ball, in the odometry frame. */
struct Ball {
  /** m, m/s. */
  Eigen::Vector2d position = Eigen::Vector2d::Zero();
  Eigen::Vector2d velocity = Eigen::Vector2d::Zero();
  /** Robot time at which it was last seen, s. */
  double seen_time = 0;
  bool is_rolling = false;
};

/** Output of perception. */
struct Vision {
  /** Robot time of the last image, s. */
  double time = -std::numeric_limits<double>::infinity();
  /** Its image_status, as of vision_state_t; 0: usable. */
  int image_status = 0;
  std::optional<Ball> ball{};
  /** Field frame in the odometry frame; nothing: not localised. Field frame: origin at the center,
   * x towards the opponent's goal, y left. */
  std::optional<Pose2> field_in_odometry{};
  /** Other robots in the last image, m, in the odometry frame. */
  std::vector<Eigen::Vector2d> robots{};
};

/** Lengths of the field that the behaviors need, m. */
struct Field {
  /** Distances between the centers of the goal lines, and of the side lines. */
  double length = 0;
  double width = 0;
  /** Inner width of a goal, and its depth behind the center of the goal line. */
  double goal_width = 0;
  double goal_depth = 0;
  /** Length and width of a goal area. */
  Eigen::Vector2d goal_area = Eigen::Vector2d::Zero();
  /** Radius of the center circle: opponents of a free kick keep away as far. */
  double circle_radius = 0;
  /** Length of a penalty area. */
  double penalty_area_length = 0;
};

/** Best place of the ball for the robot's kick, m, in F: ahead, and to the side of the kicking
 * foot. */
struct KickPlace {
  Eigen::Vector2d ball = Eigen::Vector2d::Zero();
  /** Greatest distance from there, ahead and sideways. */
  Eigen::Vector2d reach = Eigen::Vector2d::Zero();
};

/** Names of the robot's actions; empty where it has none. */
struct ActionNames {
  std::string kick_left;
  std::string kick_right;
  std::string block;
  std::string dive_left;
  std::string dive_right;
};

/** Constants of a behavior. */
struct PlayConstants {
  Field field;
  WalkLimits walk_limits;
  std::optional<KickPlace> kick{};
  ActionNames actions{};
  PlayParameters parameters{};
  /** The robot's pose in the field at the origin of its odometry, used until it is localised. */
  Pose2 start_in_field{};
};

/** Input of a behavior. */
struct Situation {
  /** Robot time, s. */
  double time = 0;
  RobotView robot;
  /** As last seen; a behavior decides how old it may be. */
  std::optional<Ball> ball{};
  Pose2 field_in_odometry;
  /** Other robots as seen recently or reported by teammates, m, in the odometry frame. */
  std::vector<Eigen::Vector2d> robots{};
  /** No motion is in progress, except perhaps that of the head. */
  bool is_still = false;
  /** An action that the behavior commanded is in progress. */
  bool is_performing = false;
  /** How that action ended, once. */
  std::optional<CommandResult> ended{};
  /** Nothing: there is no match. */
  std::optional<MatchView> match{};
};

/** Where the cameras look. */
struct Gaze {
  /** A point on the ground, m, in the odometry frame. */
  std::optional<Eigen::Vector2d> point{};
  /** Otherwise this direction, rad in F: to the left, and below the horizon, for the axis of the
   * camera of this index. */
  double bearing = 0;
  double depression = 0;
  size_t camera = 0;
};

/** Commands of a behavior in one step. */
struct Decision {
  PlayPhase phase = PlayPhase::kIdle;
  /** All zero: the robot stands. Ignored while an action is in progress. */
  WalkCommand walk{};
  /** An action that begins now. */
  std::optional<ActionCommand> action{};
  /** The robot walks on during the action, with `walk`. */
  bool walks_on = false;
  Gaze gaze{};
  /** Where the robot walks or the ball should go, m, in the odometry frame. */
  std::optional<Eigen::Vector2d> target{};
  /** Role, if the behavior has several. */
  std::optional<PlayRole> role{};
  /** The behavior has reached its goal, or (with a reason) cannot reach it. */
  bool is_done = false;
  bool has_failed = false;
  /** Why it waits or has ended. */
  Reason reason{};
};

/** A behavior: a state machine over commands, without clock and bus. */
class BehaviorMachine {
 public:
  virtual ~BehaviorMachine() = default;
  /** One step; called about 20 times a second. */
  virtual Decision step(const Situation& situation) = 0;
  /** The robot has fallen and stands again; actions in progress are not continued. */
  virtual void restart() = 0;
};

}  // namespace nao::play

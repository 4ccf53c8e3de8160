#pragma once

#include <filesystem>

namespace nao::play {

/** Places, distances and times of the behaviors: data/play/parameters.yaml, which states their
 * units, meaning and origin. Groups and members carry the file's keys. */
struct PlayParameters {
  /** Path of the feet to their place behind the ball. */
  struct Approach {
    double circle = 0;
    double least_lead = 0;
    double behind = 0;
    double far = 0;
    double position_gain = 0;
    double heading_gain = 0;
    double near_forward = 0;
    double near_sideways = 0;
    double limit_fraction = 0;
    double turn_fraction = 0;
  };
  /** Direction of a shot. */
  struct ShotAim {
    double kick_distance = 0;
    double least_tolerance = 0;
    double greatest_tolerance = 0;
    double direction_error = 0;
    double far_tolerance = 0;
    double post_margin = 0;
    double keeper_distance = 0;
    double keeper_half = 0;
    double keeper_out = 0;
    double equal_sides = 0;
    double blocking_distance = 0;
    double blocking_angle = 0;
    double past_tolerance = 0;
  };
  /** A ball in front of the walking feet. */
  struct BallInWalk {
    double push_reach = 0;
    double passing_goal_distance = 0;
    double shot_distance = 0;
    double contested_distance = 0;
    double passing_near = 0;
    double passing_far = 0;
    double passing_aside = 0;
    double passing_tolerance = 0;
    double passing_age = 0;
    double carry_to = 0;
    double carry_near = 0;
    double carry_aside = 0;
    double carry_tolerance = 0;
  };
  /** Prediction of a rolling ball. */
  struct RollingBall {
    double stopped_by_feet = 0;
    double shot_speed = 0;
    double foot_length = 0;
  };
  /** When sightings are a ball. */
  struct BallMemory {
    double confirmed = 0;
    double doubt = 0;
    double agreement = 0;
    double agreement_per_distance = 0;
  };
  /** Search for the ball. */
  struct BallSearch {
    double dwell = 0;
    double scan_depression = 0;
    double turn_rate = 0;
    double roam_time = 0;
    double reached = 0;
  };
  /** Choice of camera and head angles. */
  struct HeadControl {
    double hysteresis = 0;
    double pitch_cost = 0;
  };
  /** The goalkeeper. */
  struct Keeper {
    double look_for_ball = 0;
    double out = 0;
    double block_half = 0;
    double dive_reach = 0;
    double dive_time = 0;
    double block_time = 0;
    double wide_of_post = 0;
    double aside_speed = 0;
    double action_pause = 0;
  };
  /** Keeping a place. */
  struct Positioner {
    double in_place = 0;
    double out_of_place = 0;
    double turned = 0;
    double turned_away = 0;
    double search_duration = 0;
  };
  /** Other robots. */
  struct RobotMemory {
    double forget_robot_after = 0;
    double same_robot = 0;
    double stop_distance = 0;
    double free_distance = 0;
    double approach_gain = 0;
    double pass_speed = 0;
  };
  /** A player in a match. */
  struct AutoPlayer {
    double forget_ball = 0;
    double ball_moved = 0;
    double kick_off_wait = 0;
    double free_kick_room = 0;
    double behind_ball = 0;
    double beside_ball = 0;
    double ball_return = 0;
    double told_distance = 0;
    double clear_distance = 0;
    double cleared_distance = 0;
    double clear_zone = 0;
    double from_side_line = 0;
  };
  /** Going to the ball, kicking and dribbling it. */
  struct Striker {
    double forget_after = 0;
    double forget_after_near = 0;
    double near = 0;
    double search_timeout = 0;
    double stop_fraction = 0;
    double kick_fraction = 0;
    double settle_time = 0;
    double settle_timeout = 0;
    double strike_time = 0;
    double look_down = 0;
    double watch_time = 0;
    double passing_kick_distance = 0;
    double passing_speed = 0;
    double push_speed = 0;
    double target_reached = 0;
    double behind_line = 0;
    double tilt_error = 0;
    double camera_height = 0;
    double judge_distance = 0;
    double before_ball = 0;
    double landmark_period = 0;
    double landmark_time = 0;
    double landmark_distance = 0;
    double landmark_depression = 0;
  };

  Approach approach;
  ShotAim shot_aim;
  BallInWalk ball_in_walk;
  RollingBall rolling_ball;
  BallMemory ball_memory;
  BallSearch ball_search;
  HeadControl head_control;
  Keeper keeper;
  Positioner positioner;
  RobotMemory robot_memory;
  AutoPlayer auto_player;
  Striker striker;

  /** Reads data/play/parameters.yaml. @param robot_file  Replaces single values, if it exists.
   * @throws ModelError  if a file lacks a value that it must have, or has an unknown, negative or
   * non-finite one. */
  static PlayParameters load(const std::filesystem::path& robot_file);
};

}  // namespace nao::play

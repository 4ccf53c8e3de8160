#pragma once

#include <filesystem>

#include "common/parameter_group.h"

namespace nao::play {

/** Places, distances and times of the behaviors: data/play/parameters.yaml, which states their
 * units, meaning and origin. Groups and members carry the file's keys. */
struct PlayParameters {
  /** Path of the feet to their place behind the ball. */
  NAO_PARAMETER_GROUP(Approach, approach, circle, least_lead, behind, far, position_gain,
                      heading_gain, near_forward, near_sideways, limit_fraction, turn_fraction);
  /** Direction of a shot. */
  NAO_PARAMETER_GROUP(ShotAim, shot_aim, kick_distance, least_tolerance, greatest_tolerance,
                      direction_error, far_tolerance, post_margin, keeper_distance, keeper_half,
                      keeper_out, equal_sides, blocking_distance, blocking_angle, past_tolerance);
  /** A ball in front of the walking feet. */
  NAO_PARAMETER_GROUP(BallInWalk, ball_in_walk, push_reach, passing_goal_distance, shot_distance,
                      contested_distance, passing_near, passing_far, passing_aside,
                      passing_tolerance, passing_age, carry_to, carry_near, carry_aside,
                      carry_tolerance);
  /** Prediction of a rolling ball. */
  NAO_PARAMETER_GROUP(RollingBall, rolling_ball, stopped_by_feet, shot_speed, foot_length);
  /** When sightings are a ball. */
  NAO_PARAMETER_GROUP(BallMemory, ball_memory, confirmed, doubt, agreement, agreement_per_distance);
  /** Search for the ball. */
  NAO_PARAMETER_GROUP(BallSearch, ball_search, dwell, scan_depression, turn_rate, roam_time,
                      reached);
  /** Choice of camera and head angles. */
  NAO_PARAMETER_GROUP(HeadControl, head_control, hysteresis, pitch_cost);
  /** The goalkeeper. */
  NAO_PARAMETER_GROUP(Keeper, keeper, look_for_ball, out, block_half, dive_reach, dive_time,
                      block_time, wide_of_post, aside_speed, action_pause);
  /** Keeping a place. */
  NAO_PARAMETER_GROUP(Positioner, positioner, in_place, out_of_place, turned, turned_away,
                      search_duration);
  /** Other robots. */
  NAO_PARAMETER_GROUP(RobotMemory, robot_memory, forget_robot_after, same_robot, stop_distance,
                      free_distance, approach_gain, pass_speed);
  /** A player in a match. */
  NAO_PARAMETER_GROUP(AutoPlayer, auto_player, forget_ball, ball_moved, kick_off_wait,
                      free_kick_room, behind_ball, beside_ball, ball_return, told_distance,
                      clear_distance, cleared_distance, clear_zone, from_side_line);
  /** Going to the ball, kicking and dribbling it. */
  NAO_PARAMETER_GROUP(Striker, striker, forget_after, forget_after_near, near, search_timeout,
                      stop_fraction, kick_fraction, settle_time, settle_timeout, strike_time,
                      look_down, watch_time, passing_kick_distance, passing_speed, push_speed,
                      target_reached, behind_line, tilt_error, camera_height, judge_distance,
                      before_ball, landmark_period, landmark_time, landmark_distance,
                      landmark_depression);

  /** Reads data/play/parameters.yaml. @param robot_file  Replaces single values, if it exists.
   * @throws ModelError  if a file lacks a value that it must have, or has an unknown, negative or
   * non-finite one. */
  static PlayParameters load(const std::filesystem::path& robot_file);
};

}  // namespace nao::play

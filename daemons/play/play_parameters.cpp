#include "daemons/play/play_parameters.h"

#include "common/data_path.h"
#include "common/parameter_table.h"

namespace nao::play {
namespace {

// A parameter's name in the file is the name of its member: "approach.circle".
#define NAO_PLAY_PARAMETER(group, key) NAO_PARAMETER(PlayParameters, group, key)

const ParameterTable<PlayParameters>& all_parameters() {
  static const ParameterTable<PlayParameters> parameters = {
      NAO_PLAY_PARAMETER(approach, circle),
      NAO_PLAY_PARAMETER(approach, least_lead),
      NAO_PLAY_PARAMETER(approach, behind),
      NAO_PLAY_PARAMETER(approach, far),
      NAO_PLAY_PARAMETER(approach, position_gain),
      NAO_PLAY_PARAMETER(approach, heading_gain),
      NAO_PLAY_PARAMETER(approach, near_forward),
      NAO_PLAY_PARAMETER(approach, near_sideways),
      NAO_PLAY_PARAMETER(approach, limit_fraction),
      NAO_PLAY_PARAMETER(approach, turn_fraction),
      NAO_PLAY_PARAMETER(shot_aim, kick_distance),
      NAO_PLAY_PARAMETER(shot_aim, least_tolerance),
      NAO_PLAY_PARAMETER(shot_aim, greatest_tolerance),
      NAO_PLAY_PARAMETER(shot_aim, direction_error),
      NAO_PLAY_PARAMETER(shot_aim, far_tolerance),
      NAO_PLAY_PARAMETER(shot_aim, post_margin),
      NAO_PLAY_PARAMETER(shot_aim, keeper_distance),
      NAO_PLAY_PARAMETER(shot_aim, keeper_half),
      NAO_PLAY_PARAMETER(shot_aim, keeper_out),
      NAO_PLAY_PARAMETER(shot_aim, equal_sides),
      NAO_PLAY_PARAMETER(shot_aim, blocking_distance),
      NAO_PLAY_PARAMETER(shot_aim, blocking_angle),
      NAO_PLAY_PARAMETER(shot_aim, past_tolerance),
      NAO_PLAY_PARAMETER(ball_in_walk, push_reach),
      NAO_PLAY_PARAMETER(ball_in_walk, passing_goal_distance),
      NAO_PLAY_PARAMETER(ball_in_walk, shot_distance),
      NAO_PLAY_PARAMETER(ball_in_walk, contested_distance),
      NAO_PLAY_PARAMETER(ball_in_walk, passing_near),
      NAO_PLAY_PARAMETER(ball_in_walk, passing_far),
      NAO_PLAY_PARAMETER(ball_in_walk, passing_aside),
      NAO_PLAY_PARAMETER(ball_in_walk, passing_tolerance),
      NAO_PLAY_PARAMETER(ball_in_walk, passing_age),
      NAO_PLAY_PARAMETER(ball_in_walk, carry_to),
      NAO_PLAY_PARAMETER(ball_in_walk, carry_near),
      NAO_PLAY_PARAMETER(ball_in_walk, carry_aside),
      NAO_PLAY_PARAMETER(ball_in_walk, carry_tolerance),
      NAO_PLAY_PARAMETER(rolling_ball, stopped_by_feet),
      NAO_PLAY_PARAMETER(rolling_ball, shot_speed),
      NAO_PLAY_PARAMETER(rolling_ball, foot_length),
      NAO_PLAY_PARAMETER(ball_memory, confirmed),
      NAO_PLAY_PARAMETER(ball_memory, doubt),
      NAO_PLAY_PARAMETER(ball_memory, agreement),
      NAO_PLAY_PARAMETER(ball_memory, agreement_per_distance),
      NAO_PLAY_PARAMETER(ball_search, dwell),
      NAO_PLAY_PARAMETER(ball_search, scan_depression),
      NAO_PLAY_PARAMETER(ball_search, turn_rate),
      NAO_PLAY_PARAMETER(ball_search, roam_time),
      NAO_PLAY_PARAMETER(ball_search, reached),
      NAO_PLAY_PARAMETER(head_control, hysteresis),
      NAO_PLAY_PARAMETER(head_control, pitch_cost),
      NAO_PLAY_PARAMETER(keeper, look_for_ball),
      NAO_PLAY_PARAMETER(keeper, out),
      NAO_PLAY_PARAMETER(keeper, block_half),
      NAO_PLAY_PARAMETER(keeper, dive_reach),
      NAO_PLAY_PARAMETER(keeper, dive_time),
      NAO_PLAY_PARAMETER(keeper, block_time),
      NAO_PLAY_PARAMETER(keeper, wide_of_post),
      NAO_PLAY_PARAMETER(keeper, aside_speed),
      NAO_PLAY_PARAMETER(keeper, action_pause),
      NAO_PLAY_PARAMETER(positioner, in_place),
      NAO_PLAY_PARAMETER(positioner, out_of_place),
      NAO_PLAY_PARAMETER(positioner, turned),
      NAO_PLAY_PARAMETER(positioner, turned_away),
      NAO_PLAY_PARAMETER(positioner, search_duration),
      NAO_PLAY_PARAMETER(robot_memory, forget_robot_after),
      NAO_PLAY_PARAMETER(robot_memory, same_robot),
      NAO_PLAY_PARAMETER(robot_memory, stop_distance),
      NAO_PLAY_PARAMETER(robot_memory, free_distance),
      NAO_PLAY_PARAMETER(robot_memory, approach_gain),
      NAO_PLAY_PARAMETER(robot_memory, pass_speed),
      NAO_PLAY_PARAMETER(auto_player, forget_ball),
      NAO_PLAY_PARAMETER(auto_player, ball_moved),
      NAO_PLAY_PARAMETER(auto_player, kick_off_wait),
      NAO_PLAY_PARAMETER(auto_player, free_kick_room),
      NAO_PLAY_PARAMETER(auto_player, behind_ball),
      NAO_PLAY_PARAMETER(auto_player, beside_ball),
      NAO_PLAY_PARAMETER(auto_player, ball_return),
      NAO_PLAY_PARAMETER(auto_player, told_distance),
      NAO_PLAY_PARAMETER(auto_player, clear_distance),
      NAO_PLAY_PARAMETER(auto_player, cleared_distance),
      NAO_PLAY_PARAMETER(auto_player, clear_zone),
      NAO_PLAY_PARAMETER(auto_player, from_side_line),
      NAO_PLAY_PARAMETER(striker, forget_after),
      NAO_PLAY_PARAMETER(striker, forget_after_near),
      NAO_PLAY_PARAMETER(striker, near),
      NAO_PLAY_PARAMETER(striker, search_timeout),
      NAO_PLAY_PARAMETER(striker, stop_fraction),
      NAO_PLAY_PARAMETER(striker, kick_fraction),
      NAO_PLAY_PARAMETER(striker, settle_time),
      NAO_PLAY_PARAMETER(striker, settle_timeout),
      NAO_PLAY_PARAMETER(striker, strike_time),
      NAO_PLAY_PARAMETER(striker, look_down),
      NAO_PLAY_PARAMETER(striker, watch_time),
      NAO_PLAY_PARAMETER(striker, passing_kick_distance),
      NAO_PLAY_PARAMETER(striker, passing_speed),
      NAO_PLAY_PARAMETER(striker, push_speed),
      NAO_PLAY_PARAMETER(striker, target_reached),
      NAO_PLAY_PARAMETER(striker, behind_line),
      NAO_PLAY_PARAMETER(striker, tilt_error),
      NAO_PLAY_PARAMETER(striker, camera_height),
      NAO_PLAY_PARAMETER(striker, judge_distance),
      NAO_PLAY_PARAMETER(striker, before_ball),
      NAO_PLAY_PARAMETER(striker, landmark_period),
      NAO_PLAY_PARAMETER(striker, landmark_time),
      NAO_PLAY_PARAMETER(striker, landmark_distance),
      NAO_PLAY_PARAMETER(striker, landmark_depression),
  };
  return parameters;
}

#undef NAO_PLAY_PARAMETER

}  // namespace

PlayParameters PlayParameters::load(const std::filesystem::path& robot_file) {
  return load_parameters(data_path() / "play" / "parameters.yaml", robot_file, all_parameters());
}

}  // namespace nao::play

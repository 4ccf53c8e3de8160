#include "daemons/vision/vision_parameters.h"

#include "common/data_path.h"
#include "common/parameter_table.h"

namespace nao::vision {
namespace {

// A parameter's name in the file is the name of its member: "ball_filter.gate".
#define NAO_VISION_PARAMETER(group, key) NAO_PARAMETER(VisionParameters, group, key)

const ParameterTable<VisionParameters>& all_parameters() {
  static const ParameterTable<VisionParameters> parameters = {
      NAO_VISION_PARAMETER(field_detector, least_threshold),
      NAO_VISION_PARAMETER(field_detector, greatest_threshold),
      NAO_VISION_PARAMETER(field_detector, greatest_fraction),
      NAO_VISION_PARAMETER(line_points, contrast),
      NAO_VISION_PARAMETER(line_points, index_fraction),
      NAO_VISION_PARAMETER(line_points, drop),
      NAO_VISION_PARAMETER(line_detector, tolerance),
      NAO_VISION_PARAMETER(line_detector, tolerance_of_width),
      NAO_VISION_PARAMETER(line_detector, largest_gap),
      NAO_VISION_PARAMETER(line_detector, least_length),
      NAO_VISION_PARAMETER(line_detector, least_density),
      NAO_VISION_PARAMETER(line_detector, least_ground_width),
      NAO_VISION_PARAMETER(line_detector, most_ground_width),
      NAO_VISION_PARAMETER(crossing_detector, least_ground_angle),
      NAO_VISION_PARAMETER(crossing_detector, least_image_angle),
      NAO_VISION_PARAMETER(crossing_detector, reach),
      NAO_VISION_PARAMETER(crossing_detector, inside),
      NAO_VISION_PARAMETER(crossing_detector, reach_in_widths),
      NAO_VISION_PARAMETER(center_circle, tolerance),
      NAO_VISION_PARAMETER(center_circle, tolerance_of_distance),
      NAO_VISION_PARAMETER(center_circle, reach),
      NAO_VISION_PARAMETER(center_circle, most_residual),
      NAO_VISION_PARAMETER(field_observation, reach),
      NAO_VISION_PARAMETER(field_observation, least_length),
      NAO_VISION_PARAMETER(field_observation, post_reach),
      NAO_VISION_PARAMETER(image_status, uniform_deviation),
      NAO_VISION_PARAMETER(image_status, dark_mean),
      NAO_VISION_PARAMETER(image_status, white_level),
      NAO_VISION_PARAMETER(image_status, white_fraction),
      NAO_VISION_PARAMETER(image_status, green),
      NAO_VISION_PARAMETER(image_status, frozen_time),
      NAO_VISION_PARAMETER(image_status, frozen_distance),
      NAO_VISION_PARAMETER(image_status, frozen_angle),
      NAO_VISION_PARAMETER(ball_filter, acceleration_density),
      NAO_VISION_PARAMETER(ball_filter, velocity_sigma),
      NAO_VISION_PARAMETER(ball_filter, gate),
      NAO_VISION_PARAMETER(ball_filter, surprise),
      NAO_VISION_PARAMETER(ball_filter, kick_time),
      NAO_VISION_PARAMETER(ball_filter, agreement),
      NAO_VISION_PARAMETER(ball_filter, forget_time),
      NAO_VISION_PARAMETER(ball_filter, rolling_speed),
      NAO_VISION_PARAMETER(ball_filter, rolling_sigmas),
      NAO_VISION_PARAMETER(pose_filter, position_per_way),
      NAO_VISION_PARAMETER(pose_filter, position_per_turn),
      NAO_VISION_PARAMETER(pose_filter, heading_per_way),
      NAO_VISION_PARAMETER(pose_filter, heading_per_turn),
      NAO_VISION_PARAMETER(pose_filter, heading_per_time),
      NAO_VISION_PARAMETER(pose_filter, position_per_time),
      NAO_VISION_PARAMETER(pose_filter, tilt_sigma),
      NAO_VISION_PARAMETER(pose_filter, tilt_time),
      NAO_VISION_PARAMETER(pose_filter, tilt_noise),
      NAO_VISION_PARAMETER(pose_filter, pixel_sigma),
      NAO_VISION_PARAMETER(pose_filter, line_sigma),
      NAO_VISION_PARAMETER(pose_filter, circle_sigma),
      NAO_VISION_PARAMETER(pose_filter, circle_sigma_per_distance),
      NAO_VISION_PARAMETER(pose_filter, post_distance_sigma),
      NAO_VISION_PARAMETER(pose_filter, post_side_sigma),
      NAO_VISION_PARAMETER(pose_filter, gate),
      NAO_VISION_PARAMETER(pose_filter, unique),
      NAO_VISION_PARAMETER(pose_filter, most_angle),
      NAO_VISION_PARAMETER(pose_filter, beyond),
      NAO_VISION_PARAMETER(pose_filter, beyond_per_distance),
      NAO_VISION_PARAMETER(pose_filter, most_chord),
      NAO_VISION_PARAMETER(pose_search, tolerance),
      NAO_VISION_PARAMETER(pose_search, tolerance_of_distance),
      NAO_VISION_PARAMETER(pose_search, most_line_angle),
      NAO_VISION_PARAMETER(pose_search, beyond_end),
      NAO_VISION_PARAMETER(pose_search, circle_weight),
      NAO_VISION_PARAMETER(pose_search, most_length),
      NAO_VISION_PARAMETER(pose_search, least_crossing),
      NAO_VISION_PARAMETER(pose_search, least_pair_length),
      NAO_VISION_PARAMETER(pose_search, same_position),
      NAO_VISION_PARAMETER(pose_search, same_heading),
      NAO_VISION_PARAMETER(pose_search, common_tilt_sigma),
      NAO_VISION_PARAMETER(pose_search, least_score),
      NAO_VISION_PARAMETER(pose_search, margin),
      NAO_VISION_PARAMETER(pose_search, most_turn),
      NAO_VISION_PARAMETER(localizer, start_position),
      NAO_VISION_PARAMETER(localizer, start_heading),
      NAO_VISION_PARAMETER(localizer, jump_distance),
      NAO_VISION_PARAMETER(localizer, jump_speed),
      NAO_VISION_PARAMETER(localizer, jump_position),
      NAO_VISION_PARAMETER(localizer, jump_heading),
      NAO_VISION_PARAMETER(localizer, fall_position),
      NAO_VISION_PARAMETER(localizer, fall_heading),
      NAO_VISION_PARAMETER(localizer, found_position),
      NAO_VISION_PARAMETER(localizer, found_heading),
      NAO_VISION_PARAMETER(localizer, keep_period),
      NAO_VISION_PARAMETER(localizer, least_used_length),
      NAO_VISION_PARAMETER(localizer, misfit_score),
      NAO_VISION_PARAMETER(localizer, good_score),
      NAO_VISION_PARAMETER(localizer, tilt_gain),
      NAO_VISION_PARAMETER(localizer, better),
      NAO_VISION_PARAMETER(localizer, lost_search_period),
      NAO_VISION_PARAMETER(localizer, search_period),
  };
  return parameters;
}

#undef NAO_VISION_PARAMETER

}  // namespace

VisionParameters VisionParameters::load(const std::filesystem::path& robot_file) {
  return load_parameters(data_path() / "vision" / "parameters.yaml", robot_file, all_parameters());
}

}  // namespace nao::vision

#pragma once

#include <filesystem>

#include "common/parameter_group.h"

namespace nao::vision {

/** Thresholds, tolerances and standard deviations of what is seen: data/vision/parameters.yaml,
 * which states their units, meaning and origin. Groups and members carry the file's keys. */
struct VisionParameters {
  /** The color of the field. */
  NAO_PARAMETER_GROUP(FieldDetector, field_detector, least_threshold, greatest_threshold,
                      greatest_fraction);
  /** Points of lines. */
  NAO_PARAMETER_GROUP(LinePoints, line_points, contrast, index_fraction, drop);
  /** Segments of lines. */
  NAO_PARAMETER_GROUP(LineDetector, line_detector, tolerance, tolerance_of_width, largest_gap,
                      least_length, least_density, least_ground_width, most_ground_width);
  /** Crossings of lines. */
  NAO_PARAMETER_GROUP(CrossingDetector, crossing_detector, least_ground_angle, least_image_angle,
                      reach, inside, reach_in_widths);
  /** The center circle. */
  NAO_PARAMETER_GROUP(CenterCircle, center_circle, tolerance, tolerance_of_distance, reach,
                      most_residual);
  /** What serves localisation. */
  NAO_PARAMETER_GROUP(FieldObservation, field_observation, reach, least_length, post_reach);
  /** Faults of images. */
  NAO_PARAMETER_GROUP(ImageStatus, image_status, uniform_deviation, dark_mean, white_level,
                      white_fraction, green, frozen_time, frozen_distance, frozen_angle);
  /** The tracked ball. */
  NAO_PARAMETER_GROUP(BallFilter, ball_filter, acceleration_density, velocity_sigma, gate, surprise,
                      kick_time, agreement, forget_time, rolling_speed, rolling_sigmas);
  /** The tracked pose. */
  NAO_PARAMETER_GROUP(PoseFilter, pose_filter, position_per_way, position_per_turn, heading_per_way,
                      heading_per_turn, heading_per_time, position_per_time, tilt_sigma, tilt_time,
                      tilt_noise, pixel_sigma, line_sigma, circle_sigma, circle_sigma_per_distance,
                      post_distance_sigma, post_side_sigma, gate, unique, most_angle, beyond,
                      beyond_per_distance, most_chord);
  /** A pose without a prior position. */
  NAO_PARAMETER_GROUP(PoseSearch, pose_search, tolerance, tolerance_of_distance, most_line_angle,
                      beyond_end, circle_weight, most_length, least_crossing, least_pair_length,
                      same_position, same_heading, common_tilt_sigma, least_score, margin,
                      most_turn);
  /** When the pose is known. */
  NAO_PARAMETER_GROUP(Localizer, localizer, start_position, start_heading, jump_distance,
                      jump_speed, jump_position, jump_heading, fall_position, fall_heading,
                      found_position, found_heading, keep_period, least_used_length, misfit_score,
                      good_score, tilt_gain, better, lost_search_period, search_period);

  /** Reads data/vision/parameters.yaml. @param robot_file  Replaces single values, if it exists.
   * @throws ModelError  if a file lacks a value that it must have, or has an unknown, negative or
   * non-finite one. */
  static VisionParameters load(const std::filesystem::path& robot_file = {});
};

}  // namespace nao::vision

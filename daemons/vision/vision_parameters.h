#pragma once

#include <filesystem>

namespace nao::vision {

/** Thresholds, tolerances and standard deviations of what is seen: data/vision/parameters.yaml,
 * which states their units, meaning and origin. Groups and members carry the file's keys. */
struct VisionParameters {
  /** The color of the field. */
  struct FieldDetector {
    double least_threshold = 0;
    double greatest_threshold = 0;
    double greatest_fraction = 0;
  };
  /** Points of lines. */
  struct LinePoints {
    double contrast = 0;
    double index_fraction = 0;
    double drop = 0;
  };
  /** Segments of lines. */
  struct LineDetector {
    double tolerance = 0;
    double tolerance_of_width = 0;
    double largest_gap = 0;
    double least_length = 0;
    double least_density = 0;
    double least_ground_width = 0;
    double most_ground_width = 0;
  };
  /** Crossings of lines. */
  struct CrossingDetector {
    double least_ground_angle = 0;
    double least_image_angle = 0;
    double reach = 0;
    double inside = 0;
    double reach_in_widths = 0;
  };
  /** The center circle. */
  struct CenterCircle {
    double tolerance = 0;
    double tolerance_of_distance = 0;
    double reach = 0;
    double most_residual = 0;
  };
  /** What serves localisation. */
  struct FieldObservation {
    double reach = 0;
    double least_length = 0;
    double post_reach = 0;
  };
  /** Faults of images. */
  struct ImageStatus {
    double uniform_deviation = 0;
    double dark_mean = 0;
    double white_level = 0;
    double white_fraction = 0;
    double green = 0;
    double frozen_time = 0;
    double frozen_distance = 0;
    double frozen_angle = 0;
  };
  /** The tracked ball. */
  struct BallFilter {
    double acceleration_density = 0;
    double velocity_sigma = 0;
    double gate = 0;
    double surprise = 0;
    double kick_time = 0;
    double agreement = 0;
    double forget_time = 0;
    double rolling_speed = 0;
    double rolling_sigmas = 0;
  };
  /** The tracked pose. */
  struct PoseFilter {
    double position_per_way = 0;
    double position_per_turn = 0;
    double heading_per_way = 0;
    double heading_per_turn = 0;
    double heading_per_time = 0;
    double position_per_time = 0;
    double tilt_sigma = 0;
    double tilt_time = 0;
    double tilt_noise = 0;
    double pixel_sigma = 0;
    double line_sigma = 0;
    double circle_sigma = 0;
    double circle_sigma_per_distance = 0;
    double post_distance_sigma = 0;
    double post_side_sigma = 0;
    double gate = 0;
    double unique = 0;
    double most_angle = 0;
    double beyond = 0;
    double beyond_per_distance = 0;
    double most_chord = 0;
  };
  /** A pose without a prior position. */
  struct PoseSearch {
    double tolerance = 0;
    double tolerance_of_distance = 0;
    double most_line_angle = 0;
    double beyond_end = 0;
    double circle_weight = 0;
    double most_length = 0;
    double least_crossing = 0;
    double least_pair_length = 0;
    double same_position = 0;
    double same_heading = 0;
    double common_tilt_sigma = 0;
    double least_score = 0;
    double margin = 0;
    double most_turn = 0;
  };
  /** When the pose is known. */
  struct Localizer {
    double start_position = 0;
    double start_heading = 0;
    double jump_distance = 0;
    double jump_speed = 0;
    double jump_position = 0;
    double jump_heading = 0;
    double fall_position = 0;
    double fall_heading = 0;
    double found_position = 0;
    double found_heading = 0;
    double keep_period = 0;
    double least_used_length = 0;
    double misfit_score = 0;
    double good_score = 0;
    double tilt_gain = 0;
    double better = 0;
    double lost_search_period = 0;
    double search_period = 0;
  };

  FieldDetector field_detector;
  LinePoints line_points;
  LineDetector line_detector;
  CrossingDetector crossing_detector;
  CenterCircle center_circle;
  FieldObservation field_observation;
  ImageStatus image_status;
  BallFilter ball_filter;
  PoseFilter pose_filter;
  PoseSearch pose_search;
  Localizer localizer;

  /** Reads data/vision/parameters.yaml. @param robot_file  Replaces single values, if it exists.
   * @throws ModelError  if a file lacks a value that it must have, or has an unknown, negative or
   * non-finite one. */
  static VisionParameters load(const std::filesystem::path& robot_file = {});
};

}  // namespace nao::vision

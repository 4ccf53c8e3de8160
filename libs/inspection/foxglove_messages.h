#pragma once

#include <naolcm/image_t.hpp>
#include <naolcm/motion_state_t.hpp>
#include <naolcm/robot_state_t.hpp>
#include <naolcm/sensor_state_t.hpp>
#include <naolcm/vision_state_t.hpp>
#include <naolcm/world_truth_t.hpp>
#include <string>
#include <vector>

#include "inspection/foxglove_json.h"
#include "robot_model/robot_model.h"

/** Messages of the bus in Foxglove's schemas. Frames: docs/inspection.md. */
namespace nao {

inline constexpr const char* kWorldFrame = "world";
inline constexpr const char* kOdometryFrame = "odometry";
/** On the ground below the torso, x along its heading. */
inline constexpr const char* kHeadingFrame = "heading";

/** Pose of a frame from a message's position, m, and quaternion (w, x, y, z). */
Eigen::Isometry3d to_pose(const double* position, const double* orientation);

/** A foxglove.JointStates: measured angles, velocities and torques. Unmeasured ones are absent. */
std::string joint_states_json(const naolcm::sensor_state_t& state);

/** A foxglove.Odometry. @param root  Name of the torso's frame. */
std::string odometry_json(const naolcm::robot_state_t& state, const std::string& root);

/** A foxglove.CompressedImage and a foxglove.CameraCalibration. @param frame  Optical frame. */
std::string compressed_image_json(const naolcm::image_t& image, const std::string& frame);
std::string camera_calibration_json(const naolcm::image_t& image, const std::string& frame);

/** Center of mass, its ground projection, center of pressure and support polygon. */
std::vector<SceneEntity> balance_entities(const naolcm::robot_state_t& state);
/** Outlines of the planned footsteps. */
std::vector<SceneEntity> footstep_entities(const naolcm::motion_state_t& state,
                                           const RobotModel& model);
/** What the cameras detected, and the ball as tracked. */
std::vector<SceneEntity> detection_entities(const naolcm::vision_state_t& state);
/** The true ball, and the forces of all contacts. */
std::vector<SceneEntity> world_entities(const naolcm::world_truth_t& truth);

}  // namespace nao

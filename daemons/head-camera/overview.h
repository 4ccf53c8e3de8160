#pragma once

#include <Eigen/Geometry>
#include <optional>

#include "rendering/world_state.h"
#include "robot_model/robot_description.h"
#include "robot_model/scene_file.h"

namespace nao::camera {

/** Name of the camera beside the field, which every simulated robot's program can render: in image
 * requests and images it is used like the names of the robot's own cameras. */
inline constexpr const char* kOverviewCamera = "overview";

/** Fields of view of the overview. It belongs to no link. */
CameraModel overview_camera();

/** Pose from which the overview is taken: beside the field, so that all of it is in the image;
 * without a field, in front of the robots' middle, on their left side.
 * @return Camera axes (x along the view, y left, z up) in the world. */
Eigen::Isometry3d overview_pose(const std::optional<FieldDimensions>& field,
                                const WorldState& world);

}  // namespace nao::camera

#include "inspection/foxglove_converter.h"
//
#include "common/bus.h"

#include <algorithm>

#include "inspection/foxglove_schemas.h"
#include "messages/named_joints.h"

namespace nao {
namespace {

// Least time between two messages that are only drawn, microseconds. Chosen: screens draw 60 images
// a second, and every second control period of 10 ms is used.
constexpr int64_t kDisplayPeriod = 20'000;
constexpr int64_t kSecond = 1'000'000;

}  // namespace

FoxgloveConverter::FoxgloveConverter(const RobotModel& model, const std::string& robot)
    : model_(model), transforms_(model), robot_(robot), channels_(robot) {
  add_outputs("/" + robot + "/");
}

void FoxgloveConverter::add_outputs(const std::string& robot) {
  outputs_.resize(kNumFixedOutputs);
  outputs_[kJointStates] = {robot + "joint_states", kJointStatesSchema};
  outputs_[kOdometry] = {robot + "odometry", kOdometrySchema};
  outputs_[kTransforms] = {robot + "transforms", kFrameTransformsSchema};
  outputs_[kBalance] = {robot + "balance", kSceneUpdateSchema};
  outputs_[kFootsteps] = {robot + "footsteps", kSceneUpdateSchema};
  outputs_[kDetections] = {robot + "detections", kSceneUpdateSchema};
  outputs_[kWorldTransforms] = {"/world/transforms", kFrameTransformsSchema};
  outputs_[kWorldScene] = {"/world/scene", kSceneUpdateSchema};
  for (const CameraModel& camera : model_.cameras()) {
    outputs_.push_back({robot + "camera/" + camera.name + "/image", kCompressedImageSchema});
    outputs_.push_back(
        {robot + "camera/" + camera.name + "/calibration", kCameraCalibrationSchema});
  }
}

const CameraModel* FoxgloveConverter::camera_of(size_t output) const {
  return output < kNumFixedOutputs ? nullptr : &model_.cameras()[(output - kNumFixedOutputs) / 2];
}

void FoxgloveConverter::convert(const std::string& channel, std::span<const uint8_t> message,
                                const IsWanted& is_wanted, const Emit& emit) {
  is_wanted_ = &is_wanted;
  emit_ = &emit;
  if (channel == channels_.sensor_state) {
    decode<naolcm::sensor_state_t>(message, &FoxgloveConverter::take_sensors);
  } else if (channel == channels_.robot_state) {
    decode<naolcm::robot_state_t>(message, &FoxgloveConverter::take_state);
  } else if (channel == channels_.motion_state) {
    decode<naolcm::motion_state_t>(message, &FoxgloveConverter::take_motion);
  } else if (channel == channels_.vision_state) {
    decode<naolcm::vision_state_t>(message, &FoxgloveConverter::take_vision);
  } else if (channel == kWorldTruthChannel) {
    decode<naolcm::world_truth_t>(message, &FoxgloveConverter::take_truth);
  } else if (channel == channels_.head_camera_image) {
    decode<naolcm::image_t>(message, &FoxgloveConverter::take_image);
  }
}

template <class Message>
void FoxgloveConverter::decode(std::span<const uint8_t> bytes,
                               void (FoxgloveConverter::*take)(const Message&)) {
  Message message;
  if (decode_message(bytes, message)) (this->*take)(message);
}

bool FoxgloveConverter::is_due(size_t output, int64_t utime) {
  if (!is_wanted(output)) return false;
  const auto last = last_utime_.find(output);
  // Time runs backwards if the simulator was restarted.
  if (last != last_utime_.end() && utime >= last->second && utime < last->second + kDisplayPeriod) {
    return false;
  }
  last_utime_[output] = utime;
  return true;
}

bool FoxgloveConverter::is_second_begun(size_t output, int64_t utime) {
  const auto last = last_second_.find(output);
  const bool is_new = last == last_second_.end() || last->second != utime / kSecond;
  last_second_[output] = utime / kSecond;
  return is_new;
}

void FoxgloveConverter::take_sensors(const naolcm::sensor_state_t& state) {
  if (is_wanted(kJointStates)) emit(kJointStates, joint_states_json(state));
}

void FoxgloveConverter::take_state(const naolcm::robot_state_t& state) {
  if (is_wanted(kOdometry)) emit(kOdometry, odometry_json(state, transforms_.root()));
  if (is_due(kBalance, state.utime)) {
    emit(kBalance, scene_update_json(state.utime, balance_entities(state)));
  }
  if (is_due(kTransforms, state.utime)) emit(kTransforms, transforms_of(state));
}

std::string FoxgloveConverter::transforms_of(const naolcm::robot_state_t& state) {
  const Eigen::Isometry3d torso =
      to_pose(state.position_torso_in_odometry, state.orientation_torso_in_odometry);
  alignment_.update(state.utime, torso, true_torso_ ? &*true_torso_ : nullptr);
  std::vector<NamedTransform> transforms{
      {kWorldFrame, kOdometryFrame, alignment_.pose_odometry_in_world()},
      {kOdometryFrame, kHeadingFrame, projected_on_ground(torso)},
      {kOdometryFrame, transforms_.root(), torso}};
  std::vector<double> position;
  // For another robot model only the root is known.
  if (!read_named_joints(model_.motor_names(), state.joint_names,
                         {{"position", state.joint_position, position}})) {
    transforms_.append_moving(position, "", transforms);
  }
  if (is_second_begun(kTransforms, state.utime)) transforms_.append_fixed("", transforms);
  return frame_transforms_json(state.utime, transforms);
}

void FoxgloveConverter::take_motion(const naolcm::motion_state_t& state) {
  if (is_wanted(kFootsteps)) {
    emit(kFootsteps, scene_update_json(state.utime, footstep_entities(state, model_)));
  }
}

void FoxgloveConverter::take_vision(const naolcm::vision_state_t& state) {
  if (is_wanted(kDetections)) {
    emit(kDetections, scene_update_json(state.utime, detection_entities(state)));
  }
}

void FoxgloveConverter::take_truth(const naolcm::world_truth_t& truth) {
  true_torso_.reset();
  for (const naolcm::robot_truth_t& robot : truth.robots) {
    if (robot.robot != robot_) continue;
    true_torso_ = to_pose(robot.position_torso_in_world, robot.orientation_torso_in_world);
  }
  if (is_due(kWorldTransforms, truth.utime)) emit(kWorldTransforms, transforms_of(truth));
  if (is_due(kWorldScene, truth.utime)) {
    emit(kWorldScene, scene_update_json(truth.utime, world_entities(truth)));
  }
}

std::string FoxgloveConverter::transforms_of(const naolcm::world_truth_t& truth) {
  const bool has_fixed = is_second_begun(kWorldTransforms, truth.utime);
  std::vector<NamedTransform> transforms;
  for (const naolcm::robot_truth_t& robot : truth.robots) {
    const std::string prefix = "truth/" + robot.robot + "/";
    transforms.push_back(
        {kWorldFrame, prefix + transforms_.root(),
         to_pose(robot.position_torso_in_world, robot.orientation_torso_in_world)});
    std::vector<double> position;
    if (read_named_joints(model_.motor_names(), robot.joint_names,
                          {{"position", robot.joint_position, position}})) {
      continue;
    }
    transforms_.append_moving(position, prefix, transforms);
    if (has_fixed) transforms_.append_fixed(prefix, transforms);
  }
  return frame_transforms_json(truth.utime, transforms);
}

void FoxgloveConverter::take_image(const naolcm::image_t& image) {
  const auto& cameras = model_.cameras();
  const auto camera = std::find_if(cameras.begin(), cameras.end(), [&](const CameraModel& known) {
    return known.name == image.camera;
  });
  if (camera == cameras.end()) return;
  // The largest size is shown, unless there was none for a second.
  ShownImage& shown = shown_images_[image.camera];
  const bool is_recent = image.utime >= shown.utime && image.utime < shown.utime + kSecond;
  if (is_recent && image.width < shown.width) return;
  shown = {image.width, image.utime};
  const size_t output =
      kNumFixedOutputs + 2 * static_cast<size_t>(std::distance(cameras.begin(), camera));
  const std::string frame = RobotTransforms::optical_frame(model_.links()[camera->link].name);
  if (is_wanted(output)) emit(output, compressed_image_json(image, frame));
  if (is_wanted(output + 1)) emit(output + 1, camera_calibration_json(image, frame));
}

}  // namespace nao

#include "daemons/vision/vision_messages.h"

#include "common/error.h"
#include "messages/named_joints.h"
#include "messages/pose_message.h"

namespace nao::vision {
namespace {

naolcm::detection_t encode_detection(const Detection& detection) {
  naolcm::detection_t message{};
  message.kind = static_cast<int8_t>(detection.kind);
  // Same units and frames as in detection_t; NaN where a position is not known.
  for (int i = 0; i < 4; ++i) {
    message.box_px[i] = detection.box_px[i];
    message.line_px[i] = detection.line_px[i];
  }
  for (int i = 0; i < 2; ++i) {
    message.position_in_heading[i] = detection.position[i];
    message.end_in_heading[i] = detection.end[i];
    for (int j = 0; j < 2; ++j) message.covariance[i][j] = detection.covariance(i, j);
  }
  message.confidence = detection.confidence;
  return message;
}

void encode_field_pose(const FieldPose& estimate, naolcm::vision_state_t& message) {
  if (!estimate.is_known) return;
  message.has_field_pose = 1;
  message.torso_in_field[0] = estimate.pose.position.x();
  message.torso_in_field[1] = estimate.pose.position.y();
  message.torso_in_field[2] = estimate.pose.heading;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) message.field_pose_covariance[i][j] = estimate.covariance(i, j);
  }
}

}  // namespace

RobotPosture decode_posture(const RobotModel& model, const naolcm::robot_state_t& state) {
  RobotPosture posture;
  posture.utime = state.utime;
  posture.position.assign(model.num_motors(), 0.0);
  const auto fault = read_named_joints(model.motor_names(), state.joint_names,
                                       {{"position", state.joint_position, posture.position}});
  if (fault) throw MessageError(to_sentence(*fault));
  posture.pose_torso_in_odometry =
      decode_pose(state.position_torso_in_odometry, state.orientation_torso_in_odometry);
  return posture;
}

CameraCalibration decode_calibration(const naolcm::image_t& image) {
  CameraCalibration calibration{image.fx, image.fy, image.cx, image.cy, {}};
  std::copy(std::begin(image.distortion), std::end(image.distortion),
            calibration.distortion.begin());
  if (!calibration.is_valid())
    throw MessageError("the image's intrinsics are not finite or not positive");
  return calibration;
}

naolcm::vision_state_t encode_result(const VisionResult& result, int64_t utime,
                                     const std::string& camera) {
  // Zero-initialized: fields of ball and field pose stay 0 without them.
  naolcm::vision_state_t message{};
  message.utime = utime;
  message.camera = camera;
  message.image_status = static_cast<int8_t>(result.image_status);
  for (const Detection& detection : result.detections) {
    message.detections.push_back(encode_detection(detection));
  }
  message.num_detections = static_cast<int32_t>(message.detections.size());
  encode_field_pose(result.field_pose, message);
  if (!result.ball.is_known) return message;
  message.has_ball = 1;
  message.ball_utime = result.ball.seen_utime;
  for (int i = 0; i < 2; ++i) {
    message.ball_position_in_odometry[i] = result.ball.state[i];
    message.ball_velocity_in_odometry[i] = result.ball.state[i + 2];
  }
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 4; ++j) message.ball_covariance[i][j] = result.ball.covariance(i, j);
  }
  message.is_ball_rolling = result.ball.is_rolling ? 1 : 0;
  return message;
}

}  // namespace nao::vision

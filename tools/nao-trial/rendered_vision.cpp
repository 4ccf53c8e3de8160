#include "tools/nao-trial/rendered_vision.h"

#include <opencv2/imgproc.hpp>

namespace nao::trial {
namespace {

/** Standard deviation of the noise of images, of 255 levels. Chosen. */
constexpr double kImageNoise = 3;
/** Time between images for a behavior, s: two thirds of the rate that nao-play requests, as on a
 * host that renders them, too. Chosen. */
constexpr double kImagePeriod = 0.1;

camera::HeadCameraOptions camera_options() {
  camera::HeadCameraOptions options;
  options.noise = kImageNoise;
  return options;
}

}  // namespace

RenderedVision::RenderedVision(ClosedLoop& trial, const SceneFile& scene, const Pose2& start)
    : trial_(trial),
      scene_(scene.name),
      poses_(trial.model()),
      core_(vision::VisionNetworks::load(),
            vision::VisionParameters::load(trial.model().folder() / "vision.yaml")),
      renderer_(trial.model(), camera_options()) {
  core_.localize(vision::FieldModel(scene), start);
}

void RenderedVision::keep_state() {
  const motion::RobotState& state = trial_.estimate();
  poses_.add({state.utime, state.torso_in_odometry, state.joint_position});
}

WorldState RenderedVision::world_state() const {
  WorldState world;
  world.utime = trial_.estimate().utime;
  world.scene = scene_;
  const int num_robots = trial_.world().num_robots();
  for (int i = 0; i < num_robots; ++i) {
    const sim::SimRobot& simulated = trial_.world().robot(i);
    RobotPose robot;
    robot.name = i == trial_.robot() ? camera_options().robot : "ROBOT" + std::to_string(i);
    robot.pose_torso_in_world = simulated.link_pose(0);
    const Eigen::VectorXd& position = simulated.motor_position();
    robot.position.assign(position.data(), position.data() + position.size());
    // Several robots are two teams, one after the other.
    if (num_robots > 1) {
      robot.team = i < num_robots / 2 ? 0 : 1;
      robot.number = i % (num_robots / 2) + 1;
    }
    world.robots.push_back(robot);
  }
  Eigen::Isometry3d ball = Eigen::Isometry3d::Identity();
  ball.translation() = trial_.world().ball().position;
  world.pose_ball_in_world = ball;
  return world;
}

vision::VisionResult RenderedVision::look(const CameraModel& camera) {
  const camera::CameraFrame& frame = renderer_.take(world_state(), camera.name, 640);
  const cv::Mat bgrx(frame.pinhole.height, frame.pinhole.width, CV_8UC4,
                     const_cast<uint8_t*>(frame.bgrx[0].data()));
  vision::VisionInput input;
  cv::cvtColor(bgrx, input.bgr, cv::COLOR_BGRA2BGR);
  // Rows of the frame come from the bottom up.
  cv::flip(input.bgr, input.bgr, 0);
  input.utime = trial_.estimate().utime;
  input.camera = camera.name;
  const PinholeCamera& pinhole = frame.pinhole;
  input.calibration = {pinhole.fx, pinhole.fy, pinhole.cx, pinhole.cy, {}};
  if (const auto pose = poses_.find(camera.name, input.utime)) {
    input.pose_camera_in_heading = pose->pose_camera_in_heading;
    input.heading_in_odometry = pose->heading_in_odometry;
    input.is_upright = pose->is_upright;
    heading_in_odometry_ = pose->heading_in_odometry;
  }
  pose_camera_in_heading_ = input.pose_camera_in_heading;
  return core_.process(input);
}

const play::Vision& RenderedPerception::step(const std::string& camera) {
  vision_.keep_state();
  for (const CameraModel& each : trial_.model().cameras()) {
    if (each.name != camera || trial_.time() < next_image_) continue;
    next_image_ = trial_.time() + kImagePeriod;
    const vision::VisionResult seen = vision_.look(each);
    play::Vision vision;
    vision.time = trial_.time();
    vision.image_status = static_cast<int>(seen.image_status);
    if (seen.ball.is_known) {
      vision.ball =
          play::Ball{seen.ball.state.head<2>(), seen.ball.state.tail<2>(),
                     1e-6 * static_cast<double>(seen.ball.seen_utime), seen.ball.is_rolling};
    }
    if (seen.field_pose.is_known) {
      vision.field_in_odometry = vision_.heading_in_odometry() * seen.field_pose.pose.inverse();
    }
    for (const vision::Detection& detection : seen.detections) {
      if (detection.kind != vision::Kind::kRobot || !detection.position.allFinite()) continue;
      vision.robots.push_back(vision_.heading_in_odometry() * detection.position);
    }
    pending_.push_back({trial_.time() + kImageLatency, vision});
  }
  while (!pending_.empty() && pending_.front().due <= trial_.time()) {
    known_ = pending_.front().vision;
    pending_.pop_front();
  }
  return known_;
}

}  // namespace nao::trial

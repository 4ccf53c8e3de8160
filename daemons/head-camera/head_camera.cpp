#include "head_camera.h"

#include "common/error.h"
#include "half_size.h"
#include "picture_wishes.h"

namespace nao {
namespace {

/** Ball of a world whose scene file is unknown, m. */
constexpr double kUnknownBallRadius = 0.05;

const CameraModel& find_camera(const RobotModel& model, const std::string& name) {
  for (const CameraModel& camera : model.cameras()) {
    if (camera.name == name) return camera;
  }
  throw Error("the robot has no camera \"" + name + "\"");
}

}  // namespace

HeadCamera::HeadCamera(const RobotModel& model, const HeadCameraOptions& options)
    : model_(model),
      options_(options),
      context_(egl_platform(options.egl_platform)),
      renderer_(RendererOptions{.shadow_size = options.shadow_size}),
      visual_(model, renderer_),
      framebuffer_(kFullWidth, kFullHeight),
      problems_(visual_.problems()) {}

std::string HeadCamera::driver() const {
  return SceneRenderer::driver() + " by EGL platform " + context_.platform_name();
}

std::vector<std::string> HeadCamera::take_problems() {
  return std::exchange(problems_, {});
}

void HeadCamera::set_scene(const std::string& name) {
  if (scene_name_ == name) return;
  scene_name_ = name;
  scene_file_ = {};
  try {
    scene_file_ = SceneFile::find(name);
  } catch (const Error& error) {
    problems_.push_back(std::string(error.what()) + "; a plain floor is drawn");
  }
  renderer_.set_surroundings(scene_file_);
}

void HeadCamera::draw(const WorldState& world, const std::string& camera) {
  const CameraModel& description = find_camera(model_, camera);
  if (world.find_robot(options_.robot) == nullptr) {
    throw Error("the world has no robot \"" + options_.robot + "\"");
  }
  set_scene(world.scene);
  scene_.clear();
  for (const RobotPose& robot : world.robots) {
    const auto poses = link_poses_in_world(model_, robot.pose_torso_in_world, robot.position);
    int hidden_link = -1;
    if (robot.name == options_.robot) {
      frame_.pose_camera_in_world = poses[description.link];
      hidden_link = carrying_link(model_, description.link);
    }
    visual_.append(scene_, poses, Color::Ones(), hidden_link);
  }
  if (world.pose_ball_in_world) {
    const double radius = scene_file_.ball ? scene_file_.ball->radius : kUnknownBallRadius;
    scene_.ball = SceneBall{world.pose_ball_in_world->cast<float>(), static_cast<float>(radius)};
  }
  frame_.utime = world.utime;
  frame_.camera = camera;
  frame_.pinhole = PinholeCamera::from_fov(kFullWidth, kFullHeight, description.horizontal_fov,
                                           description.vertical_fov);
  renderer_.render(scene_, frame_.pinhole, frame_.pose_camera_in_world, framebuffer_.id());
}

void HeadCamera::read_back() {
  framebuffer_.read(frame_.bgrx[0]);
}

void HeadCamera::make_smaller(int least_width) {
  for (int level = 1; level <= CameraFrame::level(least_width); ++level) {
    halve(frame_.bgrx[level - 1], kFullWidth >> (level - 1), kFullHeight >> (level - 1),
          frame_.bgrx[level]);
  }
}

const CameraFrame& HeadCamera::take(const WorldState& world, const std::string& camera,
                                    int least_width) {
  draw(world, camera);
  read_back();
  make_smaller(least_width);
  return frame_;
}

}  // namespace nao

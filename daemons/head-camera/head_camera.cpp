#include "daemons/head-camera/head_camera.h"

#include "common/error.h"
#include "daemons/head-camera/half_size.h"
#include "daemons/head-camera/picture_wishes.h"

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

PinholeCamera pinhole_of(const CameraModel& camera) {
  return PinholeCamera::from_fov(kFullWidth, kFullHeight, camera.horizontal_fov,
                                 camera.vertical_fov);
}

}  // namespace

HeadCamera::HeadCamera(const RobotModel& model, const HeadCameraOptions& options)
    : model_(model),
      options_(options),
      context_(egl_platform(options.egl_platform)),
      renderer_(RendererOptions{.shadow_size = options.shadow_size}),
      visual_(model, renderer_),
      framebuffer_(kFullWidth, kFullHeight),
      problems_(visual_.problems()) {
  if (options.noise > 0) noise_.emplace(options.noise);
  frame_.distortion = {options.k1, options.k2, 0, 0, 0};
  if (options.k1 == 0 && options.k2 == 0) return;
  for (const CameraModel& camera : model.cameras()) {
    lenses_.try_emplace(camera.name, pinhole_of(camera), options.k1, options.k2);
  }
}

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
  frame_.pinhole = pinhole_of(description);
  const auto lens = lenses_.find(camera);
  renderer_.render(scene_, lens != lenses_.end() ? lens->second.source() : frame_.pinhole,
                   frame_.pose_camera_in_world, framebuffer_.id());
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

/** Mean of pictures spread evenly over the exposure, the last one of the state itself. */
void HeadCamera::expose(const WorldState& earlier, const WorldState& world,
                        const std::string& camera) {
  constexpr int kPictures = 4;
  const double step = 1e-6 * static_cast<double>(world.utime - earlier.utime);
  exposure_.clear();
  for (int i = kPictures - 1; i >= 0; --i) {
    const double before = options_.exposure * i / kPictures;
    draw(i == 0 ? world : interpolated(earlier, world, 1 - before / step), camera);
    read_back();
    exposure_.add(frame_.bgrx[0]);
  }
  exposure_.mean(frame_.bgrx[0]);
}

void HeadCamera::bend() {
  const auto lens = lenses_.find(frame_.camera);
  if (lens == lenses_.end()) return;
  lens->second.bend(frame_.bgrx[0], bent_);
  std::swap(frame_.bgrx[0], bent_);
}

const CameraFrame& HeadCamera::take(const WorldState& world, const std::string& camera,
                                    int least_width, const WorldState* earlier) {
  if (options_.exposure > 0 && earlier != nullptr && earlier->utime < world.utime) {
    expose(*earlier, world, camera);
    frame_.exposure_time = options_.exposure;
  } else {
    frame_.exposure_time = 0;
    draw(world, camera);
    read_back();
  }
  bend();
  if (noise_) noise_->add(frame_.bgrx[0], frame_.utime);
  make_smaller(least_width);
  return frame_;
}

}  // namespace nao

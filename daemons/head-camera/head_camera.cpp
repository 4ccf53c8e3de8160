#include "daemons/head-camera/head_camera.h"

#include <cmath>
#include <utility>

#include "common/error.h"
#include "daemons/head-camera/half_size.h"
#include "daemons/head-camera/image_requests.h"
#include "daemons/head-camera/overview.h"

namespace nao::camera {
namespace {

/** Number of images whose mean is a blurred image. Chosen: each costs a full rendering, and steps
 * in the blur are visible only above a few pixels a step. */
constexpr int kNumExposureSamples = 4;

CameraModel find_camera(const RobotModel& model, const std::string& name) {
  if (name == kOverviewCamera) return overview_camera();
  for (const CameraModel& camera : model.cameras()) {
    if (camera.name == name) return camera;
  }
  throw Error("the robot has no camera \"" + name + "\"");
}

}  // namespace

PinholeCamera pinhole_of(const CameraModel& camera) {
  return PinholeCamera::from_fov(kFullWidth, kFullHeight, camera.horizontal_fov,
                                 camera.vertical_fov);
}

HeadCamera::HeadCamera(const RobotModel& model, const HeadCameraOptions& options)
    : model_(model),
      options_(options),
      context_(egl_platform(options.egl_platform)),
      renderer_(RendererOptions{.shadow_size = options.shadow_size}),
      visuals_(model, renderer_),
      surroundings_(renderer_),
      framebuffer_(kFullWidth, kFullHeight) {
  if (options.noise > 0) noise_.emplace(options.noise);
  frame_.distortion = options.distortion;
  if (options.distortion.is_zero()) return;
  // The table of a lens takes time to compute: once for each camera at start.
  for (const CameraModel& camera : model.cameras()) {
    lenses_.try_emplace(camera.name, pinhole_of(camera), options.distortion);
  }
}

std::string HeadCamera::driver() const {
  return SceneRenderer::driver() + " on EGL platform " + context_.platform_name();
}

std::vector<std::string> HeadCamera::take_problems() {
  const std::vector<std::string>& faults = visuals_.problems();
  problems_.insert(problems_.end(), faults.begin() + static_cast<long>(num_told_problems_),
                   faults.end());
  num_told_problems_ = faults.size();
  return std::exchange(problems_, {});
}

// Renders the world as this camera sees it into the framebuffer. A head camera's own head is
// hidden: its lens looks out of the shell.
void HeadCamera::draw(const WorldState& world, const std::string& camera) {
  const CameraModel description = find_camera(model_, camera);
  const bool is_overview = camera == kOverviewCamera;
  if (!is_overview && world.find_robot(options_.robot) == nullptr) {
    throw Error("the world has no robot \"" + options_.robot + "\"");
  }
  if (surroundings_.set(world.scene) && !surroundings_.problem().empty()) {
    problems_.push_back(surroundings_.problem());
  }
  shown_.reset();
  ++frame_.num_changes;
  scene_.clear();
  Eigen::Isometry3d pose_camera_in_world = Eigen::Isometry3d::Identity();
  for (const RobotPose& robot : world.robots) {
    const bool is_own = !is_overview && robot.name == options_.robot;
    const int hidden_link = is_own ? carrying_link(model_, description.link) : -1;
    const auto poses = visuals_.append(scene_, robot, Color::Ones(), hidden_link);
    if (is_own) pose_camera_in_world = poses[description.link];
  }
  if (is_overview) pose_camera_in_world = overview_pose(surroundings_.field(), world);
  if (world.pose_ball_in_world) {
    scene_.ball = SceneBall{world.pose_ball_in_world->cast<float>(),
                            static_cast<float>(surroundings_.ball_radius())};
  }
  frame_.utime = world.utime;
  frame_.camera = camera;
  frame_.pinhole = pinhole_of(description);
  const auto lens = lenses_.find(camera);
  renderer_.render(scene_, lens != lenses_.end() ? lens->second.source() : frame_.pinhole,
                   pose_camera_in_world, framebuffer_.id());
}

void HeadCamera::read_back() {
  framebuffer_.read(frame_.bgrx[0]);
}

// Each level is made from the one above: 640, 320, 160 pixels wide, down to the requested width.
void HeadCamera::make_smaller(int min_width) {
  least_width_ = min_width;
  for (int level = 1; level <= CameraFrame::level(min_width); ++level) {
    halve(frame_.bgrx[level - 1], kFullWidth >> (level - 1), kFullHeight >> (level - 1),
          frame_.bgrx[level]);
  }
}

void HeadCamera::expose(const WorldState& earlier, const WorldState& world,
                        const std::string& camera) {
  // The exposure ends at the time of `world`. It is divided into equal parts with one sample in the
  // middle of each, so that the mean time of the samples is the mid exposure that the frame states.
  const double interval = 1e-6 * static_cast<double>(world.utime - earlier.utime);
  exposure_.clear();
  for (int i = 0; i < kNumExposureSamples; ++i) {
    const double before_end = options_.exposure * (i + 0.5) / kNumExposureSamples;
    draw(interpolated(earlier, world, 1 - before_end / interval), camera);
    read_back();
    exposure_.add(frame_.bgrx[0]);
  }
  exposure_.mean(frame_.bgrx[0]);
  frame_.utime = world.utime - std::llround(1e6 * options_.exposure / 2);
  frame_.exposure_time = options_.exposure;
}

void HeadCamera::distort() {
  const auto lens = lenses_.find(frame_.camera);
  if (lens == lenses_.end()) return;
  lens->second.distort(frame_.bgrx[0], distorted_);
  std::swap(frame_.bgrx[0], distorted_);
}

bool HeadCamera::is_exposed(const std::string& camera, const WorldState& world,
                            const WorldState* earlier) const {
  // Blur needs a state before this one; after a restart there is none.
  return options_.exposure > 0 && camera != kOverviewCamera && earlier != nullptr &&
         earlier->utime < world.utime;
}

const CameraFrame& HeadCamera::take(const WorldState& world, const std::string& camera,
                                    int min_width, const WorldState* earlier) {
  const bool is_exposed = this->is_exposed(camera, world, earlier);
  if (shown_ && !is_exposed && frame_.camera == camera && looks_same(*shown_, world)) {
    frame_.utime = world.utime;
    if (min_width < least_width_) make_smaller(min_width);
    return frame_;
  }
  if (is_exposed) {
    expose(*earlier, world, camera);
  } else {
    draw(world, camera);
    read_back();
    frame_.exposure_time = 0;
  }
  // The order is that of a real camera: lens, then sensor noise, then the smaller sizes.
  distort();
  const bool is_noisy = noise_ && camera != kOverviewCamera;
  if (is_noisy) noise_->add(frame_.bgrx[0], frame_.utime);
  make_smaller(min_width);
  if (!is_exposed && !is_noisy) shown_ = world;
  return frame_;
}

}  // namespace nao::camera

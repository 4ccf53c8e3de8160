#include "tools/nao-trial/scenarios.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>

#include "common/constants.h"
#include "common/error.h"
#include "tools/nao-trial/field_detection_statistics.h"
#include "tools/nao-trial/field_error_model.h"
#include "tools/nao-trial/rendered_vision.h"

namespace nao::trial {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using vision::FieldPose;

/** Time between images, s. A rendered one costs about 30 ms of processor time. */
constexpr double kSparseImagePeriod = 0.2;
/** Time between the values of a metric, s. */
constexpr double kSamplePeriod = 0.5;
constexpr double kDuration = 600;
/** The driver keeps the robot this far inside of the outer lines, m. */
constexpr double kMargin = 0.4;
/** How often the robot is placed elsewhere, and the time, s, after which its pose must be known
 * again within m and rad. */
constexpr int kNumPlacements = 5;
constexpr double kRecoveryTime = 20;
constexpr double kRecoveredDistance = 0.3;
constexpr double kRecoveredTurn = 0.17;
/** Time before a placement at which the robot stops walking, s. */
constexpr double kStandTime = 2;
/** Greatest turn of a robot that is placed elsewhere, rad: the gyroscope does not measure it. */
constexpr double kMostTurn = 1.0;
/** Greatest tilt of the torso while standing or walking, rad; images at a larger tilt do not count.
 */
constexpr double kUpright = 0.3;

Pose2 true_pose(const ClosedLoop& trial) {
  return Pose2::from(trial.torso_in_world());
}

/** The robot's perception and localisation in one trial. */
class Localisation {
 public:
  virtual ~Localisation() = default;
  /** Once in every tick. */
  void tick() {
    keep_state();
    if (trial_.time() < next_image_) return;
    next_image_ = trial_.time() + kSparseImagePeriod;
    const CameraModel& camera = trial_.model().cameras().front();
    estimate_ = look(camera);
    odometry_ = odometry();
    if (!keeps_statistics_ || !pose_camera_ || trial_.torso_tilt() > kUpright) return;
    statistics_.add(detections_, trial_.world().robot(0).link_pose(camera.link), *pose_camera_,
                    trial_.world().ball().position);
  }
  /** Whether the images from now on are counted. */
  void keep_statistics(bool keep) { keeps_statistics_ = keep; }
  const FieldDetectionStatistics& statistics() const { return statistics_; }
  /** Now: the pose at the last image, moved by the odometry since, as nao-play uses it. */
  FieldPose estimate() const {
    FieldPose now = estimate_;
    now.pose = estimate_.pose * (odometry_.inverse() * odometry());
    return now;
  }

 protected:
  Localisation(ClosedLoop& trial, const SceneFile& scene)
      : trial_(trial),
        field_(scene),
        pinhole_(camera::pinhole_of(trial.model().cameras().front())),
        calibration_{pinhole_.fx, pinhole_.fy, pinhole_.cx, pinhole_.cy, {}},
        statistics_(field_, calibration_, pinhole_.width, pinhole_.height) {}
  virtual void keep_state() = 0;
  /** Sets detections_ and pose_camera_. */
  virtual FieldPose look(const CameraModel& camera) = 0;

  ClosedLoop& trial_;
  vision::FieldModel field_;
  PinholeCamera pinhole_;
  vision::CameraCalibration calibration_;
  /** Detections in the last image, and the camera's pose in the heading frame by the robot's
   * sensors. */
  vision::Detections detections_;
  std::optional<Eigen::Isometry3d> pose_camera_;

 private:
  Pose2 odometry() const { return Pose2::from(trial_.estimate().torso_in_odometry); }

  double next_image_ = 0;
  FieldPose estimate_;
  /** At the last image. */
  Pose2 odometry_;
  FieldDetectionStatistics statistics_;
  bool keeps_statistics_ = true;
};

class RenderedLocalisation : public Localisation {
 public:
  RenderedLocalisation(ClosedLoop& trial, const SceneFile& scene, const Pose2& start)
      : Localisation(trial, scene), vision_(trial, scene, start) {}

 private:
  void keep_state() override { vision_.keep_state(); }
  FieldPose look(const CameraModel& camera) override {
    vision::VisionResult seen = vision_.look(camera);
    detections_ = std::move(seen.detections);
    pose_camera_ = vision_.pose_camera_in_heading();
    return seen.field_pose;
  }

  RenderedVision vision_;
};

class ModelledLocalisation : public Localisation {
 public:
  ModelledLocalisation(ClosedLoop& trial, const SceneFile& scene, const Pose2& start, uint64_t seed)
      : Localisation(trial, scene),
        parameters_(vision::VisionParameters::load(trial.model().folder() / "vision.yaml")),
        poses_(trial.model()),
        localizer_(field_, start, parameters_),
        errors_(field_, calibration_, pinhole_.width, pinhole_.height, seed) {}

 private:
  void keep_state() override {
    const motion::RobotState& state = trial_.estimate();
    poses_.add({state.utime, state.torso_in_odometry, state.joint_position});
  }

  FieldPose look(const CameraModel& camera) override {
    const int64_t utime = trial_.estimate().utime;
    const auto pose = poses_.find(camera.name, utime);
    pose_camera_.reset();
    if (!pose) return localizer_.estimate();
    pose_camera_ = pose->pose_camera_in_heading;
    localizer_.predict(utime, pose->heading_in_odometry, pose->is_upright);
    const Eigen::Isometry3d truth = trial_.world().robot(0).link_pose(camera.link);
    detections_ = errors_.detect(truth, pose->pose_camera_in_heading);
    localizer_.observe(vision::observe_field(
        detections_, {pose->pose_camera_in_heading.translation(), 1 / calibration_.fx},
        pose->heading_in_odometry, parameters_.field_observation));
    return localizer_.estimate();
  }

  vision::VisionParameters parameters_;
  vision::PoseHistory poses_;
  vision::Localizer localizer_;
  FieldErrorModel errors_;
};

/** Error of an estimate: x, y, m, and heading, rad, in the field frame. */
Vector3d error_of(const FieldPose& estimate, const Pose2& truth) {
  const Vector2d difference = estimate.pose.position - truth.position;
  return {difference.x(), difference.y(), wrapped(estimate.pose.heading - truth.heading)};
}

/** Drives the robot about the field with a joystick, looking around. */
class Driver {
 public:
  Driver(ClosedLoop& trial, const FieldDimensions& field)
      : trial_(trial), half_(field.length / 2 - kMargin, field.width / 2 - kMargin) {}

  /** Once in every tick. */
  void tick() {
    if (trial_.time() < next_) return;
    next_ = trial_.time() + 0.3;
    const Mode mode = trial_.core().motion_state().mode;
    if (mode == Mode::kFalling || mode == Mode::kFallen || mode == Mode::kGettingUp) {
      // It gets up by itself.
      trial_.release_walk(false);
      return;
    }
    look_around();
    const Pose2 pose = true_pose(trial_);
    const Vector2d way = goal_ - pose.position;
    if (way.norm() < 0.4 || trial_.time() > goal_end_) choose();
    const WalkLimits& limits = trial_.model().walk_limits();
    if (rest_end_ > trial_.time()) {
      trial_.release_walk();
      return;
    }
    const double bearing = wrapped(std::atan2(way.y(), way.x()) - pose.heading);
    const double turn = std::clamp(1.2 * bearing, -limits.turning, limits.turning);
    const double ahead = std::max(0.0, std::cos(bearing)) * limits.forward * speed_;
    trial_.hold_walk({ahead, sideways_ * limits.sideways, turn});
  }

 private:
  void choose() {
    goal_ = {trial_.random(-half_.x(), half_.x()), trial_.random(-half_.y(), half_.y())};
    goal_end_ = trial_.time() + 25;
    speed_ = trial_.random(0.4, 1);
    sideways_ = trial_.random(0, 1) < 0.3 ? trial_.random(-0.6, 0.6) : 0;
    if (trial_.random(0, 1) < 0.3) rest_end_ = trial_.time() + trial_.random(1, 4);
  }

  // The head turns to random directions, like that of a robot that searches for the ball.
  void look_around() {
    if (trial_.time() < next_look_) return;
    next_look_ = trial_.time() + trial_.random(1, 2.5);
    const auto& groups = trial_.model().joint_groups();
    const auto head = std::find_if(groups.begin(), groups.end(),
                                   [](const JointGroup& group) { return group.name == "head"; });
    if (head == groups.end() || head->yaw_motor < 0 || head->pitch_motor < 0) return;
    JointChangeCommand change;
    change.joint_names = {trial_.model().motor_joint(head->yaw_motor).name,
                          trial_.model().motor_joint(head->pitch_motor).name};
    change.joint_position = {trial_.random(-0.8, 0.8), trial_.random(0.0, 0.3)};
    change.speed = 0.3;
    trial_.send({"", 0, change});
  }

  ClosedLoop& trial_;
  Vector2d half_;
  Vector2d goal_ = Vector2d::Zero();
  double goal_end_ = 0;
  double speed_ = 0.7;
  double sideways_ = 0;
  double rest_end_ = 0;
  double next_ = 0;
  double next_look_ = 0;
};

/** Places the robot, standing as it does, turned about the vertical. */
void place(ClosedLoop& trial, const Vector2d& position, double turn) {
  const Eigen::Quaterniond orientation(Eigen::AngleAxisd(turn, Vector3d::UnitZ()) *
                                       trial.torso_in_world().linear());
  trial.world().place_robot(0, nullptr, {position.x(), position.y(), 0}, &orientation);
}

std::map<std::string, std::string> localisation_units() {
  std::map<std::string, std::string> units{
      {"position_error_m", "m"}, {"heading_error_deg", "degrees"}, {"recovery_s", "s"}};
  for (const auto& unit : FieldDetectionStatistics::units()) units.insert(unit);
  return units;
}

std::vector<RunResult> run_localise(bool is_rendered, const ScenarioOptions& options,
                                    uint64_t seed) {
  if (options.trial.model->cameras().empty()) {
    throw ConfigError(options.trial.model->name() + " has no camera");
  }
  const FieldDimensions& field = *options.trial.scene.field;
  ClosedLoop trial(options.trial, seed);
  const auto random_position = [&](double lower_x, double upper_x) {
    return Vector2d(trial.random(lower_x, upper_x) * (field.length / 2 - kMargin),
                    trial.random(-1, 1) * (field.width / 2 - kMargin));
  };
  // The place is in its own half, with any heading.
  place(trial, random_position(-1, 0), trial.random(-M_PI, M_PI));
  const Pose2 start = told_start(true_pose(trial),
                                 [&](double low, double high) { return trial.random(low, high); });
  std::unique_ptr<Localisation> localisation;
  if (is_rendered) {
    localisation = std::make_unique<RenderedLocalisation>(trial, options.trial.scene, start);
  } else {
    localisation = std::make_unique<ModelledLocalisation>(trial, options.trial.scene, start, seed);
  }
  Driver driver(trial, field);
  RunResult session;
  session.label = "session";
  double next_sample = 0;
  int num_samples = 0;
  int num_known = 0;
  trial.on_tick([&] {
    localisation->tick();
    if (trial.time() > 1) driver.tick();
    if (trial.time() < next_sample) return;
    next_sample = trial.time() + kSamplePeriod;
    // The pose of a fallen robot is not used.
    if (trial.torso_tilt() > 0.6) return;
    const FieldPose estimate = localisation->estimate();
    ++num_samples;
    if (!estimate.is_known) return;
    ++num_known;
    const Vector3d error = error_of(estimate, true_pose(trial));
    session.metrics.emplace_back("position_error_m", error.head<2>().norm());
    session.metrics.emplace_back("heading_error_deg", std::abs(error.z()) / kDegree);
    // Normalized estimation error squared: its mean is 3 if the covariance is right (Bar-Shalom,
    // Li, Kirubarajan, "Estimation with applications to tracking and navigation", 2001, 5.4).
    session.metrics.emplace_back("nees", error.dot(estimate.covariance.inverse() * error));
  });
  trial.run(options.duration > 0 ? options.duration : kDuration);
  session.metrics.emplace_back("known", static_cast<double>(num_known) / std::max(1, num_samples));
  for (const auto& metric : localisation->statistics().metrics()) session.metrics.push_back(metric);
  localisation->keep_statistics(false);
  session.is_success = num_known > 0.9 * num_samples;
  if (!session.is_success) session.failure = "pose often unknown";
  std::vector<RunResult> results{session};

  for (int i = 0; i < kNumPlacements; ++i) {
    trial.release_walk();
    trial.on_tick([&] { localisation->tick(); });
    trial.run(kStandTime);
    trial.run_until([&] { return trial.torso_tilt() < kUpright; }, kDuration);
    const Vector2d position = random_position(-1, 1);
    place(trial, position, trial.random(-kMostTurn, kMostTurn));
    const double begin = trial.time();
    double since = 0;
    // The pose must stay known until the end of the time.
    bool is_known = false;
    trial.on_tick([&] {
      localisation->tick();
      if (trial.time() - begin > 1) driver.tick();
      const FieldPose estimate = localisation->estimate();
      const Vector3d error = error_of(estimate, true_pose(trial));
      const bool is_right = estimate.is_known && error.head<2>().norm() < kRecoveredDistance &&
                            std::abs(error.z()) < kRecoveredTurn;
      if (is_right && !is_known) since = trial.time();
      is_known = is_right;
    });
    trial.run(kRecoveryTime);
    RunResult placed;
    placed.label = "placed";
    placed.is_success = is_known;
    if (is_known) {
      placed.metrics = {{"recovery_s", since - begin}};
    } else {
      placed.failure = "pose not found again";
    }
    results.push_back(placed);
  }
  return results;
}

}  // namespace

Scenario localise_scenario(bool is_rendered) {
  return with_perception({"localise",
                          "Estimate the pose on the field for --duration (600 s), then after "
                          "being placed elsewhere",
                          localisation_units(), std::bind_front(run_localise, is_rendered)},
                         is_rendered);
}

}  // namespace nao::trial

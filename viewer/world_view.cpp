#include "viewer/world_view.h"

#include <algorithm>
#include <cmath>

#include "common/error.h"
#include "rendering/decode_state.h"
#include "rendering/primitives.h"

namespace nao {
namespace {

const Color kTruthTint(0.55f, 0.8f, 1.0f, 0.4f);
const Color kSeeThroughTint(1, 1, 1, 0.35f);
const Color kWaitingTint(0.8f, 0.85f, 0.95f, 0.5f);
const Color kForceColor(0.9f, 0.12f, 0.08f, 1);
const Color kMassColor(0.95f, 0.65f, 0.05f, 1);
const Color kPressureColor(0.75f, 0.1f, 0.75f, 0.95f);
const Color kSupportColor(0.1f, 0.45f, 0.95f, 0.3f);
const Color kLeftStepColor(0.95f, 0.35f, 0.1f, 0.55f);
const Color kRightStepColor(0.1f, 0.6f, 0.9f, 0.55f);
/** Length of an arrow for a force, m/N: half the robot's weight gives 13 cm. */
constexpr double kMetresPerNewton = 0.005;
/** Impacts reach thousands of newtons; their arrows end here, m. */
constexpr double kLongestForce = 0.4;
/** Smaller forces than this have no arrow, N. */
constexpr double kLeastForce = 0.5;
/** Markings lie above one another, m. */
constexpr double kSupportHeight = 0.002;
constexpr double kStepHeight = 0.003;
constexpr double kPressureHeight = 0.004;
constexpr double kUnknownBallRadius = 0.05;

/** A frame's place on the ground and its heading. */
Eigen::Isometry3d on_ground(const Eigen::Isometry3d& pose) {
  const Eigen::Vector3d ahead = pose.linear().col(0);
  Eigen::Isometry3d flat = Eigen::Isometry3d::Identity();
  flat.rotate(Eigen::AngleAxisd(std::atan2(ahead.y(), ahead.x()), Eigen::Vector3d::UnitZ()));
  flat.translation() << pose.translation().x(), pose.translation().y(), 0;
  return flat;
}

}  // namespace

WorldView::WorldView(const RobotModel& model, SceneRenderer& renderer, const std::string& robot,
                     const std::string& waiting_posture)
    : model_(model),
      renderer_(renderer),
      visual_(model, renderer),
      robot_(robot),
      waiting_posture_(waiting_posture),
      arrow_(renderer.add_mesh(make_arrow(0.03f, Color::Ones()))),
      sphere_(renderer.add_mesh(make_sphere(1, Color::Ones()))) {}

void WorldView::update(const MessageStore& store, const ViewChoice& choice) {
  scene_.clear();
  handles_.clear();
  problems_ = visual_.problems();
  has_robot_ = false;
  truth_.reset();
  set_scene(store.truth() ? store.truth()->message.scene : "soccer");
  if (!scene_problem_.empty()) problems_.push_back(scene_problem_);
  try {
    if (store.truth()) truth_ = decode_truth(model_, store.truth()->message);
  } catch (const Error& error) {
    problems_.push_back(std::string(kWorldTruthChannel) + ": " + error.what());
  }
  try {
    if (store.robot_state()) add_estimate(store.robot_state()->message, choice);
  } catch (const Error& error) {
    problems_.push_back(store.channels().robot_state + ": " + error.what());
  }
  if (truth_) add_truth(store.truth()->message, choice, !store.robot_state());
  if (store.motion_state() && choice.footsteps) add_footsteps(store.motion_state()->message);
  if (!has_robot_) add_waiting_robot();
}

void WorldView::set_scene(const std::string& name) {
  if (scene_name_ == name) return;
  scene_name_ = name;
  scene_file_ = {};
  scene_problem_.clear();
  try {
    scene_file_ = SceneFile::find(name);
  } catch (const Error& error) {
    scene_problem_ = error.what();
  }
  renderer_.set_surroundings(scene_file_);
}

void WorldView::add_waiting_robot() {
  const Posture* posture = model_.find_posture(waiting_posture_);
  const std::vector<double> position =
      posture != nullptr ? posture->position : std::vector<double>(model_.num_motors(), 0.0);
  const auto in_torso = model_.link_poses(position);
  Eigen::Isometry3d torso = Eigen::Isometry3d::Identity();
  if (model_.left_sole() >= 0) torso = in_torso[model_.left_sole()].inverse();
  torso = on_ground(torso).inverse() * torso;
  visual_.append(scene_, link_poses_in_world(model_, torso, position), kWaitingTint);
}

void WorldView::add_truth(const naolcm::world_truth_t& truth, const ViewChoice& choice,
                          bool is_alone) {
  for (const RobotPose& robot : truth_->robots) {
    const auto poses = link_poses_in_world(model_, robot.pose_torso_in_world, robot.position);
    add_handles(robot, poses);
    const bool is_own = robot.name == robot_;
    if (is_own) {
      pose_torso_in_world_ = robot.pose_torso_in_world;
      has_robot_ = true;
    }
    if (is_own && !choice.true_robot) continue;
    const bool is_compared = is_own && !is_alone && choice.estimated_robot;
    visual_.append(scene_, poses, is_compared ? kTruthTint : Color(Color::Ones()));
  }
  if (truth_->pose_ball_in_world) {
    const double radius = scene_file_.ball ? scene_file_.ball->radius : kUnknownBallRadius;
    scene_.ball = SceneBall{truth_->pose_ball_in_world->cast<float>(), static_cast<float>(radius)};
    handles_.push_back({"", "ball", truth_->pose_ball_in_world->translation(), radius});
  }
  if (!choice.contact_forces) return;
  for (const naolcm::contact_t& contact : truth.contacts) {
    Eigen::Vector3d force = Eigen::Map<const Eigen::Vector3d>(contact.force_on_a_in_world);
    // As felt by what is not the floor: upwards out of the ground.
    if (contact.body_a == "floor") force = -force;
    const Eigen::Vector3d at = Eigen::Map<const Eigen::Vector3d>(contact.position_in_world);
    if (!force.allFinite() || !at.allFinite() || force.norm() < kLeastForce) continue;
    const double length = std::min(kMetresPerNewton * force.norm(), kLongestForce);
    add_arrow(at, at + length * force.normalized(), kForceColor);
  }
}

void WorldView::add_handles(const RobotPose& robot, const std::vector<Eigen::Isometry3d>& poses) {
  constexpr double kHandRadius = 0.05;
  for (size_t link = 0; link < poses.size(); ++link) {
    const Link& description = model_.links()[link];
    if (description.mass <= 0) continue;
    handles_.push_back(
        {robot.name, description.name, poses[link] * description.center_of_mass, kHandRadius});
  }
}

void WorldView::align_odometry(const naolcm::robot_state_t& state) {
  // Time running back: the robot started anew.
  if (state.utime < aligned_utime_) is_aligned_ = false;
  const RobotPose* own = truth_ ? truth_->find_robot(robot_) : nullptr;
  if (is_aligned_ || own == nullptr) return;
  const Eigen::Isometry3d estimated =
      decode_pose(state.position_torso_in_odometry, state.orientation_torso_in_odometry);
  pose_odometry_in_world_ = on_ground(own->pose_torso_in_world) * on_ground(estimated).inverse();
  aligned_utime_ = state.utime;
  is_aligned_ = true;
}

void WorldView::add_estimate(const naolcm::robot_state_t& state, const ViewChoice& choice) {
  const Eigen::Isometry3d in_odometry =
      decode_pose(state.position_torso_in_odometry, state.orientation_torso_in_odometry);
  const std::vector<double> position =
      decode_positions(model_, state.joint_names, state.joint_position);
  align_odometry(state);
  pose_torso_in_world_ = pose_odometry_in_world_ * in_odometry;
  has_robot_ = true;
  if (choice.estimated_robot) {
    visual_.append(scene_, link_poses_in_world(model_, pose_torso_in_world_, position),
                   choice.see_through ? kSeeThroughTint : Color(Color::Ones()));
  }
  add_markings(state, choice);
}

void WorldView::add_markings(const naolcm::robot_state_t& state, const ViewChoice& choice) {
  const Eigen::Isometry3d& world = pose_odometry_in_world_;
  if (choice.support_polygon && state.num_support_corners >= 3) {
    std::vector<Eigen::Vector3d> corners;
    for (const auto& corner : state.support_corner_in_odometry) {
      corners.push_back(world * Eigen::Vector3d(corner[0], corner[1], kSupportHeight));
    }
    add_polygon(corners, kSupportColor);
  }
  const Eigen::Vector3d pressure(state.center_of_pressure_in_odometry[0],
                                 state.center_of_pressure_in_odometry[1], kPressureHeight);
  if (choice.center_of_pressure && pressure.allFinite()) {
    add_disc(world * pressure, 0.008, kPressureColor);
  }
  const Eigen::Vector3d mass =
      world * Eigen::Vector3d(Eigen::Map<const Eigen::Vector3d>(state.center_of_mass_in_odometry));
  if (choice.center_of_mass && mass.allFinite()) {
    add_sphere(mass, 0.012, kMassColor);
    const Eigen::Vector3d ground(mass.x(), mass.y(), kPressureHeight);
    scene_.lines.push_back({mass.cast<float>(), ground.cast<float>(), kMassColor});
    add_disc(ground, 0.006, kMassColor);
  }
}

void WorldView::add_footsteps(const naolcm::motion_state_t& motion) {
  for (const naolcm::footstep_t& step : motion.footsteps) {
    const bool is_left = step.is_left != 0;
    const Eigen::Isometry3d sole =
        pose_odometry_in_world_ *
        Eigen::Translation3d(step.position_in_odometry[0], step.position_in_odometry[1],
                             kStepHeight) *
        Eigen::AngleAxisd(step.heading_in_odometry, Eigen::Vector3d::UnitZ());
    if (!sole.matrix().allFinite()) continue;
    std::vector<Eigen::Vector3d> corners;
    const auto& outline = is_left ? model_.left_sole_outline() : model_.right_sole_outline();
    corners.reserve(outline.size());
    for (const Eigen::Vector2d& corner : outline) {
      corners.push_back(sole * Eigen::Vector3d(corner.x(), corner.y(), 0));
    }
    add_polygon(corners, is_left ? kLeftStepColor : kRightStepColor);
  }
}

void WorldView::add_polygon(const std::vector<Eigen::Vector3d>& corners, const Color& color) {
  for (const Eigen::Vector3d& corner : corners) {
    if (!corner.allFinite()) return;
  }
  Color edge = color;
  edge.w() = 1;
  for (size_t i = 0; i < corners.size(); ++i) {
    const Eigen::Vector3f next = corners[(i + 1) % corners.size()].cast<float>();
    scene_.lines.push_back({corners[i].cast<float>(), next, edge});
    if (i == 0 || i + 1 == corners.size()) continue;
    scene_.triangles.push_back({{corners[0].cast<float>(), corners[i].cast<float>(), next}, color});
  }
}

void WorldView::add_disc(const Eigen::Vector3d& center, double radius, const Color& color) {
  constexpr int kSides = 16;
  const auto rim = [&](int i) {
    const double angle = 2 * M_PI * i / kSides;
    const Eigen::Vector3d offset(radius * std::cos(angle), radius * std::sin(angle), 0);
    return Eigen::Vector3f((center + offset).cast<float>());
  };
  for (int i = 0; i < kSides; ++i) {
    scene_.triangles.push_back({{center.cast<float>(), rim(i), rim(i + 1)}, color});
  }
}

void WorldView::add_arrow(const Eigen::Vector3d& from, const Eigen::Vector3d& tip,
                          const Color& color) {
  const Eigen::Vector3d way = tip - from;
  if (way.norm() < 1e-4) return;
  MeshInstance arrow;
  arrow.mesh = arrow_;
  arrow.pose_in_world.translate(from.cast<float>());
  arrow.pose_in_world.rotate(
      Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), way).cast<float>());
  const auto length = static_cast<float>(way.norm());
  const float width = std::min(length, 0.2f);
  arrow.scale = {width, width, length};
  arrow.tint = color;
  arrow.casts_shadow = false;
  scene_.instances.push_back(arrow);
}

void WorldView::add_sphere(const Eigen::Vector3d& center, double radius, const Color& color) {
  MeshInstance sphere;
  sphere.mesh = sphere_;
  sphere.pose_in_world.translate(center.cast<float>());
  sphere.scale.setConstant(static_cast<float>(radius));
  sphere.tint = color;
  sphere.casts_shadow = false;
  scene_.instances.push_back(sphere);
}

}  // namespace nao

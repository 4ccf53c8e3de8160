#include "viewer/world_view.h"

#include <algorithm>

#include "common/error.h"
#include "messages/pose_message.h"
#include "rendering/decode_state.h"
#include "viewer/message_store.h"

namespace nao::viewer {
namespace {

const Color kTruthTint(0.55f, 0.8f, 1.0f, 0.4f);
const Color kTranslucentTint(1, 1, 1, 0.35f);
const Color kWaitingTint(0.8f, 0.85f, 0.95f, 0.5f);
const Color kForceColor(0.9f, 0.12f, 0.08f, 1);
const Color kComColor(0.95f, 0.65f, 0.05f, 1);
const Color kPressureColor(0.75f, 0.1f, 0.75f, 0.95f);
const Color kSupportColor(0.1f, 0.45f, 0.95f, 0.3f);
const Color kLeftStepColor(0.95f, 0.35f, 0.1f, 0.55f);
const Color kRightStepColor(0.1f, 0.6f, 0.9f, 0.55f);
/** Length of the arrow of a force, m/N. Chosen: half the weight of the robot gives 13 cm. */
constexpr double kMetersPerNewton = 0.005;
/** Longest arrow, m: impacts reach thousands of newtons. */
constexpr double kMaxArrowLength = 0.4;
/** Smaller forces have no arrow, N. */
constexpr double kMinForce = 0.5;
/** Heights of the markings above the ground, m: different, so that they do not flicker where they
 * overlap. */
constexpr double kSupportHeight = 0.002;
constexpr double kStepHeight = 0.003;
constexpr double kPressureHeight = 0.004;
/** Radii of the markers, m. */
constexpr double kComRadius = 0.012;
constexpr double kComProjectionRadius = 0.006;
constexpr double kPressureRadius = 0.008;
/** Radius in which the mouse grabs a link at its center of mass, m: about half a thigh. */
constexpr double kLinkHandleRadius = 0.05;

}  // namespace

WorldView::WorldView(const RobotModel& model, SceneRenderer& renderer, const std::string& robot,
                     const std::string& waiting_posture)
    : model_(model),
      models_(model),
      visuals_(model, renderer),
      robot_(robot),
      waiting_posture_(waiting_posture),
      markers_(renderer),
      surroundings_(renderer) {}

// Rebuilds the scene for this frame: truth, estimate, footsteps, or the waiting robot if nothing
// has come. A message that does not decode is reported, and the rest is drawn.
void WorldView::update(const MessageStore& store, const ViewChoice& choice) {
  scene_.clear();
  handles_.clear();
  problems_ = visuals_.problems();
  has_robot_ = false;
  truth_.reset();
  surroundings_.set(store.truth() ? store.truth()->message.scene : "soccer");
  if (!surroundings_.problem().empty()) problems_.push_back(surroundings_.problem());
  try {
    if (store.truth()) truth_ = decode_truth(models_, store.truth()->message);
  } catch (const Error& error) {
    problems_.push_back(std::string(kWorldTruthChannel) + ": " + error.what());
  }
  try {
    if (store.robot_state()) add_estimate(store.robot_state()->message, choice);
  } catch (const Error& error) {
    problems_.push_back(store.channels().robot_state + ": " + error.what());
  }
  if (truth_) add_truth(store.truth()->message, choice, store.robot_state().has_value());
  if (store.motion_state() && choice.footsteps) add_footsteps(store.motion_state()->message);
  if (!has_robot_) add_waiting_robot();
}

void WorldView::add_waiting_robot() {
  const Posture* posture =
      model_.find_posture(waiting_posture_.empty() ? model_.references().ready : waiting_posture_);
  const std::vector<double> position =
      posture != nullptr ? posture->position : std::vector<double>(model_.num_motors(), 0.0);
  const auto in_torso = model_.link_poses(position);
  // The left sole on the ground, the torso above the origin.
  Eigen::Isometry3d torso = Eigen::Isometry3d::Identity();
  if (model_.left_sole() >= 0) torso = in_torso[model_.left_sole()].inverse();
  torso = projected_on_ground(torso).inverse() * torso;
  visuals_.own().append(scene_, link_poses_in_world(model_, torso, position), kWaitingTint);
}

void WorldView::add_truth(const naolcm::world_truth_t& truth, const ViewChoice& choice,
                          bool has_estimate) {
  for (const RobotPose& robot : truth_->robots) {
    const bool is_own = robot.name == robot_;
    if (is_own) {
      // Without an estimate the truth gives the robot's place for the camera to follow.
      pose_torso_in_world_ = robot.pose_torso_in_world;
      has_robot_ = true;
    }
    // The truth is tinted if the estimate is also drawn, so that they can be distinguished.
    const bool is_compared = is_own && has_estimate && choice.estimated_robot;
    Scene hidden;
    add_handles(robot, visuals_.append(is_own && !choice.true_robot ? hidden : scene_, robot,
                                       is_compared ? kTruthTint : Color(Color::Ones())));
  }
  if (truth_->pose_ball_in_world) {
    const double radius = surroundings_.ball_radius();
    scene_.ball = SceneBall{truth_->pose_ball_in_world->cast<float>(), static_cast<float>(radius)};
    handles_.push_back({"", kBallLink, truth_->pose_ball_in_world->translation(), radius});
  }
  if (choice.contact_forces) add_contact_forces(truth);
}

void WorldView::add_contact_forces(const naolcm::world_truth_t& truth) {
  for (const naolcm::contact_t& contact : truth.contacts) {
    Eigen::Vector3d force = Eigen::Map<const Eigen::Vector3d>(contact.force_on_a_in_world);
    // The force on the body, not on the floor: it points upwards.
    if (contact.body_a == "floor") force = -force;
    const Eigen::Vector3d at = Eigen::Map<const Eigen::Vector3d>(contact.position_in_world);
    if (!force.allFinite() || !at.allFinite() || force.norm() < kMinForce) continue;
    const double length = std::min(kMetersPerNewton * force.norm(), kMaxArrowLength);
    markers_.add_arrow(scene_, at, at + length * force.normalized(), kForceColor);
  }
}

void WorldView::add_handles(const RobotPose& robot, const std::vector<Eigen::Isometry3d>& poses) {
  for (size_t link = 0; link < poses.size(); ++link) {
    const Link& description = visuals_.of(robot).model().links()[link];
    if (description.mass <= 0) continue;
    handles_.push_back({robot.name, description.name, poses[link] * description.center_of_mass,
                        kLinkHandleRadius});
  }
}

void WorldView::add_estimate(const naolcm::robot_state_t& state, const ViewChoice& choice) {
  const Eigen::Isometry3d pose_torso_in_odometry =
      decode_pose(state.position_torso_in_odometry, state.orientation_torso_in_odometry);
  const std::vector<double> position =
      decode_positions(model_, state.joint_names, state.joint_position);
  const RobotPose* true_robot = truth_ ? truth_->find_robot(robot_) : nullptr;
  // Odometry is moved onto the truth where there is one, else it is drawn as the world.
  odometry_.update(state.utime, pose_torso_in_odometry,
                   true_robot != nullptr ? &true_robot->pose_torso_in_world : nullptr);
  pose_torso_in_world_ = odometry_.pose_odometry_in_world() * pose_torso_in_odometry;
  has_robot_ = true;
  if (choice.estimated_robot) {
    visuals_.own().append(scene_, link_poses_in_world(model_, pose_torso_in_world_, position),
                          choice.translucent ? kTranslucentTint : Color(Color::Ones()));
  }
  add_markings(state, choice);
}

void WorldView::add_markings(const naolcm::robot_state_t& state, const ViewChoice& choice) {
  const Eigen::Isometry3d& world_from_odometry = odometry_.pose_odometry_in_world();
  if (choice.support_polygon && state.num_support_corners >= 3) {
    std::vector<Eigen::Vector3d> corners;
    for (const auto& corner : state.support_corner_in_odometry) {
      corners.push_back(world_from_odometry *
                        Eigen::Vector3d(corner[0], corner[1], kSupportHeight));
    }
    markers_.add_polygon(scene_, corners, kSupportColor);
  }
  const Eigen::Vector3d pressure(state.center_of_pressure_in_odometry[0],
                                 state.center_of_pressure_in_odometry[1], kPressureHeight);
  if (choice.center_of_pressure && pressure.allFinite()) {
    markers_.add_disc(scene_, world_from_odometry * pressure, kPressureRadius, kPressureColor);
  }
  const Eigen::Vector3d com =
      world_from_odometry *
      Eigen::Vector3d(Eigen::Map<const Eigen::Vector3d>(state.center_of_mass_in_odometry));
  if (choice.com && com.allFinite()) {
    markers_.add_sphere(scene_, com, kComRadius, kComColor);
    const Eigen::Vector3d projection(com.x(), com.y(), kPressureHeight);
    scene_.lines.push_back({com.cast<float>(), projection.cast<float>(), kComColor});
    markers_.add_disc(scene_, projection, kComProjectionRadius, kComColor);
  }
}

// Outlines of the planned soles, in odometry.
void WorldView::add_footsteps(const naolcm::motion_state_t& motion) {
  for (const naolcm::footstep_t& step : motion.footsteps) {
    const bool is_left = step.is_left != 0;
    const Eigen::Isometry3d sole =
        odometry_.pose_odometry_in_world() *
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
    markers_.add_polygon(scene_, corners, is_left ? kLeftStepColor : kRightStepColor);
  }
}

}  // namespace nao::viewer

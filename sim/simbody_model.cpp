#include "sim/simbody_model.h"

#include "common/error.h"

namespace nao::sim {
namespace {

SimTK::Transform to_transform(const Eigen::Isometry3d& pose) {
  const Eigen::Matrix3d& m = pose.linear();
  return {SimTK::Rotation(SimTK::Mat33(m(0, 0), m(0, 1), m(0, 2), m(1, 0), m(1, 1), m(1, 2),
                                       m(2, 0), m(2, 1), m(2, 2))),
          to_simbody(Eigen::Vector3d(pose.translation()))};
}

/** Mass properties about a body's origin, as Simbody defines them. */
SimTK::MassProperties mass_of(const Link& link, const Eigen::Isometry3d& pose_in_body, double scale,
                              const Eigen::Vector3d& displacement) {
  const Eigen::Vector3d com = pose_in_body * (link.center_of_mass + displacement);
  // Inertia in the body's axes: R I R^T, about the link's center of mass; then by the parallel axis
  // theorem about the body's origin.
  const Eigen::Matrix3d i =
      pose_in_body.linear() * link.inertia * pose_in_body.linear().transpose() * scale;
  const double mass = link.mass * scale;
  const SimTK::Inertia central(i(0, 0), i(1, 1), i(2, 2), i(0, 1), i(0, 2), i(1, 2));
  return {mass, to_simbody(com), central.shiftFromMassCenter(-to_simbody(com), mass)};
}

SimTK::MassProperties sum(const SimTK::MassProperties& a, const SimTK::MassProperties& b) {
  const double mass = a.getMass() + b.getMass();
  // Both about the same origin: masses, first moments and inertias add up.
  return {mass, (a.getMass() * a.getMassCenter() + b.getMass() * b.getMassCenter()) / mass,
          a.calcInertia() + b.calcInertia()};
}

/** Whether a joint's child link is part of its parent link's body. */
bool is_fixed(const Joint& joint) {
  return joint.kind == Joint::Kind::kFixed;
}

}  // namespace

SimbodyModel::SimbodyModel(const RobotModel& model, double mass_scale,
                           const Eigen::Vector3d& torso_com)
    : robot_(model),
      torso_com_(torso_com),
      matter_(system_),
      link_body_(model.links().size(), -1),
      link_pose_(model.links().size(), Eigen::Isometry3d::Identity()) {
  // Link 0 is the root; the recursion adds all others.
  add_body(0, -1, -1, mass_scale);
  // Coupled joints: followers are constrained to their leaders after all bodies exist.
  for (const Body& body : bodies_) {
    if (body.joint < 0) continue;
    const Joint& joint = robot_.joints()[body.joint];
    if (joint.mimic_joint < 0) continue;
    const Joint& leader = robot_.joints()[joint.mimic_joint];
    const int leader_body = link_body_[leader.child_link];
    // 0 = ratio * q_leader + offset - q_follower
    SimTK::Vector coefficients(3);
    coefficients[0] = joint.mimic_multiplier;
    coefficients[1] = -1;
    coefficients[2] = joint.mimic_offset;
    SimTK::Array_<SimTK::MobilizedBodyIndex> coupled;
    coupled.push_back(bodies_[leader_body].mobilized);
    coupled.push_back(body.mobilized);
    SimTK::Constraint::CoordinateCoupler(
        matter_, new SimTK::Function::Linear(coefficients), coupled,
        SimTK::Array_<SimTK::MobilizerQIndex>(2, SimTK::MobilizerQIndex(0)));
  }
  system_.realizeTopology();
}

// Mass of a link and everything behind it, kg.
double SimbodyModel::subtree_mass(int link) const {
  double mass = robot_.links()[link].mass;
  for (const Joint& joint : robot_.joints()) {
    if (joint.parent_link == link) mass += subtree_mass(joint.child_link);
  }
  return mass;
}

// Assigns a link, and all links rigidly connected to it, to a body.
void SimbodyModel::collect_fixed(int link, int body, const Eigen::Isometry3d& pose_in_body) {
  link_body_[link] = body;
  link_pose_[link] = pose_in_body;
  for (const Joint& joint : robot_.joints()) {
    if (joint.parent_link != link) continue;
    // Branches without mass, such as frames of sensors, could not be accelerated: they are parts of
    // their parents' bodies, as behind fixed joints.
    if (is_fixed(joint) || subtree_mass(joint.child_link) == 0) {
      collect_fixed(joint.child_link, body, pose_in_body * joint.pose_in_parent);
    }
  }
}

void SimbodyModel::add_body(int link, int parent, int joint_index, double mass_scale) {
  const int index = static_cast<int>(bodies_.size());
  collect_fixed(link, index, Eigen::Isometry3d::Identity());
  // Mass properties of all links of the body, about the body's origin.
  SimTK::MassProperties mass(0, SimTK::Vec3(0), SimTK::Inertia(0));
  for (size_t i = 0; i < link_body_.size(); ++i) {
    const Link& part = robot_.links()[i];
    if (link_body_[i] != index || part.mass == 0) continue;
    const SimTK::MassProperties part_mass =
        mass_of(part, link_pose_[i], mass_scale, i == 0 ? torso_com_ : Eigen::Vector3d::Zero());
    mass = mass.getMass() == 0 ? part_mass : sum(mass, part_mass);
  }
  // Simbody cannot accelerate a moving body without mass: the model is refused at start.
  if (mass.getMass() <= 0) {
    throw ModelError("link " + robot_.links()[link].name + " is moved by a joint but has no mass");
  }

  const SimTK::Body::Rigid rigid(mass);
  // The body's frame is that of its first link.
  Body body{link, parent, joint_index, {}};
  if (parent < 0) {
    body.mobilized =
        SimTK::MobilizedBody::Free(matter_.Ground(), SimTK::Transform(), rigid, SimTK::Transform());
  } else {
    const Joint& joint = robot_.joints()[joint_index];
    const Eigen::Isometry3d joint_in_body = link_pose_[joint.parent_link] * joint.pose_in_parent;
    // A pin joint turns about its z axis: both of its frames are rotated by the same amount, so
    // that angle 0 is the URDF's.
    const SimTK::Rotation axis_to_z(SimTK::UnitVec3(to_simbody(joint.axis)), SimTK::ZAxis);
    body.mobilized =
        SimTK::MobilizedBody::Pin(matter_.updMobilizedBody(bodies_[parent].mobilized),
                                  to_transform(joint_in_body) * SimTK::Transform(axis_to_z), rigid,
                                  SimTK::Transform(axis_to_z));
  }
  bodies_.push_back(body);

  // Depth first, so that each limb's coordinates are consecutive.
  for (size_t i = 0; i < robot_.joints().size(); ++i) {
    const Joint& joint = robot_.joints()[i];
    if (is_fixed(joint) || subtree_mass(joint.child_link) == 0) continue;
    if (link_body_[joint.parent_link] == index) {
      add_body(joint.child_link, index, static_cast<int>(i), mass_scale);
    }
  }
}

void SimbodyModel::set_state(const Tree& tree, const TreeState& from, SimTK::State& state) const {
  const Eigen::Quaterniond& r = from.orientation;
  SimTK::Vector q(7), u(6);
  // Simbody's order: quaternion (w first), then position; of velocities angular, then linear, as in
  // TreeState.
  const double root_q[] = {
      r.w(), r.x(), r.y(), r.z(), from.position.x(), from.position.y(), from.position.z()};
  for (int i = 0; i < 7; ++i) q[i] = root_q[i];
  for (int i = 0; i < 6; ++i) u[i] = from.velocity[i];
  mobilized(0).setQFromVector(state, q);
  mobilized(0).setUFromVector(state, u);
  // Mimic joints get the angle and speed that the coupling demands.
  for (int i = 1; i < tree.num_bodies(); ++i) {
    const TreeBody& body = tree.bodies()[i];
    mobilized(i).setOneQ(state, 0, body.ratio * from.coordinate[body.dof] + body.offset);
    mobilized(i).setOneU(state, 0, body.ratio * from.velocity[body.dof]);
  }
}

}  // namespace nao::sim

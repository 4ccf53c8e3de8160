#include "sim/tree.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <set>

#include "sim/simbody_model.h"

namespace nao::sim {
namespace {

Eigen::Vector3d to_eigen(const SimTK::Vec3& v) {
  return {v[0], v[1], v[2]};
}

Eigen::Matrix3d to_eigen(const SimTK::Mat33& m) {
  Eigen::Matrix3d result;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) result(i, j) = m(i, j);
  }
  return result;
}

/** Replaces numbers within rounding of 0 or +-1 by these, so that a robot's left and right side
 * stay exact mirror images. */
double cleaned(double x) {
  for (const double exact : {0.0, 1.0, -1.0}) {
    if (std::abs(x - exact) < 1e-14) return exact;
  }
  return x;
}

}  // namespace

Tree::Tree(const RobotModel& robot, double mass_scale, const Eigen::Vector3d& torso_com)
    : Tree(SimbodyModel(robot, mass_scale, torso_com)) {}

Tree::Tree(const SimbodyModel& model) {
  for (size_t link = 0; link < model.robot().links().size(); ++link) {
    link_body_.push_back(model.body_of_link(static_cast<int>(link)));
    link_pose_.push_back(model.pose_in_body(static_cast<int>(link)));
  }
  // Simbody's model is the one source of frames and masses; the arrays copy it, so that both
  // engines simulate the same robot.
  const SimTK::State& state = model.default_state();
  std::map<int, int> dof_of_joint;
  const std::vector<Joint>& joints = model.robot().joints();

  dof_body_.assign(6, 0);
  for (const SimbodyModel::Body& from : model.bodies()) {
    const int index = num_bodies();
    const SimTK::MobilizedBody& mobilized = model.mobilized(index);
    const SimTK::MassProperties& mass = mobilized.getBodyMassProperties(state);
    TreeBody body;
    body.parent = from.parent;
    body.joint = from.joint;
    body.mass = mass.getMass();
    body.center_of_mass = to_eigen(mass.getMassCenter());
    body.inertia = to_eigen(SimTK::Mat33(mass.calcCentralInertia().toMat33()));
    total_mass_ += body.mass;
    if (body.parent < 0) {
      body.chain = {0, 1, 2, 3, 4, 5};
    } else {
      // R_PB and p_PB at angle 0.
      // A pin rotates about the z axis of its frame M on the body, which coincides with frame F on
      // the parent at angle 0.
      const SimTK::Transform& parent_F = mobilized.getInboardFrame(state);
      const SimTK::Transform& body_M = mobilized.getOutboardFrame(state);
      const SimTK::Transform parent_B = parent_F * ~body_M;
      body.origin_in_parent = to_eigen(parent_B.p());
      body.rotation_in_parent = to_eigen(SimTK::Mat33(parent_B.R().asMat33())).unaryExpr(&cleaned);
      body.is_parallel = body.rotation_in_parent.isIdentity(0);
      body.axis = to_eigen(SimTK::Vec3(body_M.z())).unaryExpr(&cleaned);

      const Joint& joint = joints[from.joint];
      int leader = from.joint;
      if (joint.mimic_joint >= 0) {
        leader = joint.mimic_joint;
        body.ratio = joint.mimic_multiplier;
        body.offset = joint.mimic_offset;
      }
      // A follower takes the leader's dof, whichever of both comes first in the list.
      const auto [entry, is_new] =
          dof_of_joint.try_emplace(leader, static_cast<int>(dof_body_.size()));
      body.dof = entry->second;
      if (is_new) dof_body_.push_back(index);
      // body_of_dof() means the leader's body, even if the follower was found first.
      if (joint.mimic_joint < 0) dof_body_[body.dof] = index;
      body.chain = bodies_[body.parent].chain;
      const auto place = std::lower_bound(body.chain.begin(), body.chain.end(), body.dof);
      if (place == body.chain.end() || *place != body.dof) body.chain.insert(place, body.dof);
    }
    bodies_.push_back(std::move(body));
  }
  find_ancestors();
}

// The mass matrix couples all dofs of a body's chain. From the last dof to the first, eliminating
// one couples all that it is coupled with, of which the last becomes its parent. Without mimic
// joints these are the joints above it, and the root's six dofs are in series.
void Tree::find_ancestors() {
  const int count = static_cast<int>(dof_body_.size());
  std::vector<std::set<int>> coupled(count);
  for (const TreeBody& body : bodies_) {
    for (auto dof = body.chain.begin(); dof != body.chain.end(); ++dof) {
      coupled[*dof].insert(body.chain.begin(), dof);
    }
  }
  std::vector<int> parent(count, -1);
  for (int dof = count - 1; dof > 0; --dof) {
    parent[dof] = *coupled[dof].rbegin();
    coupled[parent[dof]].insert(coupled[dof].begin(), std::prev(coupled[dof].end()));
  }
  dof_ancestors_.resize(count);
  for (int dof = 1; dof < count; ++dof) {
    dof_ancestors_[dof] = dof_ancestors_[parent[dof]];
    dof_ancestors_[dof].push_back(parent[dof]);
  }
  for (TreeBody& body : bodies_) {
    const int last = body.chain.back();
    body.chain = dof_ancestors_[last];
    body.chain.push_back(last);
    auto place = body.chain.rbegin();
    for (const TreeBody* above = &body; above->parent >= 0; above = &bodies_[above->parent]) {
      if (place == body.chain.rend() || *place++ != above->dof) body.is_in_series = false;
    }
    if (body.is_in_series) body.is_in_series = std::distance(place, body.chain.rend()) == 6;
  }
}

}  // namespace nao::sim

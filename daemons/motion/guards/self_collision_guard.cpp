#include "daemons/motion/guards/self_collision_guard.h"

#include <algorithm>
#include <limits>

#include "robot_model/collision_shape.h"

namespace nao::motion {
namespace {

// Approach of links that are closer than the clearance already, m. Chosen: a sixth of the usual
// clearance, above rounding.
constexpr double kTouchTolerance = 0.0005;
// Radius of the rounded edges of boxes, m; closest_points() needs one above 0. Chosen: half of the
// simulator's, so that the boxes reach a little farther into their corners than there.
constexpr double kEdgeRadius = 0.004;

}  // namespace

SelfCollisionGuard::SelfCollisionGuard(const RobotModel& model, double clearance)
    : kinematics_(model), clearance_(clearance) {
  for (int link = 0; link < static_cast<int>(model.links().size()); ++link) {
    for (const Shape& shape : model.links()[link].collisions) {
      Part part{link, rounded_box_in_link(model.links()[link], shape, kEdgeRadius), 0};
      part.bounding_radius = part.box_in_link.half.norm() + part.box_in_link.radius;
      parts_.push_back(part);
    }
  }
  const auto& allowed = model.allowed_contacts();
  for (int a = 0; a < static_cast<int>(parts_.size()); ++a) {
    for (int b = a + 1; b < static_cast<int>(parts_.size()); ++b) {
      if (parts_[a].link == parts_[b].link) continue;
      const std::pair<int, int> links = std::minmax(parts_[a].link, parts_[b].link);
      if (std::find(allowed.begin(), allowed.end(), links) == allowed.end()) {
        pairs_.emplace_back(a, b);
      }
    }
  }
  placed_.resize(parts_.size());
}

void SelfCollisionGuard::place(const std::vector<double>& position) {
  kinematics_.update(position);
  for (size_t i = 0; i < parts_.size(); ++i) {
    const Eigen::Isometry3d& pose = kinematics_.link_pose(parts_[i].link);
    placed_[i] = parts_[i].box_in_link;
    placed_[i].center = pose * parts_[i].box_in_link.center;
    placed_[i].rotation = pose.linear() * parts_[i].box_in_link.rotation;
  }
}

double SelfCollisionGuard::distance(const std::pair<int, int>& pair, double enough) const {
  const auto [a, b] = pair;
  // The bounding spheres give a lower bound of the distance, which suffices if it is large.
  const double bound = (placed_[a].center - placed_[b].center).norm() - parts_[a].bounding_radius -
                       parts_[b].bounding_radius;
  return bound > enough ? bound : closest_points(placed_[a], placed_[b]).distance;
}

double SelfCollisionGuard::calc_clearance(const std::vector<double>& position) {
  place(position);
  double least = std::numeric_limits<double>::infinity();
  for (const auto& pair : pairs_) least = std::min(least, distance(pair, least));
  return least;
}

size_t SelfCollisionGuard::find_last_free(const std::vector<std::vector<double>>& path,
                                          SelfCollision& collision) {
  place(path.front());
  // Pairs that are close already in the present pose may stay as close, but come no closer.
  std::vector<double> needed;  // m, for each pair
  for (const auto& pair : pairs_) {
    needed.push_back(std::min(clearance_, distance(pair, clearance_) - kTouchTolerance));
  }
  for (size_t k = 1; k < path.size(); ++k) {
    place(path[k]);
    for (size_t i = 0; i < pairs_.size(); ++i) {
      if (distance(pairs_[i], clearance_) >= needed[i]) continue;
      const std::vector<Link>& links = kinematics_.model().links();
      collision.link_a = links[parts_[pairs_[i].first].link].name;
      collision.link_b = links[parts_[pairs_[i].second].link].name;
      std::vector<double> change = path[k];
      for (size_t m = 0; m < change.size(); ++m) change[m] -= path.front()[m];
      collision.motor = find_mover(pairs_[i], change);
      return k - 1;
    }
  }
  return path.size() - 1;
}

int SelfCollisionGuard::find_mover(const std::pair<int, int>& pair,
                                   const std::vector<double>& change) const {
  // The velocity at which the two links approach each other along the contact normal n, for a
  // change dq, is -n . (J_a - J_b) dq at the closest point; its summands are the motors'
  // contributions.
  const Proximity proximity = closest_points(placed_[pair.first], placed_[pair.second]);
  const Eigen::Matrix3Xd relative_jacobian =
      kinematics_.calc_point_jacobian(parts_[pair.first].link, proximity.point) -
      kinematics_.calc_point_jacobian(parts_[pair.second].link, proximity.point);
  int mover = -1;
  double fastest = 0;
  for (int motor = 0; motor < static_cast<int>(change.size()); ++motor) {
    const double approach = -proximity.normal.dot(relative_jacobian.col(motor)) * change[motor];
    if (mover >= 0 && approach <= fastest) continue;
    fastest = approach;
    mover = motor;
  }
  return mover;
}

}  // namespace nao::motion

#pragma once

#ifdef NDEBUG
#error "Debian's Simbody is built without NDEBUG and lays SimTK::State out differently with it."
#endif

#include <Simbody.h>

#include <Eigen/Geometry>
#include <vector>

#include "robot_model/robot_model.h"
#include "sim/tree.h"

namespace nao::sim {

/** The same vector in Simbody's type. */
inline SimTK::Vec3 to_simbody(const Eigen::Vector3d& v) {
  return {v.x(), v.y(), v.z()};
}

/** The robot as a Simbody multibody system, in which links and joints become bodies.
 *
 * Links behind fixed joints are part of the body that carries them, with their mass. A motor whose
 * link and its descendants have no mass, such as a hand's fingers, moves no body: it is an
 * *opening*. A mimic joint is a pin of its own, coupled by a constraint to the pin that it follows.
 * The Tree of the physics is made from this system, and tests compare the physics with it.
 *
 * The only header of the project that includes Simbody, whose own headers are not valid C++20:
 * sources that include it are compiled as C++17. */
class SimbodyModel {
 public:
  struct Body {
    /** Link whose frame is the body's frame. */
    int link = -1;
    /** Body index; -1 for the root. */
    int parent = -1;
    /** Joint that moves it, index into RobotModel::joints(); -1 for the root. */
    int joint = -1;
    SimTK::MobilizedBodyIndex mobilized;
  };

  /** @param model  Must outlive this. @param mass_scale  Factor on every mass and inertia, above 0.
   * @param torso_com  Displacement of the root link's center of mass, m, in its frame.
   * @throws ModelError  if a body has no mass. */
  explicit SimbodyModel(const RobotModel& model, double mass_scale = 1,
                        const Eigen::Vector3d& torso_com = Eigen::Vector3d::Zero());
  SimbodyModel(const SimbodyModel&) = delete;
  SimbodyModel& operator=(const SimbodyModel&) = delete;

  const RobotModel& robot() const { return robot_; }
  /** Depth first: parents before children, each limb's bodies one after the other; the first is the
   * root. */
  const std::vector<Body>& bodies() const { return bodies_; }
  /** Body that carries a link, and the link's frame in it (openings at 0). */
  int body_of_link(int link) const { return link_body_[link]; }
  const Eigen::Isometry3d& pose_in_body(int link) const { return link_pose_[link]; }

  const SimTK::MultibodySystem& system() const { return system_; }
  /** To add forces; realize its topology again afterwards. */
  SimTK::MultibodySystem& system() { return system_; }
  const SimTK::SimbodyMatterSubsystem& matter() const { return matter_; }
  const SimTK::MobilizedBody& mobilized(int body) const {
    return matter_.getMobilizedBody(bodies_[body].mobilized);
  }
  /** State as realized to Stage::Model, root at the world's origin, all else 0. */
  const SimTK::State& default_state() const { return system_.getDefaultState(); }

  /** Writes a tree's position and velocity into a Simbody state, mimic joints included. */
  void set_state(const Tree& tree, const TreeState& from, SimTK::State& state) const;

 private:
  void add_body(int link, int parent, int joint, double mass_scale);
  void collect_fixed(int link, int body, const Eigen::Isometry3d& pose_in_body);
  double subtree_mass(int link) const;

  const RobotModel& robot_;
  Eigen::Vector3d torso_com_;
  SimTK::MultibodySystem system_;
  SimTK::SimbodyMatterSubsystem matter_;
  std::vector<Body> bodies_;
  std::vector<int> link_body_;
  std::vector<Eigen::Isometry3d> link_pose_;
};

}  // namespace nao::sim

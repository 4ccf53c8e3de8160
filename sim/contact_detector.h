#pragma once

#include <cstdint>
#include <vector>

#include "sim/contact_candidates.h"
#include "sim/floor.h"
#include "sim/goal_shapes.h"
#include "sim/island.h"
#include "sim/moving_bodies.h"

namespace nao::sim {

/** Finds the contact candidates of a step between floor, robots, ball and goals, and keeps the
 * memory of every possible contact.
 *
 * Broad phase: bounding spheres, pair by pair, of a robot's own parts those that are near. Narrow
 * phase: against the floor each part's points (CollisionModel::Point), between two parts
 * closest_points(), unless the axis along which they were apart in an earlier step shows that they
 * cannot touch in this one. */
class ContactDetector {
 public:
  /** Collision margin: a candidate is made when surfaces will be nearer than this after the step,
   * m. A candidate at a positive distance carries no force before it is closed, so that a larger
   * margin only costs rows; with a smaller one a resting contact may be missed in some steps.
   * Chosen: the depth at which a contact's spring (Materials::contact_stiffness) carries 10 N. */
  static constexpr double kMargin = 0.0005;

  /** @param bodies  Must outlive this. @param step  Length of a step, s. */
  ContactDetector(const SceneFile& scene, const MovingBodies& bodies, const Floor& floor,
                  double step);

  /** Makes room for the robot that was added last. */
  void add_robot();
  /** Forgets a robot; those after it move up. */
  void remove_robot(int robot);
  /** Whether two robots may touch within a number of steps, or a robot the ball, as far as their
   * bounding spheres tell. */
  bool are_near(int robot_a, int robot_b, int num_steps) const;
  bool is_near_ball(int robot, int num_steps) const;

  // These may be called for different islands at the same time.

  /** Adds the candidates of an island, with positions and velocities at the step's start, in a
   * fixed order. */
  void find(const Island& island, ContactCandidates& found);
  /** Adds candidates for a robot's points that would be in the floor after the step with the
   * velocities that its dynamics has now, and are not candidates yet.
   * @return Whether there were any. */
  bool find_missed_floor_contacts(int robot, ContactCandidates& found);

  /** Forgets the contacts of a robot with the floor and itself: it was placed somewhere else. */
  void forget_robot(int robot);
  /** Forgets the ball's contact with the floor: it was placed somewhere else. */
  void forget_ball();
  /** Forgets all contacts. */
  void clear();

 private:
  /** A part in W. Rotation and size are filled in when the narrow phase needs them. */
  struct PlacedPart {
    RoundedBox shape;
    bool has_rotation = false;
  };
  /** Memories of one robot's possible contacts: of each point with the floor, each pair of its own
   * parts, each part with each static shape (static shape major), and each part with the ball. */
  struct RobotMemory {
    std::vector<ContactMemory> floor;
    /** Distance of each point from the floor, m, of parts that are near it. */
    std::vector<double> floor_distance;
    /** Least of these, of each part's points that are no candidates. */
    std::vector<double> nearest_free;
    std::vector<ContactMemory> self;
    /** Distance of the centers of each pair of its own parts beyond which the pair's bounding
     * spheres are apart, m. */
    std::vector<double> self_reach;
    /** Pairs of its own parts that were near when the parts' centers, from the root and along W's
     * axes, m, were these. */
    std::vector<size_t> near_pairs;
    std::vector<Eigen::Vector3d> listed_centers;
    std::vector<ContactMemory> statics;
    std::vector<ContactMemory> ball;
  };
  /** Memories of two robots' possible contacts, a < b: each part of a with each of b (a major). */
  struct PairMemory {
    int a;
    int b;
    std::vector<ContactMemory> parts;
  };

  /** Upper bounds of how far a body turns within the step, rad, and how far a point of it moves
   * that is within a radius, m, of another one, in W. */
  double greatest_turn(const TreeDynamics& dynamics, int body) const;
  double greatest_move(const TreeDynamics& dynamics, int body, const Eigen::Vector3d& point,
                       double radius) const;
  void place_parts(int robot);
  const RoundedBox& part_shape(int robot, int part);
  /** Pairs of a robot's own parts that may touch within the step: indices of self_pairs. */
  const std::vector<size_t>& list_near_pairs(int robot);
  /** Whether parts of two robots, or of one, cannot touch within the step, as far as the axis tells
   * along which they were apart. false: their distance is to be measured. */
  bool are_apart(int robot_a, int part_a, int robot_b, int part_b, const ContactMemory& memory);
  /** Distance and normal between a sphere and the floor. @param center  In W, m. */
  Proximity to_floor(const Eigen::Vector3d& center, double radius) const;
  void find_floor_contacts(int robot, ContactCandidates& found);
  /** Sets floor_distance of a part's points. */
  void measure_floor_distances(int robot, const CollisionModel::Part& part);
  void find_self_contacts(int robot, ContactCandidates& found);
  void find_goal_contacts(int robot, ContactCandidates& found);
  void find_robot_contacts(PairMemory& pair, ContactCandidates& found);
  void find_ball_contacts(const Island& island, ContactCandidates& found);
  /** Adds a candidate if the surfaces will be within the margin after the step.
   * @return Whether they will be. */
  bool add(const Surface& a, int body_a, const Surface& b, int body_b, const Proximity& proximity,
           int foot, ContactMemory& memory, ContactCandidates& found) const;
  Eigen::Vector3d velocity_of(const Surface& surface, int body, const Eigen::Vector3d& point) const;

  const MovingBodies& bodies_;
  Floor floor_;
  double step_;
  std::vector<StaticShape> statics_;
  /** Parts of each robot. */
  std::vector<std::vector<PlacedPart>> placed_;
  std::vector<RobotMemory> robot_memory_;
  /** Memories of the pairs (0, 1), (0, 2), (1, 2), (0, 3)... */
  std::vector<PairMemory> pair_memory_;
  ContactMemory ball_floor_memory_;
  std::vector<ContactMemory> ball_static_memory_;
};

}  // namespace nao::sim

#pragma once

#include <cstdint>
#include <vector>

#include "sim/contact.h"
#include "sim/floor.h"
#include "sim/goal_shapes.h"
#include "sim/moving_bodies.h"

namespace nao::sim {

/** Finds the contact candidates of a step between floor, robots, ball and goals, and keeps the
 * memory of every possible contact.
 *
 * Broad phase: bounding spheres, pair by pair. Narrow phase: against the floor each part's points
 * (CollisionModel::Point), between two parts closest_points(). */
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
  /** Takes memory for the candidates of a step; more are dropped and counted. */
  void reserve(int max_candidates) { candidates_.reserve(max_candidates); }

  /** Finds the candidates of a step, with the robots' positions and velocities at its start.
   * @param step_number  Rising by 1 from step to step. */
  void find(int64_t step_number);
  /** Adds candidates for a robot's points that would be in the floor after the step with the
   * velocities that its dynamics has now, and are no candidates yet.
   * @return Whether there were any. */
  bool find_missed_floor_contacts(int robot);

  /** Of this step, in a fixed order. Elements stay where they are until the next find(). */
  const std::vector<ContactCandidate>& candidates() const { return candidates_; }
  /** Candidates beyond the memory since the last clear(): they carry no force. */
  int64_t num_dropped() const { return num_dropped_; }

  /** Forgets the contacts of a robot with the floor and itself: it was placed somewhere else. */
  void forget_robot(int robot);
  /** Forgets the ball's contact with the floor: it was placed somewhere else. */
  void forget_ball();
  /** Forgets all contacts and counts from 0 again. */
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
    std::vector<ContactMemory> self;
    std::vector<ContactMemory> statics;
    std::vector<ContactMemory> ball;
  };
  /** Memories of two robots' possible contacts: each part of a with each of b (a major). */
  struct PairMemory {
    int a;
    int b;
    std::vector<ContactMemory> parts;
  };

  void place_parts(int robot);
  const RoundedBox& part_shape(int robot, int part);
  /** Distance and normal between a sphere and the floor. @param center  In W, m. */
  Proximity to_floor(const Eigen::Vector3d& center, double radius) const;
  void find_floor_contacts(int robot);
  void find_self_contacts(int robot);
  void find_goal_contacts(int robot);
  void find_robot_contacts(PairMemory& pair);
  void find_ball_contacts();
  /** Adds a candidate if the surfaces will be within the margin after the step. */
  void add(const Surface& a, int body_a, const Surface& b, int body_b, const Proximity& proximity,
           int foot, ContactMemory& memory);
  Eigen::Vector3d velocity_of(const Surface& surface, int body, const Eigen::Vector3d& point) const;

  const MovingBodies& bodies_;
  Floor floor_;
  double step_;
  std::vector<StaticShape> statics_;
  int64_t step_number_ = 0;
  int64_t num_dropped_ = 0;
  std::vector<ContactCandidate> candidates_;
  /** Parts of each robot. */
  std::vector<std::vector<PlacedPart>> placed_;
  std::vector<RobotMemory> robot_memory_;
  std::vector<PairMemory> pair_memory_;
  ContactMemory ball_floor_memory_;
  std::vector<ContactMemory> ball_static_memory_;
};

}  // namespace nao::sim

#include "sim/disturbance_draw.h"

#include <algorithm>
#include <cmath>

namespace nao::sim {
namespace {

using Eigen::Vector3d;

/** Friction, mass and latency take the first three numbers of the seed's own sequence, one each, so
 * that a seed means the same robot as before there were other disturbances. */
constexpr Disturbance kShared[kNumSharedDraws] = {Disturbance::kFriction, Disturbance::kMassScale,
                                                  Disturbance::kCommandLatencyMs};

/** The stream of random numbers of one disturbance. */
// Each disturbance has its own stream, a function of name and seed alone: switching one disturbance
// on or off leaves the numbers of all others unchanged, so that runs stay comparable.
Random stream(Disturbance disturbance, uint64_t seed) {
  for (int i = 0; i < kNumSharedDraws; ++i) {
    if (kShared[i] != disturbance) continue;
    Random random(seed);
    for (int k = 0; k < i; ++k) random.next();
    return random;
  }
  // The name's FNV-1a hash, so that further disturbances do not change the others' numbers.
  uint64_t hash = 14695981039346656037u;
  for (const char* c = disturbance_names()[static_cast<size_t>(disturbance)]; *c != 0; ++c) {
    // Constants of FNV-1a, 64 bits: offset basis and prime.
    hash = (hash ^ static_cast<unsigned char>(*c)) * 1099511628211u;
  }
  // One step of the generator mixes seed and hash, so that neighboring seeds have unrelated
  // streams.
  return Random(Random(seed ^ hash).next());
}

/** One number, or what holds without the disturbance. */
double draw(const DisturbanceSet& set, Disturbance disturbance, uint64_t seed, double otherwise) {
  const auto& entry = set.entry(disturbance);
  if (!entry) return otherwise;
  Random random = stream(disturbance, seed);
  return entry->draw(random);
}

/** A number for each of `count`; empty without the disturbance. */
Eigen::VectorXd draw_each(const DisturbanceSet& set, Disturbance disturbance, uint64_t seed,
                          long count) {
  const auto& entry = set.entry(disturbance);
  if (!entry) return {};
  Random random = stream(disturbance, seed);
  Eigen::VectorXd drawn(count);
  for (double& each : drawn) each = entry->draw(random);
  return drawn;
}

// Three numbers for the axes x, y, z, or `otherwise` without the disturbance.
Vector3d draw_axes(const DisturbanceSet& set, Disturbance disturbance, uint64_t seed,
                   const Vector3d& otherwise) {
  const Eigen::VectorXd drawn = draw_each(set, disturbance, seed, 3);
  return drawn.size() == 3 ? Vector3d(drawn) : otherwise;
}

/** Class of a motor's joint by the last word of the joint group that robot.yaml lists it in: "left
 * knee". Groups that are not part of a leg or head belong to the arms. */
Disturbance backlash_of(const RobotModel& model, int motor) {
  for (const JointGroup& group : model.joint_groups()) {
    if (group.yaw_motor != motor && group.pitch_motor != motor && group.roll_motor != motor) {
      continue;
    }
    const std::string part = group.name.substr(group.name.find_last_of(' ') + 1);
    if (part == "hip") return Disturbance::kBacklashHip;
    if (part == "knee") return Disturbance::kBacklashKnee;
    if (part == "ankle") return Disturbance::kBacklashAnkle;
    if (part == "head") return Disturbance::kBacklashHead;
  }
  return Disturbance::kBacklashArm;
}

Eigen::VectorXd draw_backlash(const DisturbanceSet& set, uint64_t seed, const RobotModel& model) {
  Eigen::VectorXd play = Eigen::VectorXd::Zero(model.num_motors());
  for (const Disturbance part :
       {Disturbance::kBacklashHip, Disturbance::kBacklashKnee, Disturbance::kBacklashAnkle,
        Disturbance::kBacklashArm, Disturbance::kBacklashHead}) {
    const Eigen::VectorXd drawn = draw_each(set, part, seed, model.num_motors());
    // All motors draw, and the class keeps its own: a motor's number does not depend on how many
    // motors other classes have.
    for (int motor = 0; motor < drawn.size(); ++motor) {
      if (backlash_of(model, motor) == part) play[motor] = drawn[motor];
    }
  }
  return play.isZero(0) ? Eigen::VectorXd() : play;
}

// A factor for each motor; empty without the disturbance. The motors of a joint group share one, a
// motor that is in no group has its own, and one that is in two groups has the first's.
Eigen::VectorXd draw_servo(const DisturbanceSet& set, Disturbance gain, uint64_t seed,
                           const RobotModel& model) {
  const std::vector<JointGroup>& groups = model.joint_groups();
  const auto num_groups = static_cast<long>(groups.size());
  const Eigen::VectorXd drawn = draw_each(set, gain, seed, num_groups + model.num_motors());
  if (drawn.size() == 0) return {};
  Eigen::VectorXd factor = drawn.tail(model.num_motors());
  for (long i = num_groups - 1; i >= 0; --i) {
    for (const int motor : {groups[i].yaw_motor, groups[i].pitch_motor, groups[i].roll_motor}) {
      if (motor >= 0) factor[motor] = drawn[i];
    }
  }
  return factor;
}

// Scale of each foot sensor's reading, 1 being exact; at most one sensor of the robot is dead
// (scale 0). Empty if all are exact.
Eigen::VectorXd draw_foot_sensors(const DisturbanceSet& set, uint64_t seed,
                                  const RobotModel& model) {
  const auto count = static_cast<long>(model.foot_sensors().size());
  Eigen::VectorXd scale = draw_each(set, Disturbance::kFootSensorScale, seed, count);
  const auto& dead = set.entry(Disturbance::kFootSensorDeadProbability);
  if (!dead || count == 0) return scale;
  Random random = stream(Disturbance::kFootSensorDeadProbability, seed);
  const double probability = dead->draw(random);
  // Both numbers are drawn in any case, so that which sensor would die does not depend on the
  // probability.
  const bool has_dead_sensor = random.uniform() < probability;
  const auto which = static_cast<long>(random.uniform() * static_cast<double>(count));
  if (!has_dead_sensor) return scale;
  if (scale.size() == 0) scale = Eigen::VectorXd::Ones(count);
  scale[which] = 0;
  return scale;
}

}  // namespace

void draw_world(const DisturbanceSet& set, uint64_t seed, WorldOptions& options) {
  if (const auto& slope = set.entry(Disturbance::kFloorSlope)) {
    Random random = stream(Disturbance::kFloorSlope, seed);
    // Gravity of a floor that slopes by `angle` rad, downhill in the direction `downhill` rad from
    // x: seen from the floor's own axes the weight leans by that angle. That equals a tilted floor
    // without changing any contact code.
    const double angle = slope->draw(random);
    const double downhill = random.uniform(-M_PI, M_PI);
    // The floor stays level in W, and gravity is tilted.
    options.gravity =
        options.gravity.norm() * Vector3d(std::sin(angle) * std::cos(downhill),
                                          std::sin(angle) * std::sin(downhill), -std::cos(angle));
  }
  FloorOptions& floor = options.floor;
  floor.bump_height = draw(set, Disturbance::kFloorBumpHeight, seed, floor.bump_height);
  floor.bump_grid = draw(set, Disturbance::kFloorBumpGrid, seed, floor.bump_grid);
  if (floor.bump_height > 0) {
    // 53 bits: programs that keep numbers as doubles can repeat the floor too.
    floor.seed = Random(seed ^ 0x666c6f6f72u).next() >> 11;
  }
  Materials& materials = options.materials;
  if (set.entry(Disturbance::kContactStiffness)) {
    const double stiffness = draw(set, Disturbance::kContactStiffness, seed, 0);
    // Friction along the surface is as stiff relative to pressing as before.
    materials.tangent_stiffness *= stiffness / materials.contact_stiffness;
    materials.contact_stiffness = stiffness;
  }
  if (set.entry(Disturbance::kTickMs)) {
    // The control period is a whole number of physics steps.
    const double tick = draw(set, Disturbance::kTickMs, seed, 0) * 1e-3;
    options.steps_per_tick = std::max(1, static_cast<int>(std::lround(tick / options.step)));
  }
}

void draw_robot(const DisturbanceSet& set, uint64_t seed, int index, const RobotModel& model,
                const WorldOptions& world, RobotOptions& options) {
  if (set.is_none()) {
    // Further robots draw from seeds of their own: identical robots would fall in the same way.
    options.ideal_sensors = true;
    options.command_latency_ticks = 0;
    return;
  }
  if (index > 0) seed = Random(seed + static_cast<uint64_t>(index)).next();
  const double nominal_friction = world.materials.floor_friction;
  // The draw is the coefficient itself; the options hold its ratio to the scene's.
  options.friction_scale =
      draw(set, Disturbance::kFriction, seed, options.friction_scale * nominal_friction) /
      nominal_friction;
  options.mass_scale = draw(set, Disturbance::kMassScale, seed, options.mass_scale);
  options.torque_scale = draw(set, Disturbance::kTorqueScale, seed, options.torque_scale);
  if (set.entry(Disturbance::kCommandLatencyMs)) {
    const double latency = draw(set, Disturbance::kCommandLatencyMs, seed, 0);
    const double ticks = latency / (1e3 * world.period());
    options.command_latency_ticks =
        std::clamp(static_cast<int>(std::lround(ticks)), 0, kMaxCommandLatencyTicks);
  }

  RobotErrors& errors = options.errors;
  errors.backlash = draw_backlash(set, seed, model);
  errors.joint_zero = draw_each(set, Disturbance::kJointZero, seed, model.num_motors());
  errors.servo_stiffness = draw_servo(set, Disturbance::kServoStiffness, seed, model);
  errors.servo_damping = draw_servo(set, Disturbance::kServoDamping, seed, model);
  errors.imu_mount = draw_axes(set, Disturbance::kImuMount, seed, Vector3d::Zero());
  errors.gyroscope_scale = draw_axes(set, Disturbance::kGyroscopeScale, seed, Vector3d::Ones());
  errors.gyroscope_offset = draw_axes(set, Disturbance::kGyroscopeOffset, seed, Vector3d::Zero());
  errors.accelerometer_scale =
      draw_axes(set, Disturbance::kAccelerometerScale, seed, Vector3d::Ones());
  errors.imu_alternates = draw(set, Disturbance::kImuAlternate, seed, 0) >= 0.5;
  errors.foot_sensor_scale = draw_foot_sensors(set, seed, model);
  errors.torso_com = draw_axes(set, Disturbance::kTorsoCom, seed, Vector3d::Zero());
  errors.sensor_loss = draw(set, Disturbance::kSensorLoss, seed, 0);
  errors.command_loss = draw(set, Disturbance::kCommandLoss, seed, 0);
}

}  // namespace nao::sim

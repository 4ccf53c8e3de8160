#include "tools/nao-tools/self_test.h"

#include <naolcm/body_state_t.hpp>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <string>

#include "common/constants.h"
#include "tools/nao/text_table.h"

namespace nao {
namespace {

/** Change of each joint, rad, and of a hand's opening. */
constexpr double kChange = 2 * kDegree;
constexpr double kOpeningChange = 0.1;
/** Fraction of the greatest speed. Chosen: slow enough for a hand in the way. */
constexpr double kSpeed = 0.1;
/** Times of the phases, s. Chosen: the servos settle within 0.3 s; 0.2 s are 17 frames of a NAO. */
constexpr double kRestTime = 2.0;
constexpr double kSettleTime = 0.3;
constexpr double kMeanTime = 0.2;
/** Part of the change by which the encoder may differ. Chosen: play of good NAO V6 is 1.0 to 1.4
 * degrees in the legs (B-Human), and a loaded joint deflects. */
constexpr double kTolerance = 0.6;
/** The same of a leg on which the robot stands. Legs and ground are then a closed chain, in which a
 * single joint turns by 0.7 to 1.7 of 2 degrees (in simulation). */
constexpr double kLoadedTolerance = 0.8;
/** Part of the change below which a joint does not move. */
constexpr double kStill = 0.2;
/** Another joint that turns by this part of the change is wired in this one's place. Chosen: the
 * other joints of a standing robot move less. */
constexpr double kOtherJoint = 0.7;
/** Tolerance of gravity, m/s^2, and of the angle between the accelerometer and the orientation,
 * rad. Chosen: NAOs' accelerometers differ by about 2 % and 2 degrees. */
constexpr double kGravityTolerance = 0.5;
constexpr double kTiltTolerance = 5 * kDegree;
/** Gyroscopes of NAO V6 are sometimes off by more than 3 degrees/s until they are restarted
 * (B-Human). */
constexpr double kGyroscopeOffset = 3 * kDegree;
/** Standard deviations above which the robot is not at rest, or the sensor is bad, m/s^2 and rad/s.
 * Chosen: 25 times the noise that B-Human measured (0.019 and 0.0020). */
constexpr double kAccelerometerNoise = 0.5;
constexpr double kGyroscopeNoise = 0.05;
/** Ratios of the feet's sum to the weight that are plausible. Chosen: sensors differ in scale. */
constexpr double kLeastWeight = 0.5;
constexpr double kGreatestWeight = 1.5;
/** Below this ratio the feet carry nothing: the robot hangs, sits or lies. */
constexpr double kNoWeight = 0.15;
/** Force below which a sensor of a loaded foot reads nothing, N. */
constexpr double kNoForce = 0.1;
/** Least images a second, and least bytes of an image 320 pixels wide that shows something. Chosen:
 * half of the requested rate; a JPEG file of one color has 1.5 kB. */
constexpr double kLeastRate = 2.5;
constexpr int kLeastBytes = 2000;

std::string degrees(double angle) {
  return format_number(angle / kDegree, 1);
}

/** @param faults  What is wrong, and whether it is so: the first one that holds counts. */
SelfTestFinding judge(const std::string& item, const std::string& measured,
                      std::initializer_list<std::pair<bool, std::string>> faults) {
  for (const auto& [holds, text] : faults) {
    if (holds) return {item, SelfTestFinding::Verdict::kFault, text};
  }
  return {item, SelfTestFinding::Verdict::kOk, measured};
}

}  // namespace

void SelfTest::Means::add(const SelfTestSample& sample) {
  const auto add_list = [](const std::vector<double>& values, std::vector<double>& sums) {
    sums.resize(values.size(), 0);
    for (size_t i = 0; i < values.size(); ++i) sums[i] += values[i];
  };
  add_list(sample.position, position);
  std::vector<double> errors = sample.position;
  for (size_t i = 0; i < std::min(errors.size(), sample.target_position.size()); ++i) {
    errors[i] -= sample.target_position[i];
  }
  add_list(errors, target_error);
  add_list(sample.foot_force, foot_force);
  accelerometer += sample.accelerometer;
  gyroscope += sample.gyroscope;
  accelerometer_square += sample.accelerometer.squaredNorm();
  gyroscope_square += sample.gyroscope.squaredNorm();
  up += sample.orientation_torso_in_world.conjugate() * Eigen::Vector3d::UnitZ();
  ++num_samples;
}

void SelfTest::Means::finish() {
  const double factor = 1.0 / std::max(1, num_samples);
  for (std::vector<double>* list : {&position, &target_error, &foot_force}) {
    for (double& value : *list) value *= factor;
  }
  accelerometer *= factor;
  gyroscope *= factor;
  accelerometer_square *= factor;
  gyroscope_square *= factor;
  up *= factor;
}

SelfTest::SelfTest(const RobotModel& model)
    : model_(model), is_opening_(static_cast<size_t>(model.num_motors()), false) {
  for (const JointGroup& group : model.joint_groups()) {
    if (group.is_opening) is_opening_[static_cast<size_t>(group.pitch_motor)] = true;
  }
}

void SelfTest::enter(Phase phase) {
  phase_ = phase;
  time_ = 0;
  is_sent_ = false;
  if (phase == Phase::kBefore) {
    before_ = {};
    greatest_current_ = 0;
    refusal_.clear();
  }
  if (phase == Phase::kAfter) after_ = {};
}

void SelfTest::measure(const SelfTestSample& sample, double dt) {
  if (is_done() || sample.position.size() != static_cast<size_t>(model_.num_motors())) return;
  time_ += dt;
  total_time_ += dt;
  last_position_ = sample.position;
  switch (phase_) {
    case Phase::kRest:
      rest_.add(sample);
      if (time_ < kRestTime) return;
      rest_.finish();
      return enter(Phase::kBefore);
    case Phase::kBefore:
      before_.add(sample);
      if (time_ < kMeanTime) return;
      before_.finish();
      {
        // Away from the nearer limit.
        const Joint& joint = model_.motor_joint(motor_);
        const double measured = before_.position[static_cast<size_t>(motor_)];
        const double position = std::isfinite(measured) ? measured : joint.lower;
        direction_ = joint.upper - position > position - joint.lower ? 1 : -1;
      }
      return enter(Phase::kGoing);
    case Phase::kSettling:
      if (time_ >= kSettleTime) enter(Phase::kAfter);
      return;
    case Phase::kAfter:
      after_.add(sample);
      if (time_ < kMeanTime) return;
      after_.finish();
      joints_.push_back(judge_joint());
      return enter(Phase::kReturning);
    default:
      return;  // a command is being executed
  }
}

void SelfTest::measure(const SelfTestMotors& motors) {
  motors_ = motors;
  const auto index = static_cast<size_t>(motor_);
  if (index < motors.current.size() && std::isfinite(motors.current[index])) {
    greatest_current_ = std::max(greatest_current_, std::abs(motors.current[index]));
  }
}

void SelfTest::add_image(const std::string& camera, int num_bytes) {
  auto& [count, smallest] =
      images_.try_emplace(camera, 0, std::numeric_limits<int>::max()).first->second;
  ++count;
  smallest = std::min(smallest, num_bytes);
}

JointChangeCommand SelfTest::change(double sign) const {
  const Joint& joint = model_.motor_joint(motor_);
  JointChangeCommand command;
  command.joint_names = {joint.name};
  command.joint_position = {sign *
                            (is_opening_[static_cast<size_t>(motor_)] ? kOpeningChange : kChange)};
  command.is_relative = true;
  command.speed = kSpeed;
  return command;
}

std::optional<JointChangeCommand> SelfTest::next_command() {
  if (is_sent_ || (phase_ != Phase::kGoing && phase_ != Phase::kReturning)) return std::nullopt;
  is_sent_ = true;
  return change(phase_ == Phase::kGoing ? direction_ : -direction_);
}

void SelfTest::end_command(const std::string& fault) {
  if (phase_ == Phase::kReturning) return end_joint();
  if (phase_ != Phase::kGoing) return;
  if (fault.empty()) return enter(Phase::kSettling);
  // Once more in the other direction: the first one may be blocked by the robot itself.
  if (refusal_.empty()) {
    refusal_ = fault;
    direction_ = -direction_;
    is_sent_ = false;
    return;
  }
  joints_.push_back(
      {"joint " + model_.motor_joint(motor_).name, SelfTestFinding::Verdict::kNotTested, refusal_});
  end_joint();
}

void SelfTest::end_joint() {
  ++motor_;
  enter(motor_ < model_.num_motors() ? Phase::kBefore : Phase::kDone);
}

double SelfTest::progress() const {
  return static_cast<double>(motor_) / model_.num_motors();
}

bool SelfTest::is_loaded_leg(int motor) const {
  double force = 0;
  for (const double part : rest_.foot_force) force += std::isfinite(part) ? part : 0;
  if (force < kNoWeight * model_.total_mass() * kGravity) return false;
  const int joint = model_.motors()[static_cast<size_t>(motor)];
  return std::any_of(model_.legs().begin(), model_.legs().end(), [&](const LegDescription& leg) {
    return std::find(leg.joints.begin(), leg.joints.end(), joint) != leg.joints.end();
  });
}

SelfTestFinding SelfTest::judge_joint() const {
  const auto index = static_cast<size_t>(motor_);
  const Joint& joint = model_.motor_joint(motor_);
  const double commanded = direction_ * (is_opening_[index] ? kOpeningChange : kChange);
  // Fraction of the commanded change that the joint has moved.
  const double moved = (after_.position[index] - before_.position[index]) / commanded;
  std::string measured = is_opening_[index] ? "opened by " + format_number(moved * commanded, 2) +
                                                  " of " + format_number(commanded, 2)
                                            : "moved by " + degrees(moved * commanded) + " of " +
                                                  degrees(commanded) + " degrees";
  if (motors_) {
    measured += ", " + format_number(greatest_current_, 2) + " A";
    if (index < motors_->temperature.size()) {
      measured += ", " + format_number(motors_->temperature[index], 0) + " degrees Celsius";
    }
  }
  // The joint that moved most beside this one.
  size_t other = index;
  double other_moved = 0;
  for (size_t i = 0; i < after_.position.size(); ++i) {
    const double change = std::abs(after_.position[i] - before_.position[i]);
    if (i == index || is_opening_[i]) continue;
    if (change > other_moved) {
      other = i;
      other_moved = change;
    }
  }
  const int8_t status = motors_ && index < motors_->status.size() ? motors_->status[index] : 0;
  const bool is_still = std::abs(moved) < kStill;
  const bool is_without_current = motors_ && greatest_current_ == 0;
  const double tolerance = is_loaded_leg(motor_) ? kLoadedTolerance : kTolerance;
  return judge(
      "joint " + joint.name, measured,
      {{!std::isfinite(moved), "the encoder gives no number"},
       {is_still && other != index && other_moved > kOtherJoint * kChange,
        "does not move; " + model_.motor_joint(static_cast<int>(other)).name + " moves instead"},
       {is_still,
        "does not move: " + measured + (is_without_current ? "; the motor draws no current" : "")},
       {moved < 0, "moves the wrong way: " + measured},
       {std::abs(moved - 1) > tolerance, measured},
       {status == naolcm::body_state_t::JOINT_STATUS_DEAD,
        "the motor does not answer: " + measured},
       {status != naolcm::body_state_t::JOINT_STATUS_OK,
        "the motor is hot or limited: " + measured}});
}

// At rest the specific force is gravity's reaction: upward, 9.81 m/s^2.
SelfTestFinding SelfTest::judge_accelerometer() const {
  const double size = rest_.accelerometer.norm();
  const double variance = rest_.accelerometer_square - rest_.accelerometer.squaredNorm();
  const double noise = std::sqrt(std::max(0.0, variance));
  const double cosine = rest_.accelerometer.dot(rest_.up) / (size * rest_.up.norm());
  const double angle = std::acos(std::clamp(cosine, -1.0, 1.0));
  const std::string measured = "measures " + format_number(size, 2) + " m/s^2, deviation " +
                               format_number(noise, 2) + ", " + degrees(angle) +
                               " degrees from the orientation's vertical";
  return judge(
      "accelerometer", measured,
      {{!rest_.accelerometer.allFinite() || size == 0, "gives no numbers"},
       {std::abs(size - kGravity) > kGravityTolerance, "does not measure gravity: " + measured},
       {!(angle <= kTiltTolerance), "disagrees with the orientation: " + measured},
       {noise > kAccelerometerNoise, "is not at rest: " + measured}});
}

SelfTestFinding SelfTest::judge_gyroscope() const {
  const double offset = rest_.gyroscope.norm();
  const double noise =
      std::sqrt(std::max(0.0, rest_.gyroscope_square - rest_.gyroscope.squaredNorm()));
  const std::string measured =
      "offset " + degrees(offset) + ", deviation " + degrees(noise) + " degrees/s";
  return judge("gyroscope", measured,
               {{!rest_.gyroscope.allFinite(), "gives no numbers"},
                {offset > kGyroscopeOffset, "is off at rest, restart the robot: " + measured},
                {noise > kGyroscopeNoise, "is not at rest: " + measured}});
}

void SelfTest::judge_feet(std::vector<SelfTestFinding>& findings) const {
  if (rest_.foot_force.empty()) return;
  const double weight = model_.total_mass() * kGravity;
  double sum = 0;
  for (const double force : rest_.foot_force) sum += std::isfinite(force) ? force : 0;
  const std::string measured = "together " + format_number(sum, 1) + " N, the robot weighs " +
                               format_number(weight, 1) + " N";
  const bool is_unloaded = sum < kNoWeight * weight;
  for (size_t i = 0; i < rest_.foot_force.size(); ++i) {
    const int link = model_.foot_sensors()[i];
    const double force = rest_.foot_force[i];
    SelfTestFinding finding{"foot sensor " + model_.links()[static_cast<size_t>(link)].name,
                            SelfTestFinding::Verdict::kOk,
                            "carries " + format_number(force, 1) + " N"};
    if (!std::isfinite(force)) {
      finding.verdict = SelfTestFinding::Verdict::kFault;
      finding.text = "gives no number";
    } else if (is_unloaded) {
      finding.verdict = SelfTestFinding::Verdict::kNotTested;
      finding.text += ": the feet carry nothing, let the robot stand";
    } else if (force < kNoForce) {
      finding.verdict = SelfTestFinding::Verdict::kFault;
      finding.text = "reads nothing while the robot stands";
    }
    findings.push_back(finding);
  }
  if (is_unloaded) return;
  const double ratio = sum / weight;
  const bool is_plausible = ratio >= kLeastWeight && ratio <= kGreatestWeight;
  findings.push_back(
      {"foot sensors",
       is_plausible ? SelfTestFinding::Verdict::kOk : SelfTestFinding::Verdict::kFault, measured});
}

SelfTestFinding SelfTest::judge_camera(const std::string& camera) const {
  const auto found = images_.find(camera);
  if (found == images_.end()) return judge("camera " + camera, "", {{true, "sends no images"}});
  const auto& [count, smallest] = found->second;
  const double rate = count / std::max(total_time_, kRestTime);
  const std::string measured = "sent " + std::to_string(count) + " images, " +
                               format_number(rate, 1) + " a second, of " +
                               format_number(smallest / 1e3, 1) + " kB or more";
  return judge("camera " + camera, measured,
               {{smallest < kLeastBytes, "shows nothing: " + measured},
                {rate < kLeastRate, "is slow: " + measured}});
}

std::vector<SelfTestFinding> SelfTest::findings() const {
  std::vector<SelfTestFinding> findings = joints_;
  findings.push_back(judge_accelerometer());
  findings.push_back(judge_gyroscope());
  judge_feet(findings);
  for (const CameraModel& camera : model_.cameras()) {
    findings.push_back(judge_camera(camera.name));
  }
  return findings;
}

std::string to_table(const std::vector<SelfTestFinding>& findings) {
  std::vector<std::vector<std::string>> rows{{"item", "result", "measured"}};
  int num_faults = 0;
  int num_untested = 0;
  for (const SelfTestFinding& finding : findings) {
    const bool is_fault = finding.verdict == SelfTestFinding::Verdict::kFault;
    const bool is_untested = finding.verdict == SelfTestFinding::Verdict::kNotTested;
    num_faults += is_fault ? 1 : 0;
    num_untested += is_untested ? 1 : 0;
    rows.push_back({finding.item,
                    is_fault      ? "FAULT"
                    : is_untested ? "not tested"
                                  : "ok",
                    finding.text});
  }
  return format_table(rows) + std::to_string(num_faults) + " faults, " +
         std::to_string(num_untested) + " not tested, of " + std::to_string(findings.size()) + "\n";
}

}  // namespace nao

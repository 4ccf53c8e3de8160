#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "messages/command.h"
#include "robot_model/robot_model.h"

namespace nao {

/** What a sensor state says, in motor order and in the order of RobotModel::foot_sensors(). */
struct SelfTestSample {
  /** rad (hands: opening). */
  std::vector<double> position;
  std::vector<double> target_position;
  /** Specific force, m/s^2, and angular velocity, rad/s, torso frame. */
  Eigen::Vector3d accelerometer{0, 0, 9.81};
  Eigen::Vector3d gyroscope = Eigen::Vector3d::Zero();
  Eigen::Quaterniond orientation_torso_in_world = Eigen::Quaterniond::Identity();
  /** N. */
  std::vector<double> foot_force;
};

/** What a body state says of the motors, in motor order. */
struct SelfTestMotors {
  /** A, degrees Celsius; NaN: not measured. */
  std::vector<double> current;
  std::vector<double> temperature;
  /** body_state_t's JOINT_STATUS_*. */
  std::vector<int8_t> status;
};

/** One line of the result. */
struct SelfTestFinding {
  enum class Verdict { kOk, kFault, kNotTested };
  /** "joint HeadYaw", "accelerometer", "camera top". */
  std::string item;
  Verdict verdict = Verdict::kOk;
  /** What was measured, or what is wrong. */
  std::string text;
};

/** Tests a robot's joints and sensors: measures it at rest for 2 s, then turns each joint by 2
 * degrees (hands: opens by 0.1) and back. Images are counted meanwhile. Time comes with the
 * samples; neither bus nor clock is used. */
class SelfTest {
 public:
  /** @param model  Must outlive this. */
  explicit SelfTest(const RobotModel& model);

  /** A sensor state. @param dt  Since the last one, s. */
  void measure(const SelfTestSample& sample, double dt);
  void measure(const SelfTestMotors& motors);
  /** An image of a camera has arrived. @param num_bytes  Of the JPEG file. */
  void add_image(const std::string& camera, int num_bytes);

  /** A command to send now; none while it measures or waits for end_command(), or is done. */
  std::optional<JointChangeCommand> next_command();
  /** The command has ended. @param fault  Empty: it was executed. */
  void end_command(const std::string& fault);
  bool is_done() const { return phase_ == Phase::kDone; }
  /** 0 to 1. */
  double progress() const;

  /** To be called when it is done. */
  std::vector<SelfTestFinding> findings() const;

 private:
  enum class Phase { kRest, kBefore, kGoing, kSettling, kAfter, kReturning, kDone };

  /** Means over the samples of a phase. */
  struct Means {
    int num_samples = 0;
    std::vector<double> position;
    std::vector<double> target_error;
    std::vector<double> foot_force;
    Eigen::Vector3d accelerometer = Eigen::Vector3d::Zero();
    Eigen::Vector3d gyroscope = Eigen::Vector3d::Zero();
    /** Mean squares, for the deviation. */
    double accelerometer_square = 0;
    double gyroscope_square = 0;
    /** Upward direction in the torso frame by the orientation. */
    Eigen::Vector3d up = Eigen::Vector3d::Zero();

    void add(const SelfTestSample& sample);
    void finish();
  };

  void enter(Phase phase);
  /** The motor turns a joint of a leg, and the robot stands. */
  bool is_loaded_leg(int motor) const;
  void end_joint();
  JointChangeCommand change(double sign) const;
  SelfTestFinding judge_joint() const;
  SelfTestFinding judge_accelerometer() const;
  SelfTestFinding judge_gyroscope() const;
  void judge_feet(std::vector<SelfTestFinding>& findings) const;
  SelfTestFinding judge_camera(const std::string& camera) const;

  const RobotModel& model_;
  /** By motor: its position is an opening. */
  std::vector<bool> is_opening_;
  Phase phase_ = Phase::kRest;
  double time_ = 0;
  /** Duration of the whole test, s. */
  double total_time_ = 0;
  int motor_ = 0;
  /** Direction of the change: away from the nearer limit. */
  double direction_ = 1;
  bool is_sent_ = false;
  /** Both directions were refused, or one was: why. */
  std::string refusal_;
  Means rest_, before_, after_;
  std::vector<double> last_position_;
  std::optional<SelfTestMotors> motors_;
  /** Largest magnitude while the joint was tested, A. */
  double greatest_current_ = 0;
  /** Numbers of images and sizes of the smallest, bytes, by camera. */
  std::map<std::string, std::pair<int, int>> images_;
  std::vector<SelfTestFinding> joints_;
};

/** The findings as a table, faults marked, and a sentence that counts them. */
std::string to_table(const std::vector<SelfTestFinding>& findings);

}  // namespace nao

#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "common/channels.h"
#include "inspection/foxglove_messages.h"
#include "inspection/robot_transforms.h"
#include "kinematics/odometry_alignment.h"

namespace nao {

/** Converts the bus of one robot to channels in Foxglove's schemas, which its 3D and image panels
 * draw. `nao-foxglove` and `nao log mcap` share it.
 *
 * Messages that are only drawn (transforms, scenes) are converted at most 50 times a second of
 * robot time. */
class FoxgloveConverter {
 public:
  /** A channel that is written. */
  struct Output {
    /** "/NAO/joint_states". */
    std::string topic;
    /** "foxglove.JointStates". */
    std::string schema;
  };
  using IsWanted = std::function<bool(size_t)>;
  using Emit = std::function<void(size_t, std::string)>;

  /** @param model  Model of the robot; must outlive this. @param robot  Its name, "NAO". */
  FoxgloveConverter(const RobotModel& model, const std::string& robot);
  FoxgloveConverter(const FoxgloveConverter&) = delete;
  FoxgloveConverter& operator=(const FoxgloveConverter&) = delete;

  const std::vector<Output>& outputs() const { return outputs_; }
  /** The camera whose image or calibration an output is; nullptr for others. */
  const CameraModel* camera_of(size_t output) const;

  /** Converts a message; those of other channels and types are ignored.
   * @param is_wanted  Whether an output (index into outputs()) is needed.
   * @param emit  Receives an output's index and its message as JSON. */
  void convert(const std::string& channel, std::span<const uint8_t> message,
               const IsWanted& is_wanted, const Emit& emit);

 private:
  /** Indices into outputs(); those of the cameras follow, image and calibration of each. */
  enum Index : size_t {
    kJointStates,
    kOdometry,
    kTransforms,
    kBalance,
    kFootsteps,
    kDetections,
    kWorldTransforms,
    kWorldScene,
    kNumFixedOutputs
  };
  /** Which image of a camera is shown: several receivers may request several sizes. */
  struct ShownImage {
    int width = 0;
    int64_t utime = 0;
  };

  void add_outputs(const std::string& robot);
  template <class Message>
  void decode(std::span<const uint8_t> bytes, void (FoxgloveConverter::*take)(const Message&));
  void take_sensors(const naolcm::sensor_state_t& state);
  void take_state(const naolcm::robot_state_t& state);
  void take_motion(const naolcm::motion_state_t& state);
  void take_vision(const naolcm::vision_state_t& state);
  void take_truth(const naolcm::world_truth_t& truth);
  void take_image(const naolcm::image_t& image);
  std::string transforms_of(const naolcm::robot_state_t& state);
  std::string transforms_of(const naolcm::world_truth_t& truth);
  /** Whether the fixed transforms are due, too: once a second of robot time. */
  bool is_second_begun(size_t output, int64_t utime);
  /** Whether an output that is only drawn is due. */
  bool is_due(size_t output, int64_t utime);
  bool is_wanted(size_t output) const { return (*is_wanted_)(output); }
  void emit(size_t output, std::string json) { (*emit_)(output, std::move(json)); }

  const RobotModel& model_;
  RobotTransforms transforms_;
  std::string robot_;
  RobotChannels channels_;
  std::vector<Output> outputs_;
  // Arguments of the current call of convert().
  const IsWanted* is_wanted_ = nullptr;
  const Emit* emit_ = nullptr;
  /** Robot time of the last message of each output, microseconds; with the fixed transforms. */
  std::map<size_t, int64_t> last_utime_;
  std::map<size_t, int64_t> last_second_;
  std::map<std::string, ShownImage> shown_images_;
  OdometryAlignment alignment_;
  std::optional<Eigen::Isometry3d> true_torso_;
};

}  // namespace nao

#pragma once

#include <string>
#include <vector>

#include "inspection/foxglove_json.h"
#include "robot_model/robot_model.h"

namespace nao {

/** Transforms between the frames of a robot's links, each named as its link. The model must outlive
 * this. */
class RobotTransforms {
 public:
  explicit RobotTransforms(const RobotModel& model) : model_(model) {}

  /** Name of the root link's frame. */
  const std::string& root() const { return model_.links().front().name; }
  /** Name of a camera's optical frame: z along the view, x right, y down. */
  static std::string optical_frame(const std::string& camera_link) {
    return camera_link + "_optical";
  }

  /** Appends the transforms of all joints that move.
   * @param position  rad (hands: opening), (num_motors), motor order.
   * @param prefix  Prefix of all frame names. */
  void append_moving(const std::vector<double>& position, const std::string& prefix,
                     std::vector<NamedTransform>& transforms) const;
  /** Appends those of the fixed joints and of the cameras' optical frames. */
  void append_fixed(const std::string& prefix, std::vector<NamedTransform>& transforms) const;

 private:
  const RobotModel& model_;
};

}  // namespace nao

#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "robot_model/robot_model.h"

namespace nao {

/** Text of a transitions.yaml whose numbers are search parameters: durations, pauses, joint angles,
 * stiffness of single joints and the ankles' damping of selected sequences. Comments and order are
 * preserved.
 *
 * Required layout of the file: `duration`, `pause`, `ankle_damping`, `joints` and `stiffness` each
 * begin a line of their own, the latter two as `{NAME: NUMBER, ...}`. */
class TransitionText {
 public:
  struct Parameter {
    /** "get-up-belly 3 HipPitch": sequence, keyframe from 0, what. */
    std::string name;
    int keyframe;
    double value;
    /** Search range: the joint's limits; durations 0.03 to 3 s; pauses 0 to 1 s; stiffness 0.1
     * to 1; damping 0 to 0.3 s. */
    double lower;
    double upper;
    /** Position of the number in the text. */
    size_t begin;
    size_t size;
  };

  /** @param sequences  Names of the sequences to search.
   * @param fixed  Joints, without side, whose angles stay.
   * @throws Error  if the text lacks one of the sequences, or names a joint that the model lacks.
   */
  TransitionText(const RobotModel& model, std::string text,
                 const std::vector<std::string>& sequences, const std::vector<std::string>& fixed);

  const std::vector<Parameter>& parameters() const { return parameters_; }
  /** The text with new numbers, clipped to their ranges. @param values  (parameters().size()). */
  std::string with(const Eigen::VectorXd& values) const;

 private:
  void read_sequence(const RobotModel& model, const std::string& sequence,
                     const std::vector<std::string>& fixed);
  void read_line(const RobotModel& model, const std::string& sequence, int keyframe, size_t begin,
                 size_t end, const std::vector<std::string>& fixed);

  std::string text_;
  std::vector<Parameter> parameters_;
};

}  // namespace nao

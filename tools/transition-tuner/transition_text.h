#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "robot_model/robot_model.h"

namespace nao {

/** The text of a transitions.yaml with numbers of some of its sequences as parameters of a search:
 * durations and pauses, joint angles, and shares of stiffness of single joints. Comments and order
 * stay as they are.
 *
 * It wants the file's own layout: `duration`, `pause`, `joints` and `stiffness` each begin a line
 * of their own, the latter two as `{NAME: NUMBER, ...}`. */
class TransitionText {
 public:
  struct Parameter {
    /** "get-up-belly 3 HipPitch": sequence, keyframe from 0, what. */
    std::string name;
    int keyframe;
    double value;
    /** Range that a search may use: the joint's own; 0.03 to 3 s; 0 to 1 s of pause; a share of
     * 0.1 to 1. */
    double lower;
    double upper;
    /** Where the number stands in the text. */
    size_t begin;
    size_t size;
  };

  /** @param sequences  Names of those to search.
   * @param fixed  Joints, without side, whose angles stay.
   * @throws Error  if the text lacks one of the sequences, or names a joint the model has not. */
  TransitionText(const RobotModel& model, std::string text,
                 const std::vector<std::string>& sequences, const std::vector<std::string>& fixed);

  const std::vector<Parameter>& parameters() const { return parameters_; }
  /** The text with other numbers, clipped to their ranges. @param values  (parameters().size()). */
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

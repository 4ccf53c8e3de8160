#include "tools/transition-tuner/transition_text.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>

#include "common/error.h"

namespace nao {
namespace {

constexpr double kShortest = 0.03;        // s
constexpr double kLongest = 3;            // s
constexpr double kLongestPause = 1;       // s
constexpr double kLeastStiffness = 0.1;   // fraction
constexpr double kGreatestDamping = 0.3;  // s

/** Motor of a joint; of the left joint if it is the name of a pair. */
int find_motor(const RobotModel& model, const std::string& name) {
  const int motor = model.find_motor(name);
  if (motor >= 0) return motor;
  const JointPair* pair = model.symmetry().find_pair(name);
  return pair != nullptr ? pair->left : -1;
}

}  // namespace

TransitionText::TransitionText(const RobotModel& model, std::string text,
                               const std::vector<std::string>& sequences,
                               const std::vector<std::string>& fixed)
    : text_(std::move(text)) {
  for (const std::string& sequence : sequences) read_sequence(model, sequence, fixed);
  std::sort(parameters_.begin(), parameters_.end(),
            [](const Parameter& a, const Parameter& b) { return a.begin < b.begin; });
}

void TransitionText::read_sequence(const RobotModel& model, const std::string& sequence,
                                   const std::vector<std::string>& fixed) {
  const std::string head = fmt::format("- name: {}\n", sequence);
  const size_t found = text_.find(head);
  if (found == std::string::npos) throw Error(fmt::format("there is no transition {}", sequence));
  const size_t end = std::min(text_.find("- name: ", found + 1), text_.size());
  int keyframe = -1;
  for (size_t line = found + head.size(); line < end;) {
    const size_t line_end = std::min(text_.find('\n', line), end);
    const size_t word = text_.find_first_not_of(' ', line);
    if (word < line_end && text_.compare(word, 11, "- duration:") == 0) ++keyframe;
    if (word < line_end && text_[word] != '#') {
      read_line(model, sequence, keyframe, word, line_end, fixed);
    }
    line = line_end + 1;
  }
}

void TransitionText::read_line(const RobotModel& model, const std::string& sequence, int keyframe,
                               size_t begin, size_t end, const std::vector<std::string>& fixed) {
  const auto add = [&](const std::string& what, size_t after, double lower, double upper) {
    const size_t number = text_.find_first_not_of(' ', after);
    const std::string name = fmt::format("{} {} {}", sequence, keyframe, what);
    char* number_end = nullptr;
    const double value = std::strtod(text_.c_str() + number, &number_end);
    const auto size = static_cast<size_t>(number_end - (text_.c_str() + number));
    if (size == 0) throw Error(name + " is not a number");
    parameters_.push_back({name, keyframe, value, lower, upper, number, size});
  };
  const auto starts = [&](const char* key) {
    return text_.compare(begin, std::strlen(key), key) == 0;
  };
  const size_t colon = text_.find(':', begin);
  if (starts("- duration:")) add("duration", colon + 1, kShortest, kLongest);
  if (starts("ankle_damping:")) add("ankle_damping", colon + 1, 0, kGreatestDamping);
  if (starts("pause:")) add("pause", colon + 1, 0, kLongestPause);
  const bool is_stiffness = starts("stiffness:");
  if (!is_stiffness && !starts("joints:")) return;
  for (size_t at = text_.find('{', begin); at < end;) {
    const size_t name_begin = text_.find_first_not_of("{, ", at);
    const size_t name_end = text_.find(':', name_begin);
    if (name_end >= end) break;
    const std::string name = text_.substr(name_begin, name_end - name_begin);
    at = text_.find_first_of(",}", name_end);
    if (std::find(fixed.begin(), fixed.end(), name) != fixed.end() || name == "all") continue;
    const int motor = find_motor(model, name);
    if (motor < 0) throw Error(fmt::format("{} {}: no joint {}", sequence, keyframe, name));
    const Joint& joint = model.motor_joint(motor);
    if (is_stiffness) {
      add("stiffness " + name, name_end + 1, kLeastStiffness, 1);
    } else {
      add(name, name_end + 1, joint.lower, joint.upper);
    }
  }
}

std::string TransitionText::with(const Eigen::VectorXd& values) const {
  std::string result;
  size_t end = 0;
  for (size_t i = 0; i < parameters_.size(); ++i) {
    const Parameter& parameter = parameters_[i];
    const double value = std::clamp(values[static_cast<long>(i)], parameter.lower, parameter.upper);
    result += text_.substr(end, parameter.begin - end);
    // Round inwards: the rounded value must not exceed a joint's limit.
    double rounded = std::round(value * 1000) / 1000;
    if (rounded < parameter.lower) rounded += 0.001;
    if (rounded > parameter.upper) rounded -= 0.001;
    result += fmt::format("{:.3f}", rounded);
    end = parameter.begin + parameter.size;
  }
  return result + text_.substr(end);
}

}  // namespace nao

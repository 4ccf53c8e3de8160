#include "messages/body_condition.h"

#include <algorithm>
#include <cmath>

namespace nao {
namespace {

std::string rounded(double value) {
  return std::to_string(std::lround(value));
}

}  // namespace

BodyCondition summarize(const naolcm::body_state_t& body) {
  BodyCondition condition;
  if (std::isfinite(body.battery_charge)) {
    condition.battery_charge = std::clamp(body.battery_charge, 0.0, 1.0);
  }
  condition.is_charging = body.battery_current > 0;
  const size_t num_joints = body.joint_names.size();
  for (size_t i = 0; i < std::min(num_joints, body.joint_temperature.size()); ++i) {
    const double temperature = body.joint_temperature[i];
    if (!std::isfinite(temperature)) continue;
    if (condition.hottest_joint.empty() || temperature > condition.hottest_temperature) {
      condition.hottest_joint = body.joint_names[i];
      condition.hottest_temperature = temperature;
    }
  }
  for (size_t i = 0; i < std::min(num_joints, body.joint_status.size()); ++i) {
    if (body.joint_status[i] != naolcm::body_state_t::JOINT_STATUS_OK) {
      condition.faulty_joints.push_back(body.joint_names[i]);
    }
  }
  condition.warnings = body.warning_codes;
  return condition;
}

std::string body_warning_text(const std::string& code) {
  if (code == "battery-low") return "the battery is low";
  if (code == "battery-hot") return "the battery is hot";
  if (code == "joint-hot") return "a motor is hot";
  if (code == "joint-dead") return "a motor does not answer";
  if (code == "sensor-dead") return "a sensor does not answer";
  return code;
}

std::string to_sentence(const BodyCondition& condition) {
  std::string text = "battery ";
  text += condition.battery_charge ? rounded(100 * *condition.battery_charge) + " %" : "unknown";
  if (condition.is_charging) text += ", charging";
  if (!condition.hottest_joint.empty()) {
    text += "; hottest motor " + condition.hottest_joint + ", " +
            rounded(condition.hottest_temperature) + " degrees Celsius";
  }
  text += "; ";
  if (condition.warnings.empty()) text += "no warnings";
  for (size_t i = 0; i < condition.warnings.size(); ++i) {
    text += (i == 0 ? "warning: " : ", ") + body_warning_text(condition.warnings[i]);
  }
  for (size_t i = 0; i < condition.faulty_joints.size(); ++i) {
    text += (i == 0 ? " (" : ", ") + condition.faulty_joints[i];
  }
  return condition.faulty_joints.empty() ? text : text + ")";
}

}  // namespace nao

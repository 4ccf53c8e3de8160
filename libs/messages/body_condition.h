#pragma once

#include <naolcm/body_state_t.hpp>
#include <optional>
#include <string>
#include <vector>

namespace nao {

/** What people want to know of a body_state_t. */
struct BodyCondition {
  /** Charge, 0 to 1; none if unknown. */
  std::optional<double> battery_charge;
  bool is_charging = false;
  /** The hottest motor's joint and temperature, degrees Celsius; an empty name if unknown. */
  std::string hottest_joint;
  double hottest_temperature = 0;
  /** Codes of body_state_t. */
  std::vector<std::string> warnings;
  /** Joints whose motor is hot, limited, off or dead. */
  std::vector<std::string> faulty_joints;

  /** Whether anything is known: a simulated body has lights only. */
  bool is_known() const { return battery_charge || !hottest_joint.empty() || !warnings.empty(); }
};

/** Lists of unequal lengths are read as far as the shortest one goes. */
BodyCondition summarize(const naolcm::body_state_t& body);

/** English for a code of body_state_t, such as "the battery is low"; the code itself if it is of a
 * newer program. */
std::string body_warning_text(const std::string& code);

/** One line: "battery 63 %, charging; hottest motor LKneePitch, 54 degrees Celsius; no warnings".
 */
std::string to_sentence(const BodyCondition& condition);

}  // namespace nao

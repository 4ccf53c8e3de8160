#include "tools/nao/body_report.h"

#include <algorithm>
#include <cmath>

#include "tools/nao/text_table.h"

namespace nao {
namespace {

/** Of a code of body_state_t; the code itself if it is a new one. */
std::string to_words(const std::string& code) {
  if (code == "battery-low") return "the battery is low";
  if (code == "battery-hot") return "the battery is hot";
  if (code == "joint-hot") return "a motor is hot";
  if (code == "joint-dead") return "a motor does not answer";
  if (code == "sensor-dead") return "a sensor does not answer";
  return code;
}

}  // namespace

std::string body_report(const std::string& robot, const naolcm::body_state_t& body) {
  std::string text = robot + ": battery ";
  text += std::isfinite(body.battery_charge) ? format_number(100 * body.battery_charge, 0) + " %"
                                             : "unknown";
  if (body.battery_current > 0) text += ", charging";
  const std::vector<double>& temperatures = body.joint_temperature;
  const auto hottest = std::max_element(temperatures.begin(), temperatures.end());
  if (hottest != temperatures.end() && std::isfinite(*hottest)) {
    text += "; hottest motor " +
            body.joint_names[static_cast<size_t>(hottest - temperatures.begin())] + ", " +
            format_number(*hottest, 0) + " degrees Celsius";
  }
  text += "; ";
  if (body.warning_codes.empty()) text += "no warnings";
  for (size_t i = 0; i < body.warning_codes.size(); ++i) {
    text += (i == 0 ? "warning: " : ", ") + to_words(body.warning_codes[i]);
  }
  return text + "\n";
}

}  // namespace nao

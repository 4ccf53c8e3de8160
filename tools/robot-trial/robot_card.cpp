#include "tools/robot-trial/robot_card.h"

#include <fmt/core.h>

#include "common/json_writer.h"

namespace nao {

std::string to_text(const RobotCard& card) {
  std::string text = fmt::format(
      "{}: {:.1f} kg, {:.2f} m high, {} motors, soles of {:.0f} x {:.0f} mm\n"
      "stands {} of {} times 20 s; withstands a push of {:.1f} N s\n"
      "walks {} of {} times 10 s at {:.2f} m/s (commanded: {:.2f} m/s)\n",
      card.name, card.mass, card.height, card.motors, 1e3 * card.sole_length, 1e3 * card.sole_width,
      card.stands, card.runs, card.push, card.walks, card.runs, card.speed, card.commanded_speed);
  if (!card.failure.empty()) text += "what failed: " + card.failure + "\n";
  const RobotSettings& settings = card.settings;
  text += fmt::format(
      "settings: servos' peak error {} rad; speed x {}, swing height x {}, hip height x {}, step "
      "duration x {}, distance of the feet x {}\n",
      settings.peak_error, settings.speed, settings.swing_height, settings.hip_height,
      settings.step_duration, settings.foot_distance);
  for (const std::string& image : card.images) text += "image: " + image + "\n";
  if (!card.no_images.empty()) text += "no images: " + card.no_images + "\n";
  for (const Finding& finding : card.missing) text += "missing: " + to_line(finding) + "\n";
  return text;
}

std::string to_json(const RobotCard& card) {
  JsonWriter json;
  json.begin_object();
  json.add("name", card.name);
  json.add("mass_kg", card.mass);
  json.add("height_m", card.height);
  json.add("motors", card.motors);
  json.add("sole_length_m", card.sole_length);
  json.add("sole_width_m", card.sole_width);
  json.add("runs", card.runs);
  json.add("stands", card.stands);
  json.add("walks", card.walks);
  json.add("commanded_speed_mps", card.commanded_speed);
  json.add("speed_mps", card.speed);
  json.add("push_Ns", card.push);
  json.add("failure", card.failure);
  json.begin_object("settings");
  json.add("peak_error_rad", card.settings.peak_error);
  json.add("speed", card.settings.speed);
  json.add("swing_height", card.settings.swing_height);
  json.add("hip_height", card.settings.hip_height);
  json.add("step_duration", card.settings.step_duration);
  json.add("foot_distance", card.settings.foot_distance);
  json.end();
  json.begin_array("images");
  for (const std::string& image : card.images) json.add("", image);
  json.end();
  json.add("no_images", card.no_images);
  json.begin_array("missing");
  for (const Finding& finding : card.missing) json.add("", to_line(finding));
  return json.take() + "\n";
}

}  // namespace nao

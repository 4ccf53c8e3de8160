#include "robot_import/urdf_colors.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "robot_import/urdf_values.h"
#include "robot_model/child_elements.h"

namespace nao {
namespace {

/** Linear value of an sRGB one, both 0 to 1 (IEC 61966-2-1); screens and URDFs have the latter. */
float linear_of(double srgb) {
  const double value = std::clamp(srgb, 0.0, 1.0);
  return static_cast<float>(value <= 0.04045 ? value / 12.92
                                             : std::pow((value + 0.055) / 1.055, 2.4));
}

std::optional<Color> color_of(const TiXmlElement& material) {
  const TiXmlElement* color = material.FirstChildElement("color");
  const auto rgba = color == nullptr ? std::nullopt : read_numbers(*color, "rgba", 4);
  if (!rgba) return std::nullopt;
  // What is transparent in the file still shall be seen.
  return Color(linear_of((*rgba)[0]), linear_of((*rgba)[1]), linear_of((*rgba)[2]), 1);
}

}  // namespace

std::map<const TiXmlElement*, Color> read_colors(const TiXmlElement& robot) {
  std::map<std::string, Color> by_name;
  const auto remember = [&](const TiXmlElement* material) {
    const char* name = material == nullptr ? nullptr : material->Attribute("name");
    if (name == nullptr) return;
    if (const auto color = color_of(*material)) by_name.emplace(name, *color);
  };
  for (const TiXmlElement* material : child_elements(robot, "material")) {
    remember(material);
  }
  std::map<const TiXmlElement*, Color> colors;
  // A visual may name the material of another one.
  for (const bool is_second : {false, true}) {
    for (const TiXmlElement* link : child_elements(robot, "link")) {
      for (const TiXmlElement* visual : child_elements(*link, "visual")) {
        const TiXmlElement* material = visual->FirstChildElement("material");
        if (material == nullptr) continue;
        remember(material);
        const auto color = color_of(*material);
        const char* name = material->Attribute("name");
        const auto known = name == nullptr ? by_name.end() : by_name.find(name);
        if (color) {
          colors[visual] = *color;
        } else if (is_second && known != by_name.end()) {
          colors[visual] = known->second;
        }
      }
    }
  }
  return colors;
}

}  // namespace nao

#include "tools/nao/color_argument.h"

#include <charconv>

#include "common/error.h"

namespace nao {
namespace {

struct NamedColor {
  const char* name;
  /** As in "#ff8000". */
  int rgb;
};

/** The values are those of CSS where it has the name (CSS Color Module Level 4, section 6.1); green
 * is full green. */
constexpr NamedColor kColors[] = {{"red", 0xff0000},    {"green", 0x00ff00},   {"blue", 0x0000ff},
                                  {"white", 0xffffff},  {"yellow", 0xffff00},  {"orange", 0xffa500},
                                  {"cyan", 0x00ffff},   {"magenta", 0xff00ff}, {"pink", 0xffc0cb},
                                  {"purple", 0x800080}, {"off", 0x000000}};

LightColor to_color(int rgb) {
  return {(rgb >> 16 & 0xff) / 255.0, (rgb >> 8 & 0xff) / 255.0, (rgb & 0xff) / 255.0};
}

}  // namespace

LightColor parse_color(const std::string& text) {
  std::string names;
  for (const NamedColor& color : kColors) {
    if (text == color.name) return to_color(color.rgb);
    names += std::string(color.name) + ", ";
  }
  unsigned rgb = 0;
  const char* end = text.data() + text.size();
  if (text.size() == 7 && text[0] == '#' &&
      std::from_chars(text.data() + 1, end, rgb, 16).ptr == end) {
    return to_color(static_cast<int>(rgb));
  }
  throw ConfigError("'" + text + "' is not a color; there are " + names + "and such as #ff8000");
}

}  // namespace nao

#include "tools/nao/color_argument.h"

#include <gtest/gtest.h>

#include "common/error.h"

namespace nao {
namespace {

TEST(ColorArgument, ReadsNamesAndNumbers) {
  EXPECT_EQ(parse_color("red"), (LightColor{1, 0, 0}));
  EXPECT_EQ(parse_color("off"), (LightColor{0, 0, 0}));
  EXPECT_EQ(parse_color("#00ff33"), (LightColor{0, 1, 0.2}));
  EXPECT_EQ(parse_color("#00FF33"), (LightColor{0, 1, 0.2}));
}

TEST(ColorArgument, RefusesEverythingElse) {
  for (const char* text :
       {"", "reddish", "#", "#12345", "#1234567", "#12345g", "#-12345", "0xff0000"}) {
    EXPECT_THROW(parse_color(text), ConfigError) << text;
  }
}

}  // namespace
}  // namespace nao

#include "daemons/robot/chest_button.h"

#include <gtest/gtest.h>

#include <vector>

namespace nao::robot {
namespace {

/** Presses that are detected in a sequence of (pressed, seconds). */
std::vector<Press> presses(const std::vector<std::pair<bool, double>>& sequence) {
  ChestButton button;
  std::vector<Press> result;
  for (const auto& [is_pressed, seconds] : sequence) {
    for (double time = 0; time < seconds; time += 0.012) {
      const Press press = button.step(is_pressed, 0.012);
      if (press != Press::kNone) result.push_back(press);
    }
  }
  return result;
}

using Presses = std::vector<Press>;

TEST(ChestButton, TellsOneFromTwoPresses) {
  EXPECT_EQ(presses({{true, 0.1}, {false, 1}}), Presses{Press::kOnce});
  EXPECT_EQ(presses({{true, 0.1}, {false, 0.2}, {true, 0.1}, {false, 1}}), Presses{Press::kTwice});
  EXPECT_EQ(presses({{true, 0.1}, {false, 1}, {true, 0.1}, {false, 1}}),
            (Presses{Press::kOnce, Press::kOnce}));
}

TEST(ChestButton, TellsALongPressOnceAndWhileItLasts) {
  EXPECT_EQ(presses({{true, 2.9}}), Presses{});
  EXPECT_EQ(presses({{true, 10}, {false, 1}}), Presses{Press::kLong});
}

TEST(ChestButton, TellsNothingWithoutAPress) {
  EXPECT_EQ(presses({{false, 10}}), Presses{});
}

}  // namespace
}  // namespace nao::robot

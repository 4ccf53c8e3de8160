/** RobotModel::load() with damaged files. */

#include <gtest/gtest.h>

#include <random>

#include "test/libs/robot_model/copied_robot.h"

namespace nao {
namespace {

/** Damages a text in one to four places: changed bytes, removed, repeated or inserted parts. */
std::string damaged(std::string text, std::mt19937& random) {
  static const std::vector<std::string> kWords = {
      "nan",       "-1",   "1e999", "0",       "\"",    "<",     ">",      "/>",          "</link>",
      "<link>",    "[",    "]",     "{",       "}",     ":",     "- ",     "\n",          "\t",
      "&a ",       "*a",   "<<: ",  {"\0", 1}, "\xff",  "!!",    "|",      "99999999999", "<!--",
      "<![CDATA[", "&#0;", "? ",    "name",    "LFoot", "torso", "HeadYaw"};
  const auto below = [&random](size_t count) {
    return std::uniform_int_distribution<size_t>(0, count - 1)(random);
  };
  const size_t num_places = 1 + below(4);
  for (size_t i = 0; i < num_places && !text.empty(); ++i) {
    const size_t at = below(text.size());
    const size_t length = std::min(text.size() - at, 1 + below(80));
    switch (below(5)) {
      case 0:
        text[at] = static_cast<char>(below(256));
        break;
      case 1:
        text.erase(at, length);
        break;
      case 2:
        text.insert(below(text.size()), text.substr(at, length));
        break;
      case 3:
        text.insert(at, kWords[below(kWords.size())]);
        break;
      default:
        // Sometimes the end is missing.
        if (below(20) == 0) {
          text.resize(at);
        }
        break;
    }
  }
  return text;
}

TEST(RobotFiles, NeverCrashTheReaderHoweverDamaged) {
  const CopiedRobot robot;
  std::mt19937 random(20140613);
  int num_refused = 0;
  constexpr int kVariants = 1500;
  for (int i = 0; i < kVariants; ++i) {
    const std::string& file = kRobotFiles[i % kRobotFiles.size()];
    const std::string whole = robot.read(file);
    robot.write(file, damaged(whole, random));
    num_refused += error_of(robot.path()).empty() ? 0 : 1;
    robot.write(file, whole);
  }
  // Changed digits and comments load; most damage is found.
  EXPECT_GT(num_refused, kVariants / 2);
  EXPECT_EQ(error_of(robot.path()), "");
}

TEST(RobotFiles, NeverCrashTheReaderWhenNestedDeeply) {
  const CopiedRobot robot;
  const std::string whole = robot.read("robot.yaml");
  robot.write("robot.yaml", whole + "extra: " + std::string(100000, '['));
  EXPECT_NE(error_of(robot.path()), "");
}

}  // namespace
}  // namespace nao

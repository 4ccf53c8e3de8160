#include "daemons/motion-files/motion_text.h"

#include <gtest/gtest.h>

#include "common/error.h"
#include "common/random.h"
#include "daemons/motion/actions/taught_script.h"
#include "test/daemons/motion-files/motions.h"

namespace nao {
namespace {

std::string fault_of(const std::string& text) {
  try {
    parse_motion(*test_model(), text, "file");
  } catch (const ModelError& error) {
    return error.what();
  }
  return "";
}

TEST(MotionText, IsReadAsItWasWritten) {
  const motion::ActionScript wave =
      make_motion(std::string(kWave) +
                      ", {duration: 1, posture: StandInit, stiffness: {RElbowRoll: 0.5}, pause: "
                      "0.3}",
                  "repetitions: 2, ");
  const std::string text = to_yaml(*test_model(), wave);
  const motion::ActionScript again = parse_motion(*test_model(), text, "text");
  EXPECT_EQ(to_yaml(*test_model(), again), text);
  EXPECT_EQ(again.num_repetitions, 2);
  EXPECT_EQ(again.start, "StandInit");
  ASSERT_EQ(again.sequence.keyframes.size(), 4u);
  EXPECT_EQ(again.sequence.keyframes[3].pause, 0.3);
  const int elbow = test_model()->find_motor("RElbowRoll");
  EXPECT_EQ(again.sequence.keyframes[1].position[elbow], 0.6);
  EXPECT_EQ(again.sequence.keyframes[3].stiffness[elbow], 0.5);
}

TEST(MotionText, SaysWhatIsWrong) {
  const std::string head = "actions:\n  - name: a\n    keyframes: ";
  EXPECT_NE(fault_of("actions: []").find("one entry"), std::string::npos);
  EXPECT_NE(fault_of("actions: [1, 2").find("YAML"), std::string::npos);
  EXPECT_NE(fault_of(head + "[]").find("no keyframe"), std::string::npos);
  EXPECT_NE(fault_of(head + "[{duration: 1, joints: {Tail: 1}}]").find("Tail"), std::string::npos);
  EXPECT_NE(fault_of(head + "[{duration: 1, up: {z: [0, 1]}}]").find("up"), std::string::npos);
  EXPECT_NE(fault_of(head + "[{duration: 1, joints: {HeadYaw: .nan}}]").find("finite"),
            std::string::npos);
  EXPECT_NE(fault_of("actions: [{name: ../a, keyframes: [{duration: 1}]}]").find("letters"),
            std::string::npos);
  EXPECT_NE(
      fault_of("actions: [{name: a, end: gets-up, keyframes: [{duration: 1}]}]").find("holds"),
      std::string::npos);
  EXPECT_NE(fault_of(std::string(kMaxMotionTextBytes + 1, ' ')).find("bytes"), std::string::npos);
}

TEST(MotionText, LeavesLimitsToTheChecker) {
  const motion::ActionScript script = make_motion("{duration: 1, joints: {HeadYaw: 3}}");
  EXPECT_EQ(script.sequence.keyframes[0].position[test_model()->find_motor("HeadYaw")], 3);
}

// A text from the network must not end the program, whatever it contains.
TEST(MotionText, SurvivesRandomChangesOfAText) {
  const std::string original = to_yaml(*test_model(), make_motion(kWave));
  Random random(1);
  constexpr char kPieces[] = "{}[]:,-&*!|>'\"%@#\n\t 0.eE+_~^Lx";
  for (int i = 0; i < 3000; ++i) {
    std::string text = original;
    const int num_changes = 1 + static_cast<int>(random.uniform(0, 6));
    for (int k = 0; k < num_changes; ++k) {
      const auto at = static_cast<size_t>(random.uniform(0, static_cast<double>(text.size())));
      const char piece = kPieces[static_cast<size_t>(random.uniform(0, sizeof kPieces - 1))];
      const double what = random.uniform();
      if (what < 0.4) {
        text[at] = piece;
      } else if (what < 0.7) {
        text.insert(at, 1 + static_cast<size_t>(random.uniform(0, 40)), piece);
      } else {
        text.erase(at, static_cast<size_t>(random.uniform(1, 30)));
      }
      if (text.empty()) text = " ";
    }
    try {
      const motion::ActionScript script = parse_motion(*test_model(), text, "text");
      if (motion::find_form_fault(script)) continue;
      const std::string written = to_yaml(*test_model(), script);
      EXPECT_EQ(to_yaml(*test_model(), parse_motion(*test_model(), written, "written")), written);
    } catch (const Error&) {
      continue;
    }
  }
}

TEST(MotionText, SurvivesDeepNesting) {
  for (const char* piece : {"[", "{", "- ", "? ", "&a ", "!a "}) {
    std::string text = "actions: ";
    while (text.size() < 100000) text += piece;
    EXPECT_NE(fault_of(text), "");
  }
}

}  // namespace
}  // namespace nao

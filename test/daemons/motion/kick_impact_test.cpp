#include "daemons/motion/actions/kick_impact.h"

#include <gtest/gtest.h>

#include "common/error.h"

namespace nao::motion {
namespace {

KickImpact parsed(const std::string& text) {
  return KickImpact::read(YamlEntry::parse(text, "impact"));
}

/** @param hip_velocity  Its weights. */
std::string text_of(const std::string& times, const std::string& hip_velocity) {
  return "{foot: 0.1, times: " + times + ", hip_velocity: " + hip_velocity +
         ", knee_velocity: [0, 0], hip_torque: [0, 0], knee_torque: [0, 0], pitch_rate: [0, 0], "
         "yaw_rate: [0, 0.5], support_hip_torque: [0, 0], support_knee_torque: [0, 0], bias: -0.5, "
         "believed: [0.2, 2]}";
}
const std::string kText = text_of("[0, 0.02]", "[1, -1]");

/** The sole passes 0.1 m at 0.01 s; then the hip slows down by so much in 0.02 s. */
std::vector<KickImpact::Sample> samples_of(double slowing) {
  std::vector<KickImpact::Sample> samples;
  for (int i = -5; i <= 10; ++i) {
    const double time = 0.01 * i;
    const double late = std::clamp((time - 0.01) / 0.02, 0.0, 1.0);
    samples.push_back({time, 0.1 + 2 * (time - 0.01), {5 - slowing * late}});
  }
  return samples;
}

TEST(KickImpact, ComparesSignalsAfterTheFootHasPassedTheLine) {
  const KickImpact impact = parsed(kText);
  const std::vector<double> features = impact.find_features(samples_of(1));
  ASSERT_EQ(features.size(), 16u);
  EXPECT_NEAR(features[0], 5, 1e-9);
  EXPECT_NEAR(features[1], 4, 1e-9);
  EXPECT_EQ(impact.judge(samples_of(1)), true);
  EXPECT_EQ(impact.judge(samples_of(0)), false);
}

TEST(KickImpact, IsSilentWhereItIsNotSure) {
  const KickImpact impact = parsed(kText);
  EXPECT_EQ(impact.judge(samples_of(0.6)), std::nullopt);
  EXPECT_EQ(impact.judge(samples_of(4)), std::nullopt);
  EXPECT_EQ(impact.judge({}), std::nullopt);
  auto cut = samples_of(1);
  cut.resize(7);
  EXPECT_EQ(impact.judge(cut), std::nullopt);
}

TEST(KickImpact, AddsEachSignalAtEachTime) {
  auto samples = samples_of(0.6);
  EXPECT_EQ(parsed(kText).judge(samples), std::nullopt);
  for (KickImpact::Sample& sample : samples) sample.signals[5] = 1;  // yaw rate, rad/s
  EXPECT_EQ(parsed(kText).judge(samples), true);
}

TEST(KickImpact, RejectsListsOfOtherLengths) {
  EXPECT_THROW(parsed(text_of("[0, 0.02]", "[1]")), ModelError);
  EXPECT_THROW(parsed(text_of("[0.1, 0.02]", "[1, 1]")), ModelError);
}

}  // namespace
}  // namespace nao::motion

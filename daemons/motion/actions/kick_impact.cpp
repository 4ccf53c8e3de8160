#include "daemons/motion/actions/kick_impact.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace nao::motion {
namespace {

constexpr std::array<const char*, KickImpact::kNumSignals> kSignals = {
    "hip_velocity", "knee_velocity", "hip_torque",         "knee_torque",
    "pitch_rate",   "yaw_rate",      "support_hip_torque", "support_knee_torque"};

// Linear interpolation; `after` is the first sample after the time.
double interpolate(const KickImpact::Sample& before, const KickImpact::Sample& after, double time,
                   int signal) {
  const double s = (time - before.time) / (after.time - before.time);
  return before.signals[signal] + s * (after.signals[signal] - before.signals[signal]);
}

}  // namespace

KickImpact KickImpact::read(const YamlEntry& entry) {
  entry.allow_only({"foot", "times", "hip_velocity", "knee_velocity", "hip_torque", "knee_torque",
                    "pitch_rate", "yaw_rate", "support_hip_torque", "support_knee_torque", "bias",
                    "believed"});
  KickImpact impact;
  impact.foot = entry.at("foot").number();
  impact.times = entry.at("times").numbers();
  if (impact.times.empty() || !std::is_sorted(impact.times.begin(), impact.times.end())) {
    entry.at("times").fail("must be one or more increasing times");
  }
  for (int i = 0; i < kNumSignals; ++i) {
    impact.weights[i] = entry.at(kSignals[i]).numbers();
    if (impact.weights[i].size() != impact.times.size()) {
      entry.at(kSignals[i]).fail("must be as long as times");
    }
  }
  impact.bias = entry.at("bias").number();
  const std::vector<double> believed = entry.at("believed").numbers(2);
  if (believed[0] < 0 || believed[1] < believed[0]) {
    entry.at("believed").fail("must be the least and the greatest size of a score");
  }
  impact.believed = {believed[0], believed[1]};
  return impact;
}

std::vector<double> KickImpact::find_features(const std::vector<Sample>& samples) const {
  const auto passes = std::adjacent_find(
      samples.begin(), samples.end(),
      [&](const Sample& a, const Sample& b) { return a.foot < foot && b.foot >= foot; });
  if (passes == samples.end()) return {};
  const Sample& before = passes[0];
  const Sample& after = passes[1];
  const double passed =
      before.time + (foot - before.foot) / (after.foot - before.foot) * (after.time - before.time);
  std::vector<double> features;
  for (int signal = 0; signal < kNumSignals; ++signal) {
    for (const double later : times) {
      const double time = passed + later;
      const auto next = std::find_if(samples.begin(), samples.end(),
                                     [&](const Sample& each) { return each.time > time; });
      if (next == samples.begin() || next == samples.end()) return {};
      features.push_back(interpolate(next[-1], *next, time, signal));
    }
  }
  return features;
}

std::optional<bool> KickImpact::judge(const std::vector<Sample>& samples) const {
  const std::vector<double> features = find_features(samples);
  if (features.empty()) return std::nullopt;
  double score = bias;
  for (size_t i = 0; i < features.size(); ++i) {
    score += weights[i / times.size()][i % times.size()] * features[i];
  }
  const double size = std::abs(score);
  if (size < believed[0] || size > believed[1]) return std::nullopt;
  return score > 0;
}

}  // namespace nao::motion

#include "daemons/vision/ball_detector.h"

#include <algorithm>
#include <cmath>

namespace nao::vision {
namespace {

/** Number of candidates that are judged a second time, and their least probability. Chosen: the
 * ball is rarely behind the third. */
constexpr size_t kMostSecond = 3;
constexpr float kLeastSecond = 0.05f;
/** Greatest factor between the seen radius and the one that the camera's pose gives. Chosen: 2
 * degrees of tilt change the radius at 3 m by a third. */
constexpr double kRadiusRange = 1.6;

}  // namespace

NeuralNetwork::Shape BallDetector::shape() {
  return {{PatchSampler::kSize, PatchSampler::kSize}, kNumOutputs, {1, 1}};
}

std::vector<BallCandidate> BallDetector::judge(const PatchSampler& sampler,
                                               const std::vector<Circle>& circles,
                                               bool with_mirrored) const {
  std::vector<cv::Mat> patches;
  for (const Circle& circle : circles) {
    patches.push_back(sampler.sample(circle.center, kPatchRadii * circle.radius));
  }
  for (size_t i = 0; with_mirrored && i < circles.size(); ++i) {
    cv::Mat mirrored;
    cv::flip(patches[i], mirrored, 1);
    patches.push_back(mirrored);
  }
  cv::Mat_<float> outputs = network_->run(patches);
  const auto count = static_cast<int>(circles.size());
  if (with_mirrored && count > 0) {
    cv::Mat_<float> mirrored = outputs.rowRange(count, 2 * count);
    mirrored.col(1) *= -1;
    outputs = 0.5f * (outputs.rowRange(0, count) + mirrored);
  }
  std::vector<BallCandidate> candidates;
  for (int i = 0; i < count; ++i) {
    const float* output = outputs[i];
    const Circle& circle = circles[static_cast<size_t>(i)];
    BallCandidate candidate;
    candidate.log_odds = output[0];
    candidate.circle.center = circle.center + circle.radius * cv::Point2f(output[1], output[2]);
    candidate.circle.radius = circle.radius * std::exp(std::clamp(output[3], -1.0f, 1.0f));
    candidates.push_back(candidate);
  }
  return candidates;
}

std::optional<Detection> BallDetector::detect(const PatchSampler& sampler,
                                              const CameraGeometry& geometry,
                                              const std::vector<Circle>& places) const {
  std::vector<BallCandidate> first = judge(sampler, places);
  std::sort(first.begin(), first.end(),
            [](const BallCandidate& a, const BallCandidate& b) { return a.log_odds > b.log_odds; });
  std::vector<Circle> circles;
  std::vector<float> odds;
  for (const BallCandidate& candidate : first) {
    if (circles.size() == kMostSecond || candidate.probability() < kLeastSecond) break;
    const bool is_new = std::none_of(circles.begin(), circles.end(), [&](const Circle& circle) {
      return is_same(circle, candidate.circle);
    });
    if (!is_new) continue;
    circles.push_back(candidate.circle);
    odds.push_back(candidate.log_odds);
  }
  std::optional<BallCandidate> best;
  const std::vector<BallCandidate> second = judge(sampler, circles, true);
  for (size_t i = 0; i < second.size(); ++i) {
    BallCandidate candidate = second[i];
    candidate.log_odds = (odds[i] + 2 * candidate.log_odds) / 3;
    const auto expected = geometry.sphere_radius_px(candidate.circle.center, radius_);
    if (geometry.has_pose() &&
        (!expected ||
         std::abs(std::log(*expected / candidate.circle.radius)) > std::log(kRadiusRange))) {
      continue;
    }
    if (!best || candidate.log_odds > best->log_odds) best = candidate;
  }
  if (!best) return std::nullopt;
  const auto& [center, r] = best->circle;
  const bool is_cut = center.y + r > static_cast<float>(2 * sampler.half().rows);
  if (best->probability() < (is_cut ? kAcceptCut : kAccept)) return std::nullopt;
  Detection detection;
  detection.kind = Kind::kBall;
  detection.box_px = {center.x - r, center.y - r, center.x + r, center.y + r};
  if (const auto ground = geometry.locate(geometry.undistorted(center), radius_)) {
    detection.position = ground->position;
    detection.covariance = ground->covariance;
  }
  detection.confidence = best->probability();
  return detection;
}

}  // namespace nao::vision

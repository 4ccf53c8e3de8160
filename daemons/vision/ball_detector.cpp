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
                                               const std::vector<Circle>& circles) const {
  std::vector<cv::Mat> patches;
  for (const Circle& circle : circles) {
    patches.push_back(sampler.sample(circle.center, kPatchRadii * circle.radius));
  }
  const cv::Mat_<float> outputs = network_->run(patches);
  std::vector<BallCandidate> candidates;
  for (size_t i = 0; i < circles.size(); ++i) {
    const float* output = outputs[static_cast<int>(i)];
    const Circle& circle = circles[i];
    BallCandidate candidate;
    candidate.probability = 1 / (1 + std::exp(-output[0]));
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
  std::sort(first.begin(), first.end(), [](const BallCandidate& a, const BallCandidate& b) {
    return a.probability > b.probability;
  });
  std::vector<Circle> circles;
  for (const BallCandidate& candidate : first) {
    if (circles.size() == kMostSecond || candidate.probability < kLeastSecond) break;
    circles.push_back(candidate.circle);
  }
  std::optional<BallCandidate> best;
  for (const BallCandidate& candidate : judge(sampler, circles)) {
    const auto expected = geometry.sphere_radius_px(candidate.circle.center, radius_);
    if (geometry.has_pose() &&
        (!expected ||
         std::abs(std::log(*expected / candidate.circle.radius)) > std::log(kRadiusRange))) {
      continue;
    }
    if (!best || candidate.probability > best->probability) best = candidate;
  }
  if (!best) return std::nullopt;
  const auto& [center, r] = best->circle;
  const bool is_cut = center.y + r > static_cast<float>(2 * sampler.half().rows);
  if (best->probability < (is_cut ? kAcceptCut : kAccept)) return std::nullopt;
  Detection detection;
  detection.kind = Kind::kBall;
  detection.box_px = {center.x - r, center.y - r, center.x + r, center.y + r};
  if (const auto ground = geometry.locate(geometry.undistorted(center), radius_)) {
    detection.position = ground->position;
    detection.covariance = ground->covariance;
  }
  detection.confidence = best->probability;
  return detection;
}

}  // namespace nao::vision

#include "daemons/vision/ball_detector.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "daemons/vision/checkerboard.h"

namespace nao::vision {
namespace {

/** Number of candidates that are judged a second time, and their least probability. Chosen: the
 * ball is rarely behind the third. */
constexpr size_t kMostSecond = 3;
constexpr float kLeastSecond = 0.05f;
/** Half the width of what must not be a checkerboard, radii of the ball. */
constexpr float kBoardRadii = 1.2f;
/** Greatest factor between the seen radius and the one that the camera's pose gives. Chosen: 2
 * degrees of tilt change the radius at 3 m by a third. */
constexpr double kRadiusRange = 1.6;
/** Middle of a patch, pixels: half of its circle. */
const cv::Rect kMiddle(12, 12, 8, 8);
/** Least ratio of red and green of a ball of one color. */
constexpr double kLeastRed = 0.9;
/** Saturation above which no white ball is: only the network of balls of one color judges. */
constexpr double kStrong = 0.2;

}  // namespace

NeuralNetwork::Shape BallDetector::shape() {
  return {{PatchSampler::kSize, PatchSampler::kSize}, kNumOutputs, {1, 1}};
}

double BallDetector::saturation(const cv::Mat& patch) {
  cv::Vec3i bgr(0, 0, 0);
  for (int y = kMiddle.y; y < kMiddle.br().y; ++y) {
    const auto* row = patch.ptr<cv::Vec3b>(y);
    for (int x = kMiddle.x; x < kMiddle.br().x; ++x) bgr += row[x];
  }
  if (bgr[2] < kLeastRed * bgr[1]) return 0;
  return static_cast<double>(bgr[2] - std::min(bgr[0], bgr[1])) / (bgr[0] + bgr[1] + bgr[2] + 1);
}

cv::Mat_<float> BallDetector::run(const std::vector<cv::Mat>& patches) const {
  std::array<std::vector<cv::Mat>, 2> parts;
  std::array<std::vector<int>, 2> rows;
  for (size_t i = 0; i < patches.size(); ++i) {
    const double color = saturation(patches[i]);
    for (const bool is_colored : {false, true}) {
      if (is_colored ? color < kColored : color > kStrong) continue;
      parts[is_colored].push_back(patches[i]);
      rows[is_colored].push_back(static_cast<int>(i));
    }
  }
  cv::Mat_<float> outputs = cv::Mat_<float>::zeros(static_cast<int>(patches.size()), kNumOutputs);
  if (!patches.empty()) outputs.col(0) = -std::numeric_limits<float>::infinity();
  for (const bool is_colored : {false, true}) {
    const cv::Mat_<float> some =
        (is_colored ? networks_.colored : networks_.patterned)->run(parts[is_colored]);
    for (int i = 0; i < some.rows; ++i) {
      const int row = rows[is_colored][static_cast<size_t>(i)];
      if (some(i, 0) > outputs(row, 0)) some.row(i).copyTo(outputs.row(row));
    }
  }
  return outputs;
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
  cv::Mat_<float> outputs = run(patches);
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
    if (best && candidate.log_odds <= best->log_odds) continue;
    if (candidate.probability() >= kAccept &&
        is_checkerboard(
            sampler.sample(candidate.circle.center, kBoardRadii * candidate.circle.radius))) {
      continue;
    }
    best = candidate;
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

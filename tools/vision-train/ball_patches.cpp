#include "tools/vision-train/ball_patches.h"

#include <algorithm>
#include <cmath>

#include "daemons/vision/ball_candidates.h"
#include "daemons/vision/ball_filter.h"

namespace nao::vision {
namespace {

/** Less visible balls are neither ball nor something else. Below what nao-vision-eval requires,
 * 0.6, since a ball that is half hidden should be found too. */
constexpr double kLeastVisible = 0.35;
/** The same for a ball that a border of the image cuts. */
constexpr double kLeastVisibleCut = 0.25;
/** A circle shows the ball within the nearer limits: offset in radii, ratio of the radii. Beyond
 * the farther ones it does not; between them it is not used. */
constexpr float kNear = 0.8f;
constexpr float kNearRatio = 1.7f;
constexpr float kFar = 1.15f;
constexpr float kFarRatio = 2.2f;
/** Moved circles around each ball, and random ones in each image. */
constexpr int kNumMoved = 6;
constexpr int kNumRandom = 2;
/** Least probability of what is judged a second time. It is below BallDetector's, 0.05, so that
 * patches that it narrowly leaves out are learnt from, too. */
constexpr float kLeastSecond = 0.02f;

}  // namespace

BallPatches::BallPatches(PatchFile& file, std::shared_ptr<NeuralNetwork> objects,
                         std::shared_ptr<NeuralNetwork> ball, bool is_colored, uint64_t seed)
    : file_(file),
      objects_(std::move(objects)),
      ball_network_(std::move(ball)),
      is_colored_(is_colored),
      random_(seed) {}

void BallPatches::add_circle(const PatchSampler& sampler, const Circle& circle, Source source) {
  const cv::Mat patch = sampler.sample(circle.center, BallDetector::kPatchRadii * circle.radius);
  if (is_colored_ && BallDetector::saturation(patch) < BallDetector::kColored) return;
  PatchFile::Numbers numbers{};
  if (ball_.radius > 0) {
    const cv::Point2f offset = (ball_.center - circle.center) * (1 / circle.radius);
    const float ratio = ball_.radius / circle.radius;
    const auto distance = static_cast<float>(cv::norm(offset));
    const float factor = std::max(ratio, 1 / ratio);
    const bool is_near = distance < kNear * std::max(1.0f, ratio) && factor < kNearRatio;
    const bool is_far = distance > kFar * std::max(1.0f, ratio) || factor > kFarRatio;
    if (!is_far && (!is_near || visible_ < least_visible_)) return;
    if (is_near) {
      numbers[0] = 1;
      numbers[1] = offset.x;
      numbers[2] = offset.y;
      numbers[3] = std::log(ratio);
      numbers[4] = static_cast<float>(visible_);
    }
  }
  numbers[5] = circle.radius;
  numbers[6] = static_cast<float>(image_);
  numbers[7] = static_cast<float>(source);
  file_.add(patch, numbers);
}

void BallPatches::add(const LabelledImage& image, const cv::Mat& bgr) {
  ++image_;
  const PatchSampler sampler(bgr);
  ball_ = {};
  double distance = 0;
  for (const Label& label : *image.labels) {
    if (label.object.kind != Kind::kBall) continue;
    const Eigen::Vector4f box = label.object.box_px.cast<float>();
    ball_ = {{0.5f * (box[0] + box[2]), 0.5f * (box[1] + box[3])}, 0.5f * (box[2] - box[0])};
    visible_ = label.visible;
    distance = label.object.position.norm();
  }
  const bool is_cut = ball_.radius > 0 &&
                      (ball_.center.x < ball_.radius || ball_.center.x + ball_.radius > bgr.cols ||
                       ball_.center.y + ball_.radius > bgr.rows);
  least_visible_ = is_cut ? kLeastVisibleCut : kLeastVisible;
  // In every second image the pose is unknown: then there are places of all sizes.
  const CameraGeometry geometry(*image.calibration,
                                image_ % 2 == 0 ? image.pose_camera_in_heading : std::nullopt);
  std::vector<Circle> places = objects_.detect(sampler.half(), bgr.cols, bgr.rows, geometry).balls;
  const FieldView view = FieldDetector().detect(bgr, geometry);
  const std::vector<Circle> more = find_ball_hints(view, geometry, kBallRadius);
  places.insert(places.end(), more.begin(), more.end());
  recall_.num_places += static_cast<int>(places.size());
  ++recall_.num_images;
  if (ball_.radius > 0 && visible_ >= 0.6 && distance < 5) {
    const int range = distance < 3 ? 0 : 1;
    ++recall_.num_balls[range];
    recall_.num_found[range] += std::any_of(places.begin(), places.end(), [&](const Circle& at) {
      const float ratio = at.radius / ball_.radius;
      return cv::norm(at.center - ball_.center) < kNear * ball_.radius && ratio > 1 / kNearRatio &&
             ratio < kNearRatio;
    });
  }
  for (const Circle& place : places) add_circle(sampler, place, Source::kPlace);
  for (int i = 0; ball_.radius > 0 && i < kNumMoved; ++i) {
    const auto angle = static_cast<float>(random_.uniform(0, 2 * M_PI));
    const auto radius = static_cast<float>(ball_.radius * std::exp(random_.uniform(-0.4, 0.4)));
    const auto way = static_cast<float>(random_.uniform(0, 0.75)) * radius;
    const cv::Point2f offset(way * std::cos(angle), way * std::sin(angle));
    add_circle(sampler, {ball_.center + offset, radius}, Source::kMoved);
  }
  for (int i = 0; i < kNumRandom; ++i) {
    const cv::Point2f center(static_cast<float>(random_.uniform(0, bgr.cols)),
                             static_cast<float>(random_.uniform(0, bgr.rows)));
    add_circle(sampler, {center, static_cast<float>(std::exp(random_.uniform(1.4, 4.2)))},
               Source::kRandom);
  }
  if (!ball_network_) return;
  const BallDetector detector({ball_network_, ball_network_});
  for (const BallCandidate& candidate : detector.judge(sampler, places)) {
    if (candidate.probability() > kLeastSecond) {
      add_circle(sampler, candidate.circle, Source::kSecond);
    }
  }
}

}  // namespace nao::vision

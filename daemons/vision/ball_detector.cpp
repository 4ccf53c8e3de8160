#include "daemons/vision/ball_detector.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "daemons/vision/ball_candidates.h"

namespace nao::vision {
namespace {

constexpr int kNumAngles = 32;
/** Angles that must lie in the image; fewer for a ball below the robot's chin, where little else is
 * round. */
constexpr int kLeastAngles = 18;
constexpr int kLeastAnglesBelow = 12;
/** Candidates with a weaker edge than this before the fit are not fitted. */
constexpr float kLeastEdge = 0.12f;
/** The fitted radius may differ from the expected one by this factor. */
constexpr float kRadiusRange = 1.25f;
constexpr float kFreeRadiusRange = 1.6f;

/** Unit vectors. */
std::array<cv::Point2f, kNumAngles> make_directions() {
  std::array<cv::Point2f, kNumAngles> directions;
  for (int i = 0; i < kNumAngles; ++i) {
    const double angle = 2 * M_PI * i / kNumAngles;
    directions[i] = {static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle))};
  }
  return directions;
}

/** Mean step of FieldView::other across a circle, 0 to 1. Pixels of the full image. */
float edge_of(const FieldView& view, const cv::Point2f& center, float radius) {
  // Computed once; the same for every circle.
  static const std::array<cv::Point2f, kNumAngles> directions = make_directions();
  // A pixel of the half-size image at least on each side of the edge.
  const float inner = std::min(0.82f * radius, radius - 1.2f);
  const float outer = std::max(1.2f * radius, radius + 1.6f);
  int count = 0;
  float sum = 0;
  for (const cv::Point2f& direction : directions) {
    const cv::Point2f out = (center + outer * direction) * 0.5f;
    if (out.x < 0 || out.y < 0 || out.x >= static_cast<float>(view.other.cols) ||
        out.y >= static_cast<float>(view.other.rows)) {
      continue;
    }
    const cv::Point2f in = (center + inner * direction) * 0.5f;
    const int x = std::clamp(static_cast<int>(in.x), 0, view.other.cols - 1);
    const int y = std::clamp(static_cast<int>(in.y), 0, view.other.rows - 1);
    const int inside = view.other(y, x);
    const int outside = view.other(static_cast<int>(out.y), static_cast<int>(out.x));
    // Only a step from ball to field counts, not the reverse.
    sum += static_cast<float>(std::max(0, inside - outside)) / 255;
    ++count;
  }
  const bool is_cut_below = center.y + radius > static_cast<float>(2 * view.other.rows);
  return count < (is_cut_below ? kLeastAnglesBelow : kLeastAngles)
             ? 0
             : sum / static_cast<float>(count);
}

// Coordinate search (pattern search) over x, y and radius: 27 neighbors, then half of the step. It
// needs no derivatives, which a sum over pixels does not have.
/** Moves and scales the circle to the steepest edge, with halving steps. */
void fit(const FieldView& view, BallCandidate& candidate, float least, float most) {
  candidate.edge = edge_of(view, candidate.center, candidate.radius);
  float step = std::max(1.0f, 0.3f * candidate.radius);
  while (step > 0.4f) {
    const BallCandidate start = candidate;
    for (int dx = -1; dx <= 1; ++dx) {
      for (int dy = -1; dy <= 1; ++dy) {
        for (int dr = -1; dr <= 1; ++dr) {
          const auto offset = [step](int sign) { return step * static_cast<float>(sign); };
          const cv::Point2f center = start.center + cv::Point2f(offset(dx), offset(dy));
          const float radius = std::clamp(start.radius + 0.7f * offset(dr), least, most);
          const float edge = edge_of(view, center, radius);
          if (edge <= candidate.edge) continue;
          candidate.center = center;
          candidate.radius = radius;
          candidate.edge = edge;
        }
      }
    }
    step *= 0.55f;
  }
}

/** Brightness and saturation of the disk, compared with the field around it. */
void judge_pattern(const FieldView& view, BallCandidate& candidate) {
  std::vector<float> light;
  // Of pixels that do not have the field's color.
  std::vector<float> own_light;
  std::vector<std::pair<float, float>> saturation;  // brightness, saturation
  const float r = 0.85f * candidate.radius;
  const float step = std::max(1.0f, r / 7);
  const auto is_in = [&](const cv::Point2f& p) {
    return p.x >= 0 && p.y >= 0 && p.x < static_cast<float>(view.smooth.cols) &&
           p.y < static_cast<float>(view.smooth.rows);
  };
  for (float dy = -r; dy <= r; dy += step) {
    for (float dx = -r; dx <= r; dx += step) {
      const cv::Point2f p = candidate.center + cv::Point2f(dx, dy);
      if (dx * dx + dy * dy > r * r || !is_in(p)) continue;
      const cv::Vec3b& color = view.smooth(static_cast<int>(p.y), static_cast<int>(p.x));
      const int high = std::max({color[0], color[1], color[2]});
      const int low = std::min({color[0], color[1], color[2]});
      // whiteness() is the mean of red and blue.
      light.push_back(whiteness(color));
      if (!view.is_green(color)) own_light.push_back(whiteness(color));
      saturation.push_back(
          {whiteness(color), static_cast<float>(high - low) / static_cast<float>(high + 10)});
    }
  }
  if (light.size() < 6) return;
  std::sort(light.begin(), light.end());
  // 90 % quantile: the bright parts of the ball, without single highlights.
  const float bright = light[light.size() * 9 / 10];
  // Of the bright pixels, since that of dark ones is noise: colored parts of robots are bright.
  std::vector<float> of_bright;
  for (const auto& [brightness, value] : saturation) {
    if (brightness > 0.45f * bright) of_bright.push_back(value);
  }
  std::sort(of_bright.begin(), of_bright.end());
  // 80 % quantile of the saturation.
  candidate.saturation = of_bright[of_bright.size() * 8 / 10];
  // Dark: below 62 % of the bright parts, as the pentagons of the ball are.
  const auto num_dark = std::count_if(own_light.begin(), own_light.end(),
                                      [bright](float value) { return value < 0.62f * bright; });
  candidate.green = 1 - static_cast<float>(own_light.size()) / static_cast<float>(light.size());
  candidate.dark = static_cast<float>(num_dark) / static_cast<float>(light.size());
  // Mean whiteness of the field just outside of the ball, where the ring is field.
  float field = 0;
  int num_field = 0;
  for (int i = 0; i < 16; ++i) {
    const double angle = 2 * M_PI * i / 16;
    const float reach = 1.5f * candidate.radius + 2;
    const cv::Point2f p =
        candidate.center + reach * cv::Point2f(static_cast<float>(std::cos(angle)),
                                               static_cast<float>(std::sin(angle)));
    if (!is_in(p)) continue;
    const cv::Vec3b& color = view.smooth(static_cast<int>(p.y), static_cast<int>(p.x));
    if (!view.is_green(color)) continue;
    field += whiteness(color);
    ++num_field;
  }
  candidate.contrast = num_field == 0 ? 0 : bright - field / static_cast<float>(num_field);
}

/** 0 below `low`, 1 above `high`. */
double ramp(double value, double low, double high) {
  return std::clamp((value - low) / (high - low), 0.0, 1.0);
}

}  // namespace

// Product of scores between 0 and 1, one for each property that a ball must have: one property that
// is missing suffices to reject.
double BallDetector::confidence(const BallCandidate& c) {
  // Tuned on rendered and real images; docs/vision.md has the figures.
  const double pattern = ramp(c.dark, 0.03, 0.10) * (1 - ramp(c.dark, 0.55, 0.75));
  // The edge of a distant ball is less steep.
  const double least_edge = 0.30 + 0.08 * ramp(c.radius, 6, 10);
  // A distant ball shows few dark pixels.
  const double weight = ramp(c.radius, 4, 9);
  return ramp(c.edge, least_edge, least_edge + 0.26) * ramp(c.contrast, 8, 30) *
         (1 - ramp(c.saturation, 0.32, 0.55)) * (1 - ramp(c.green, 0.15, 0.4)) *
         (weight * pattern + (1 - weight) * 0.9);
}

std::vector<BallCandidate> BallDetector::candidates(const FieldView& view,
                                                    const CameraGeometry& geometry) const {
  std::vector<BallCandidate> candidates;
  // Without a pose the radius of a hint is less certain.
  const float range = geometry.has_pose() ? kRadiusRange : kFreeRadiusRange;
  for (const BallHint& hint : find_ball_hints(view, geometry, radius_)) {
    BallCandidate candidate;
    candidate.center = hint.center;
    candidate.radius = hint.radius;
    if (edge_of(view, hint.center, hint.radius) < kLeastEdge) continue;
    fit(view, candidate, hint.radius / range, hint.radius * range);
    if (!view.is_inside(candidate.center.x, candidate.center.y)) continue;
    judge_pattern(view, candidate);
    candidates.push_back(candidate);
  }
  std::sort(candidates.begin(), candidates.end(),
            [](const BallCandidate& a, const BallCandidate& b) {
              return confidence(a) * a.edge > confidence(b) * b.edge;
            });
  return candidates;
}

std::optional<Detection> BallDetector::detect(const FieldView& view,
                                              const CameraGeometry& geometry) const {
  const std::vector<BallCandidate> found = candidates(view, geometry);
  if (found.empty() || confidence(found[0]) < kAccept) return std::nullopt;
  const BallCandidate& ball = found[0];
  Detection detection;
  detection.kind = Kind::kBall;
  const double r = ball.radius;
  detection.box_px = {ball.center.x - r, ball.center.y - r, ball.center.x + r, ball.center.y + r};
  if (const auto ground = geometry.locate(geometry.undistorted(ball.center), radius_)) {
    detection.position = ground->position;
    detection.covariance = ground->covariance;
  }
  detection.confidence = confidence(ball);
  return detection;
}

}  // namespace nao::vision

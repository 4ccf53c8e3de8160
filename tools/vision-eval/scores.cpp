#include "tools/vision-eval/scores.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "common/constants.h"
#include "kinematics/pose2.h"

namespace nao::vision {
namespace {

const std::array<const char*, 4> kRanges = {"to 3 m", "3 to 5 m", "beyond 5 m", "unknown"};
/** Distance from a line's center that counts as on it, pixels. */
constexpr double kLineTolerance = 4;
/** Distance between the points by which lines are compared, pixels. */
constexpr double kLineStep = 4;

int range_of(const Detection& object) {
  if (!object.has_position()) return 3;
  const double distance = object.position.norm();
  return distance < 3 ? 0 : distance < 5 ? 1 : 2;
}

Eigen::Vector2d center(const Detection& object) {
  return {0.5 * (object.box_px[0] + object.box_px[2]), 0.5 * (object.box_px[1] + object.box_px[3])};
}

// Area of the intersection over that of the union of both boxes; 0 without an intersection.
double intersection_over_union(const Detection& a, const Detection& b) {
  const auto area = [](const Eigen::Vector4d& box) {
    return std::max(0.0, box[2] - box[0]) * std::max(0.0, box[3] - box[1]);
  };
  const Eigen::Vector4d both(std::max(a.box_px[0], b.box_px[0]), std::max(a.box_px[1], b.box_px[1]),
                             std::min(a.box_px[2], b.box_px[2]),
                             std::min(a.box_px[3], b.box_px[3]));
  const double common = both[2] > both[0] && both[3] > both[1] ? area(both) : 0;
  return common / (area(a.box_px) + area(b.box_px) - common + 1e-9);
}

// Whether a detection `a` is the labelled object `b`: tolerances in pixels, or on the ground, m,
// where both have a position.
bool matches(const Detection& a, const Detection& b) {
  const double distance = (center(a) - center(b)).norm();
  switch (a.kind) {
    case Kind::kBall: {
      const double radius = 0.5 * (b.box_px[2] - b.box_px[0]);
      return distance < std::max(4.0, 0.8 * radius);
    }
    case Kind::kCenterCircle:
      return a.has_position() && b.has_position() && (a.position - b.position).norm() < 0.3;
    case Kind::kRobot:
    case Kind::kGoalPost:
      if (a.has_position() && b.has_position() &&
          (a.position - b.position).norm() < 0.15 + 0.12 * b.position.norm()) {
        return true;
      }
      return intersection_over_union(a, b) > 0.35;
    default:
      return distance < 18;
  }
}

/** Crossings of all types are one row. */
Kind row_kind(Kind kind) {
  return kind == Kind::kCrossingT || kind == Kind::kCrossingX ? Kind::kCrossingL : kind;
}

double distance_to(const Eigen::Vector2d& point, const Eigen::Vector4d& line) {
  const Eigen::Vector2d a = line.head<2>();
  const Eigen::Vector2d d = line.tail<2>() - a;
  // Parameter of the nearest point of the segment; the small number is for segments of no length.
  const double t = std::clamp((point - a).dot(d) / (d.squaredNorm() + 1e-9), 0.0, 1.0);
  return (a + t * d - point).norm();
}

/** Length of `line` that is near to one of `others`, and its whole length, pixels. */
std::pair<double, double> covered_length(const Eigen::Vector4d& line,
                                         const std::vector<Eigen::Vector4d>& others) {
  const Eigen::Vector2d a = line.head<2>();
  const Eigen::Vector2d d = line.tail<2>() - a;
  const int num_steps = std::max(1, static_cast<int>(d.norm() / kLineStep));
  int num_near = 0;
  for (int i = 0; i < num_steps; ++i) {
    const Eigen::Vector2d point = a + d * ((i + 0.5) / num_steps);
    num_near += std::any_of(others.begin(), others.end(), [&](const Eigen::Vector4d& other) {
      return distance_to(point, other) < kLineTolerance;
    });
  }
  return {d.norm() * num_near / num_steps, d.norm()};
}

double median(std::vector<double> values) {
  if (values.empty()) return kUnknown;
  std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
  return values[values.size() / 2];
}

std::string percent(double part, double whole) {
  return whole > 0 ? fmt::format("{:.1f} %", 100 * part / whole) : "-";
}

}  // namespace

// Lines are scored by length: a detector may divide one line into several segments.
void Scores::add_lines(const LabelledImage& image, const Detections& detections) {
  std::vector<Eigen::Vector4d> found;
  for (const Detection& d : detections) {
    if (d.kind == Kind::kLine) found.push_back(d.line_px);
  }
  std::vector<Eigen::Vector4d> labelled;
  for (const Label& label : *image.labels) {
    if (label.object.kind != Kind::kLine) continue;
    labelled.push_back(label.object.line_px);
    const auto [near, length] = covered_length(label.object.line_px, found);
    Row& row = rows_[{kind_name(Kind::kLine), range_of(label.object)}];
    row.num_labels += length;
    row.num_found += near;
  }
  for (const Detection& d : detections) {
    if (d.kind != Kind::kLine) continue;
    const auto [near, length] = covered_length(d.line_px, labelled);
    Row& row = rows_[{kind_name(Kind::kLine), range_of(d)}];
    row.num_detections += length;
    row.num_false += length - near;
  }
}

void Scores::add_objects(Kind kind, const LabelledImage& image, const Detections& detections) {
  std::vector<bool> is_used(detections.size(), false);
  for (const Label& label : *image.labels) {
    if (row_kind(label.object.kind) != kind) continue;
    Row& row = rows_[{kind_name(kind), range_of(label.object)}];
    // Objects that are hardly visible need not be found, but finding them is not an error.
    const bool is_required = label.visible >= kLeastVisible;
    row.num_labels += is_required;
    for (size_t i = 0; i < detections.size(); ++i) {
      if (is_used[i] || row_kind(detections[i].kind) != kind ||
          !matches(detections[i], label.object)) {
        continue;
      }
      // Each detection counts for only one label.
      is_used[i] = true;
      if (!is_required) break;
      row.num_found += 1;
      row.num_detections += 1;
      if (detections[i].has_position() && label.object.has_position()) {
        const Eigen::Vector2d& p = detections[i].position;
        const Eigen::Vector2d& q = label.object.position;
        const double turn = std::atan2(p.y(), p.x()) - std::atan2(q.y(), q.x());
        row.bearing_errors.push_back(std::abs(wrapped(turn)));
        row.distance_errors.push_back(std::abs(p.norm() - q.norm()) / q.norm());
      }
      break;
    }
  }
  // The remaining detections belong to no label.
  for (size_t i = 0; i < detections.size(); ++i) {
    if (is_used[i] || row_kind(detections[i].kind) != kind) continue;
    Row& row = rows_[{kind_name(kind), range_of(detections[i])}];
    row.num_detections += 1;
    row.num_false += 1;
  }
}

void Scores::add(const LabelledImage& image, const Detections& detections) {
  if (!image.labels) return;
  add_lines(image, detections);
  for (const Kind kind :
       {Kind::kBall, Kind::kCrossingL, Kind::kCenterCircle, Kind::kGoalPost, Kind::kRobot}) {
    add_objects(kind, image, detections);
  }
}

std::string Scores::table() const {
  std::string text =
      fmt::format("{:14} {:11} {:>8} {:>9} {:>7} {:>10} {:>11} {:>11}\n", "kind", "distance",
                  "labels", "recall", "false", "precision", "bearing deg", "distance");
  for (const auto& [key, row] : rows_) {
    const double bearing = median(row.bearing_errors) / kDegree;
    const double distance = 100 * median(row.distance_errors);
    text += fmt::format(
        "{:14} {:11} {:8.0f} {:>9} {:7.0f} {:>10} {:11.2f} {:9.1f} %\n", key.first,
        kRanges[key.second], row.num_labels, percent(row.num_found, row.num_labels), row.num_false,
        percent(row.num_detections - row.num_false, row.num_detections), bearing, distance);
  }
  return text;
}

}  // namespace nao::vision

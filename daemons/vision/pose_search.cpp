#include "daemons/vision/pose_search.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>

namespace nao::vision {
namespace {

/** Number of newest observations from which hypotheses come, and of pairs of lines of each. */
constexpr int kNumSources = 4;
constexpr int kNumPairs = 3;
/** Number of the best that are refined, the number of steps, and the distance beyond which they are
 * different places, m and rad. */
constexpr size_t kNumRefined = 12;
constexpr int kNumIterations = 4;

Eigen::Vector2d quarter_turn(const Eigen::Vector2d& v) {
  return {-v.y(), v.x()};
}

void add_once(double value, std::vector<double>& values) {
  if (std::none_of(values.begin(), values.end(),
                   [&](double other) { return std::abs(other - value) < 1e-6; })) {
    values.push_back(value);
  }
}

FieldLine moved(const Pose2& pose, const FieldLine& line) {
  return {pose * line.from, pose * line.to};
}

}  // namespace

PoseSearch::PoseSearch(const FieldModel& field, const VisionParameters::PoseSearch& parameters)
    : field_(&field), parameters_(parameters) {
  for (const FieldLine& line : field.lines()) {
    const bool is_along_x =
        std::abs(line.to.x() - line.from.x()) > std::abs(line.to.y() - line.from.y());
    if (is_along_x) {
      add_once(line.from.y(), along_x_);
    } else {
      add_once(line.from.x(), along_y_);
    }
  }
}

bool PoseSearch::is_same_place(const Pose2& a, const Pose2& b) const {
  return (a.position - b.position).norm() < parameters_.same_position &&
         std::abs(wrapped(a.heading - b.heading)) < parameters_.same_heading;
}

// The field line with the least distance of both ends, among those with its direction.
PoseSearch::Match PoseSearch::match(const FieldLine& line) const {
  const Eigen::Vector2d direction = (line.to - line.from).normalized();
  Match best{nullptr, std::numeric_limits<double>::infinity()};
  for (const FieldLine& candidate : field_->lines()) {
    const Eigen::Vector2d step = candidate.to - candidate.from;
    const double length = step.norm();
    const Eigen::Vector2d along = step / length;
    if (std::abs(along.dot(direction)) < std::cos(parameters_.most_line_angle)) continue;
    const double s = (line.from - candidate.from).dot(along);
    const double t = (line.to - candidate.from).dot(along);
    if (std::min(s, t) < -parameters_.beyond_end ||
        std::max(s, t) > length + parameters_.beyond_end)
      continue;
    const Eigen::Vector2d normal = quarter_turn(along);
    const double distance = std::max(std::abs(normal.dot(line.from - candidate.from)),
                                     std::abs(normal.dot(line.to - candidate.from)));
    if (distance < best.distance) best = {&candidate, distance};
  }
  return best;
}

double PoseSearch::line_score(const FieldLine& line, const Eigen::Vector2d& camera) const {
  const double range = (0.5 * (line.from + line.to) - camera).norm();
  const double tolerance = parameters_.tolerance + parameters_.tolerance_of_distance * range;
  double distance = match(line).distance;
  // A chord of the circle lies within a few centimeters of it.
  if ((line.to - line.from).norm() < 1) {
    const double radius = field_->circle_radius();
    distance = std::min(
        distance, std::max(std::abs(line.from.norm() - radius), std::abs(line.to.norm() - radius)));
  }
  const double ratio = distance / tolerance;
  return std::max(0.0, 1 - ratio * ratio);
}

double PoseSearch::score(const Pose2& pose,
                         const std::vector<FieldObservation>& observations) const {
  double sum = 0;
  double weights = 0;
  for (const FieldObservation& observation : observations) {
    const Eigen::Vector2d camera = pose * Eigen::Vector2d(observation.camera.position.head<2>());
    for (const FieldLine& line : observation.lines) {
      const double weight = std::min(parameters_.most_length, (line.to - line.from).norm());
      weights += weight;
      sum += weight * line_score(moved(pose, line), camera);
    }
    if (observation.circle) {
      const Eigen::Vector2d center = pose * *observation.circle;
      const double tolerance = 2 * (parameters_.tolerance +
                                    parameters_.tolerance_of_distance * (center - camera).norm());
      weights += parameters_.circle_weight;
      sum += parameters_.circle_weight *
             std::max(0.0, 1 - center.squaredNorm() / (tolerance * tolerance));
    }
  }
  return weights > 0 ? sum / weights : 0;
}

void PoseSearch::add_hypotheses(const FieldObservation& observation, double heading,
                                std::vector<Pose2>& hypotheses) const {
  std::vector<FieldLine> lines;
  for (const FieldLine& line : observation.lines) {
    if ((line.to - line.from).norm() >= parameters_.least_pair_length) lines.push_back(line);
  }
  const auto length = [](const FieldLine& line) { return (line.to - line.from).norm(); };
  std::sort(lines.begin(), lines.end(),
            [&](const FieldLine& a, const FieldLine& b) { return length(a) > length(b); });
  const auto add = [&](const Eigen::Vector2d& position, double angle) {
    const Pose2 pose{position, wrapped(angle)};
    // Poses may be at most half a meter beyond the carpet.
    const bool is_near = (position.cwiseAbs() - field_->half_carpet()).maxCoeff() < 0.5;
    if (is_near && std::abs(wrapped(angle - heading)) < parameters_.most_turn)
      hypotheses.push_back(pose);
  };
  int num_pairs = 0;
  for (size_t i = 0; i < lines.size() && num_pairs < kNumPairs; ++i) {
    const Eigen::Vector2d a = lines[i].to - lines[i].from;
    const double direction = std::atan2(a.y(), a.x());
    if (observation.circle && num_pairs == 0) {
      for (int turn = 0; turn < 4; ++turn) {
        const double angle = turn * M_PI / 2 - direction;
        add(-(Eigen::Rotation2Dd(angle) * *observation.circle), angle);
      }
    }
    for (size_t j = i + 1; j < lines.size() && num_pairs < kNumPairs; ++j) {
      const Eigen::Vector2d b = lines[j].to - lines[j].from;
      const double cosine = std::abs(a.dot(b)) / (a.norm() * b.norm());
      if (cosine > std::cos(parameters_.least_crossing)) continue;
      ++num_pairs;
      const Eigen::Vector2d on_a = 0.5 * (lines[i].from + lines[i].to);
      const Eigen::Vector2d on_b = 0.5 * (lines[j].from + lines[j].to);
      for (int turn = 0; turn < 4; ++turn) {
        // Line a lies along x in even turns, along y in odd ones.
        const double angle = turn * M_PI / 2 - direction;
        const Eigen::Vector2d first = Eigen::Rotation2Dd(angle) * (turn % 2 == 0 ? on_a : on_b);
        const Eigen::Vector2d other = Eigen::Rotation2Dd(angle) * (turn % 2 == 0 ? on_b : on_a);
        for (const double y : along_x_) {
          for (const double x : along_y_) add({x - other.x(), y - first.y()}, angle);
        }
      }
    }
  }
}

// Gauss-Newton on the distances of the observed ends from their field lines, by the pose and the
// tilt. Each observation adds the tilt's prior, since its points have their errors in common.
PoseSearch::Result PoseSearch::refined(const Pose2& start,
                                       const std::vector<FieldObservation>& observations) const {
  using Matrix = Eigen::Matrix<double, 5, 5>;
  using Vector = Eigen::Matrix<double, 5, 1>;
  Pose2 pose = start;
  Eigen::Vector2d tilt = Eigen::Vector2d::Zero();
  std::vector<FieldObservation> corrected = observations;
  for (int iteration = 0; iteration < kNumIterations; ++iteration) {
    Matrix normal = Matrix::Identity() * 1e-3;
    Vector right = Vector::Zero();
    const double prior = static_cast<double>(observations.size()) /
                         (parameters_.common_tilt_sigma * parameters_.common_tilt_sigma);
    normal.diagonal().tail<2>().array() += prior;
    right.tail<2>() -= prior * tilt;
    const auto add = [&](const FieldObservation& observation, const Eigen::Vector2d& point,
                         const Eigen::Vector2d& direction, double target, double tolerance) {
      const Eigen::Vector2d seen = pose * point;
      const double residual = target - direction.dot(seen);
      Vector slope;
      slope << direction, direction.dot(quarter_turn(seen - pose.position)),
          observation.tilt_jacobian(point).transpose() * (pose.inverse().rotate(direction));
      const double weight = 1 / (tolerance * tolerance);
      normal += weight * slope * slope.transpose();
      right += weight * residual * slope;
    };
    for (const FieldObservation& observation : corrected) {
      const Eigen::Vector2d camera = observation.camera.position.head<2>();
      const auto tolerance = [&](const Eigen::Vector2d& point) {
        return parameters_.tolerance + parameters_.tolerance_of_distance * (point - camera).norm();
      };
      for (const FieldLine& line : observation.lines) {
        const Match found = match(moved(pose, line));
        if (found.line == nullptr || found.distance > 2 * tolerance(line.from)) continue;
        const Eigen::Vector2d across =
            quarter_turn((found.line->to - found.line->from).normalized());
        add(observation, line.from, across, across.dot(found.line->from), tolerance(line.from));
        add(observation, line.to, across, across.dot(found.line->from), tolerance(line.to));
      }
      if (observation.circle && (pose * *observation.circle).norm() < 1) {
        for (const Eigen::Vector2d& axis : {Eigen::Vector2d(Eigen::Vector2d::UnitX()),
                                            Eigen::Vector2d(Eigen::Vector2d::UnitY())}) {
          add(observation, *observation.circle, axis, 0, tolerance(*observation.circle));
        }
      }
    }
    const Vector step = normal.ldlt().solve(right);
    pose.position += step.head<2>();
    pose.heading = wrapped(pose.heading + step[2]);
    tilt += step.tail<2>();
    for (size_t i = 0; i < observations.size(); ++i) corrected[i] = observations[i].tilted(tilt);
  }
  return {pose, tilt, score(pose, corrected)};
}

std::optional<PoseSearch::Result> PoseSearch::find(
    const std::vector<FieldObservation>& observations, double heading) const {
  std::vector<Pose2> hypotheses;
  int num_sources = 0;
  for (auto i = observations.rbegin(); i != observations.rend() && num_sources < kNumSources; ++i) {
    const size_t before = hypotheses.size();
    add_hypotheses(*i, heading, hypotheses);
    if (hypotheses.size() > before) ++num_sources;
  }
  const auto is_better = [](const Result& a, const Result& b) { return a.score > b.score; };
  // Keeps the best hypothesis of each place.
  const auto thinned = [&](std::vector<Result> results, size_t limit) {
    std::sort(results.begin(), results.end(), is_better);
    std::vector<Result> kept;
    for (const Result& result : results) {
      const bool is_new = std::none_of(kept.begin(), kept.end(), [&](const Result& other) {
        return is_same_place(other.pose, result.pose);
      });
      if (is_new) kept.push_back(result);
      if (kept.size() == limit) break;
    }
    return kept;
  };
  std::vector<Result> scored;
  for (const Pose2& pose : hypotheses) {
    scored.push_back({pose, Eigen::Vector2d::Zero(), score(pose, observations)});
  }
  scored = thinned(std::move(scored), kNumRefined);
  for (Result& result : scored) result = refined(result.pose, observations);
  scored = thinned(std::move(scored), 2);
  if (scored.empty() || scored[0].score < parameters_.least_score) return std::nullopt;
  if (scored.size() > 1 && scored[1].score > scored[0].score - parameters_.margin)
    return std::nullopt;
  return scored[0];
}

}  // namespace nao::vision

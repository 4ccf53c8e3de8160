#include "daemons/vision/localizer.h"

#include <algorithm>
#include <cmath>

namespace nao::vision {
namespace {

/** Observations are kept this far apart, microseconds, and so many of them. */
constexpr size_t kKeep = 40;
/** The newest so many decide whether the pose fits, if they have this much to see, m. */
constexpr size_t kRecent = 8;
/** Score below which the pose does not fit; and the number of times in succession after which it is
 * lost. */
constexpr int kMostMisfits = 4;

}  // namespace

Localizer::Localizer(const FieldModel& field, const Pose2& start,
                     const VisionParameters& parameters)
    : parameters_(parameters.localizer),
      field_(field),
      start_(start),
      filter_(field_, parameters.pose_filter),
      search_(field_, parameters.pose_search) {}

void Localizer::restart(const Pose2& heading_in_odometry) {
  is_started_ = true;
  is_lost_ = false;
  num_misfits_ = 0;
  window_.clear();
  usual_tilt_.setZero();
  num_fits_ = 0;
  remembered_utime_ = searched_utime_ = 0;
  filter_.start(start_, parameters_.start_position, parameters_.start_heading);
  // The walk before this program started adds its uncertainty.
  filter_.predict(heading_in_odometry, 0);
}

void Localizer::predict(int64_t utime, const Pose2& heading_in_odometry, bool is_upright) {
  if (!is_started_ || utime < utime_) {
    restart(heading_in_odometry);
  } else {
    const double dt = 1e-6 * static_cast<double>(utime - utime_);
    const Pose2 step = odometry_.inverse() * heading_in_odometry;
    if (step.position.norm() > parameters_.jump_distance + parameters_.jump_speed * dt) {
      filter_.spread(parameters_.jump_position, parameters_.jump_heading);
      window_.clear();
    } else {
      filter_.predict(step, dt);
    }
    if (is_upright && !is_upright_) {
      filter_.spread(parameters_.fall_position, parameters_.fall_heading);
      window_.clear();
    }
  }
  is_upright_ = is_upright;
  utime_ = utime;
  odometry_ = heading_in_odometry;
}

FieldPose Localizer::estimate() const {
  return {is_started_ && !is_lost_, filter_.pose(), filter_.covariance()};
}

Eigen::Vector2d Localizer::tilt() const {
  if (!estimate().is_known || !is_upright_) return Eigen::Vector2d::Zero();
  return filter_.tilt_of_image();
}

void Localizer::observe(const FieldObservation& observation) {
  if (!is_started_ || !is_upright_) return;
  if (!is_lost_) filter_.update(observation);
  if (utime_ - remembered_utime_ < std::llround(1e6 * parameters_.keep_period)) return;
  if (observation.lines.empty() && !observation.circle) return;
  remembered_utime_ = utime_;
  remember(observation);
  check();
}

void Localizer::remember(const FieldObservation& observation) {
  window_.push_back(observation);
  if (window_.size() > kKeep) window_.erase(window_.begin());
}

std::vector<FieldObservation> Localizer::newest(size_t count) const {
  std::vector<FieldObservation> result;
  const size_t first = window_.size() > count ? window_.size() - count : 0;
  for (size_t i = first; i < window_.size(); ++i) {
    const FieldObservation corrected = window_[i].tilted(filter_.tilt());
    result.push_back(corrected.moved_to(odometry_));
  }
  return result;
}

void Localizer::give_up() {
  is_lost_ = true;
  // Carrying the robot does not change the errors of its joints and of the torso's orientation, but
  // what was taken for lines of the wrong place spoiled the estimated tilt.
  filter_.start(filter_.pose(), parameters_.found_position, parameters_.found_heading, usual_tilt_);
  // Earlier observations belong to the robot's earlier place.
  if (window_.size() > kRecent) {
    window_.erase(window_.begin(), window_.end() - static_cast<std::ptrdiff_t>(kRecent));
  }
}

void Localizer::check() {
  const std::vector<FieldObservation> recent = newest(kRecent);
  double length = 0;
  for (const FieldObservation& observation : recent) length += observation.length();
  if (length < parameters_.least_used_length) return;
  const double score = search_.score(filter_.pose(), recent);
  if (!is_lost_) {
    num_misfits_ = score < parameters_.misfit_score ? num_misfits_ + 1 : 0;
    if (num_misfits_ >= kMostMisfits) give_up();
    if (!is_lost_ && score > parameters_.good_score) {
      ++num_fits_;
      usual_tilt_ +=
          std::max(parameters_.tilt_gain, 1.0 / num_fits_) * (filter_.tilt() - usual_tilt_);
      return;
    }
  }
  const double period = is_lost_ ? parameters_.lost_search_period : parameters_.search_period;
  if (utime_ - searched_utime_ < std::llround(1e6 * period)) return;
  searched_utime_ = utime_;
  const std::vector<FieldObservation> all = newest(kKeep);
  const auto found = search_.find(all, filter_.pose().heading);
  if (!found) return;
  if (!is_lost_ && found->score < search_.score(filter_.pose(), all) + parameters_.better) return;
  filter_.start(found->pose, parameters_.found_position, parameters_.found_heading,
                filter_.tilt() + found->tilt);
  is_lost_ = false;
  num_misfits_ = 0;
}

}  // namespace nao::vision

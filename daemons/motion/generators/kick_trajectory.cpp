#include "daemons/motion/generators/kick_trajectory.h"

#include <algorithm>
#include <cmath>

#include "common/smooth_step.h"

namespace nao::motion {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// Height of the sole, m, above which the foot moves freely. Chosen: the height of a foot that is
// lifted in a step.
constexpr double kClearance = 0.02;

KickReference interpolate(const KickReference& from, const KickReference& to, double s) {
  return {from.com + s * (to.com - from.com), from.foot + s * (to.foot - from.foot),
          from.foot_heading + s * (to.foot_heading - from.foot_heading),
          from.foot_pitch + s * (to.foot_pitch - from.foot_pitch)};
}

}  // namespace

double airborne_fraction(double height) {
  return smooth_step(height / kClearance);
}

KickReference hold_path_over_ground(const KickReference& planned, const Pose2& start_in_support) {
  const double airborne = airborne_fraction(planned.foot.z());
  const Vector2d foot = planned.foot.head<2>();
  KickReference held = planned;
  // A foot on the ground moves with the ground; a foot in the air goes along the path that was
  // planned from the start. smooth_step() joins the two over kClearance.
  held.foot.head<2>() += airborne * (start_in_support * foot - foot);
  held.foot_heading += airborne * wrapped(start_in_support.heading);
  return held;
}

KickTrajectory::KickTrajectory(const Kick& kick, bool is_left, const Vector2d& ball,
                               double strength)
    : ball_x_(std::isnan(ball.x()) ? kick.ball.x() : ball.x()), ball_contact_(kick.ball_contact) {
  // Phases are given for a left foot that kicks; the y of a right one is negated.
  const double side = is_left ? 1 : -1;
  // The foot swings in the vertical plane that the ball lies in.
  const double beside = std::isnan(ball.y()) ? 0 : side * ball.y() - kick.ball.y();
  const double sideways = std::max(kick.foot_reach[0], std::min(beside, kick.foot_reach[1]));
  for (const Kick::Phase& phase : kick.phases) {
    Segment segment{
        phase.duration, {phase.com, phase.foot, 0, phase.pitch}, phase.name == "strike"};
    if (segment.is_strike) {
      segment.duration =
          kick.strike_duration[0] + strength * (kick.strike_duration[1] - kick.strike_duration[0]);
    }
    // Only where the foot is in the air: on the ground it stays.
    if (phase.foot.z() > 0) segment.end.foot.y() += sideways;
    segment.end.com.y() *= side;
    segment.end.foot.y() *= side;
    segments_.push_back(segment);
    duration_ += segment.duration;
  }
}

// The path begins and ends in the stand that the robot is in.
void KickTrajectory::start_from(const KickReference& stand) {
  stand_ = stand;
  for (Segment& segment : segments_) {
    if (segment.end.foot.z() <= 0) segment.end.foot_heading = stand.foot_heading;
  }
  KickReference& last = segments_.back().end;
  last.com = stand.com;
  last.foot = stand.foot;
  find_impact();
}

double KickTrajectory::strike_end() const {
  double end = 0;
  for (const Segment& segment : segments_) {
    end += segment.duration;
    if (segment.is_strike) break;
  }
  return end;
}

void KickTrajectory::find_impact() {
  // x of the kicking foot in S when it meets the ball: the ball is given from the midpoint of the
  // feet, and is met ball_contact ahead of the sole's frame.
  const double foot_x = ball_x_ + 0.5 * stand_.foot.x() - ball_contact_;
  impact_ = stand_;
  for (size_t i = 1; i < segments_.size(); ++i) {
    if (!segments_[i].is_strike) continue;
    const KickReference& from = segments_[i - 1].end;
    const KickReference& to = segments_[i].end;
    // Fraction of the strike at which the foot is at this point.
    const double s = (foot_x - from.foot.x()) / (to.foot.x() - from.foot.x());
    impact_ = interpolate(from, to, std::clamp(s, 0.0, 1.0));
  }
}

KickReference KickTrajectory::at(double time) const {
  KickReference from = stand_;
  for (const Segment& segment : segments_) {
    if (time < segment.duration) {
      return interpolate(from, segment.end, smooth_step(time / segment.duration));
    }
    time -= segment.duration;
    from = segment.end;
  }
  return from;
}

}  // namespace nao::motion

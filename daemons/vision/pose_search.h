#pragma once

#include <optional>
#include <vector>

#include "daemons/vision/field_model.h"
#include "daemons/vision/field_observation.h"
#include "daemons/vision/vision_parameters.h"
#include "kinematics/pose2.h"

namespace nao::vision {

/** Finds a pose on the field without a prior position, from what several images showed.
 *
 * Hypotheses: two observed lines at a right angle are two lines of the field, or one of them and
 * the center circle. Each hypothesis is scored by all observations, the best are refined by least
 * squares together with the camera's tilt, and the best of them is the result if no other place
 * explains the observations as well.
 * The half turn under which the field looks the same is decided by the heading of the prior. */
class PoseSearch {
 public:
  struct Result {
    Pose2 pose;
    /** Errors of the camera's tilt that all observations have in common, rad. */
    Eigen::Vector2d tilt = Eigen::Vector2d::Zero();
    /** As score(). */
    double score = 0;
  };

  /** @param field  Must outlive this. */
  PoseSearch(const FieldModel& field, const VisionParameters::PoseSearch& parameters);

  /** How well a pose explains observations: the fraction of the observed lines and circles that lie
   * where the field has them, 0 to 1.
   * @param observations  All moved to the pose's time (FieldObservation::moved_to()). */
  double score(const Pose2& pose, const std::vector<FieldObservation>& observations) const;

  /** @param observations  As for score(). @param heading  rad: poses that differ from it by more
   * than 100 degrees are not considered.
   * @return Nothing if no pose explains them well, or several do. */
  std::optional<Result> find(const std::vector<FieldObservation>& observations,
                             double heading) const;

 private:
  /** A line of the field that is parallel to an observed one, at a distance. */
  struct Match {
    const FieldLine* line = nullptr;
    double distance = 0;
  };

  bool is_same_place(const Pose2& a, const Pose2& b) const;
  Match match(const FieldLine& line) const;
  double line_score(const FieldLine& line, const Eigen::Vector2d& camera) const;
  void add_hypotheses(const FieldObservation& observation, double heading,
                      std::vector<Pose2>& hypotheses) const;
  /** The result nearby that fits best. */
  Result refined(const Pose2& pose, const std::vector<FieldObservation>& observations) const;

  const FieldModel* field_;
  VisionParameters::PoseSearch parameters_;
  /** y of the lines along x, and x of the lines along y, each once, m. */
  std::vector<double> along_x_;
  std::vector<double> along_y_;
};

}  // namespace nao::vision

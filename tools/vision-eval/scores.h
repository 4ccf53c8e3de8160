#pragma once

#include <map>
#include <string>
#include <vector>

#include "daemons/vision/camera_geometry.h"
#include "daemons/vision/detection.h"
#include "tools/vision-eval/image_labels.h"

namespace nao::vision {

/** Comparison of detections with labels, by kind and distance.
 *
 * An object less visible than kLeastVisible is neither required nor an error. Lines are counted by
 * length: for a label the part near a detection (recall), for a detection the part near a label
 * (precision). A crossing whose type differs from its label's is only an error of the type. */
class Scores {
 public:
  /** Fraction of an object. Chosen: more than half of it. */
  static constexpr double kLeastVisible = 0.6;

  /** Distance of an object: to 3 m, 3 to 5 m, farther, unknown. */
  enum Range { kNear, kFar, kBeyond, kUnknownRange };

  /** Counts of objects, or of lengths of lines in pixels. */
  struct Row {
    double num_labels = 0;
    double num_found = 0;
    double num_detections = 0;
    double num_false = 0;
    /** Errors of the objects found: rad, and as a fraction of the distance. */
    std::vector<double> bearing_errors;
    std::vector<double> distance_errors;

    double recall() const { return num_labels > 0 ? num_found / num_labels : 0; }
    double precision() const {
      return num_detections > 0 ? (num_detections - num_false) / num_detections : 0;
    }
  };

  void add(const LabelledImage& image, const Detections& detections);

  const Row& row(Kind kind, Range range) { return rows_[{kind_name(kind), range}]; }
  /** One row for each kind and range of distance. */
  std::string table() const;

 private:
  void add_objects(Kind kind, const LabelledImage& image, const Detections& detections);
  void add_lines(const LabelledImage& image, const Detections& detections);

  /** By kind and range. */
  std::map<std::pair<std::string, int>, Row> rows_;
};

}  // namespace nao::vision

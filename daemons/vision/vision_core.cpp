#include "daemons/vision/vision_core.h"

#include <malloc.h>

#include <algorithm>

#include "common/data_path.h"
#include "common/error.h"
#include "daemons/vision/ball_candidates.h"
#include "daemons/vision/ball_filter.h"
#include "daemons/vision/line_continuation.h"

namespace nao::vision {
namespace {

/** Least fraction of field in an image for objects to be detected on it. */
constexpr double kLeastField = 0.03;
/** Free memory that is kept, bytes: more than an image of 1280x960 needs, about 12 MB. */
constexpr int kKeptMemory = 16 << 20;

bool is_in(const Eigen::Vector4d& box, const cv::Point2f& pixel) {
  return pixel.x > box[0] && pixel.x < box[2] && pixel.y > box[1] && pixel.y < box[3];
}

}  // namespace

const char* kind_name(Kind kind) {
  switch (kind) {
    case Kind::kBall:
      return "ball";
    case Kind::kLine:
      return "line";
    case Kind::kCrossingL:
      return "crossing-l";
    case Kind::kCrossingT:
      return "crossing-t";
    case Kind::kCrossingX:
      return "crossing-x";
    case Kind::kCenterCircle:
      return "center-circle";
    case Kind::kGoalPost:
      return "goal-post";
    case Kind::kRobot:
      return "robot";
    case Kind::kPenaltyMark:
      return "penalty-mark";
  }
  return "";
}

void configure_process() {
  cv::setNumThreads(1);
  mallopt(M_MMAP_THRESHOLD, kKeptMemory);
  mallopt(M_TRIM_THRESHOLD, kKeptMemory);
}

VisionNetworks VisionNetworks::load() {
  const std::filesystem::path folder = data_path() / "networks";
  return {std::make_shared<NeuralNetwork>(folder / "objects.onnx", ObjectDetector::shape()),
          {std::make_shared<NeuralNetwork>(folder / "ball.onnx", BallDetector::shape()),
           std::make_shared<NeuralNetwork>(folder / "colored_ball.onnx", BallDetector::shape())}};
}

VisionCore::VisionCore(const VisionNetworks& networks, const VisionParameters& parameters)
    : parameters_(parameters),
      status_(parameters.image_status),
      field_(parameters.field_detector),
      lines_(parameters.line_detector),
      crossings_(parameters.crossing_detector),
      circle_(parameters.center_circle),
      objects_(networks.objects),
      ball_(networks.ball),
      ball_filter_(parameters.ball_filter) {}

// The center circle is found first: its points then do not become lines.
void VisionCore::find_lines(const FieldView& view, const CameraGeometry& geometry,
                            const Detections& obstacles, VisionResult& result) {
  std::vector<LinePoint> points = find_line_points(view, parameters_.line_points);
  // Bars of robots' legs and the ball look like pieces of lines.
  points.erase(std::remove_if(points.begin(), points.end(),
                              [&](const LinePoint& point) {
                                return std::any_of(obstacles.begin(), obstacles.end(),
                                                   [&](const Detection& obstacle) {
                                                     return is_in(obstacle.box_px, point.pixel);
                                                   });
                              }),
               points.end());
  std::vector<cv::Point2f> pixels;
  for (const LinePoint& point : points) pixels.push_back(point.pixel);
  std::vector<cv::Point2f> ideal = geometry.undistorted(pixels);
  finish_stage("line points");
  const auto circle = circle_.detect(points, ideal, geometry);
  if (circle) result.detections.push_back(*circle);
  finish_stage("center circle");
  const std::vector<LineSegment> segments = lines_.detect(points, ideal, geometry);
  for (const LineSegment& segment : segments) {
    result.detections.push_back(line_detection(segment, geometry));
  }
  // They are not used for crossings: the pieces of a bend would cross one another.
  for (const LineSegment& segment : continue_segments(segments, points, ideal)) {
    result.detections.push_back(line_detection(segment, geometry));
  }
  for (const Detection& crossing : crossings_.detect(segments, view, geometry)) {
    result.detections.push_back(crossing);
  }
  finish_stage("lines");
}

void VisionCore::localize(const VisionInput& input, VisionResult& result) {
  if (!localizer_ || !input.heading_in_odometry || !input.pose_camera_in_heading) return;
  const CameraPlace place{input.pose_camera_in_heading->translation(), 1 / input.calibration.fx};
  localizer_->observe(observe_field(result.detections, place, *input.heading_in_odometry,
                                    parameters_.field_observation));
  result.field_pose = localizer_->estimate();
  // The lines show how the camera is tilted, and so how far the ball is.
  correct_by_tilt(place, localizer_->tilt(), result.detections);
  finish_stage("localisation");
}

VisionResult VisionCore::process(const VisionInput& input) {
  if (input.bgr.type() != CV_8UC3 || input.bgr.cols < 64 || input.bgr.rows < 48) {
    throw MessageError("the image has " + std::to_string(input.bgr.cols) + "x" +
                       std::to_string(input.bgr.rows) + " pixels in OpenCV's format " +
                       std::to_string(input.bgr.type()) + "; 64x48 pixels of 3 bytes are needed");
  }
  VisionResult result;
  const CameraGeometry geometry(input.calibration, input.pose_camera_in_heading);
  const PatchSampler sampler(input.bgr);
  result.image_status =
      status_.check(sampler, input.camera, input.utime, input.pose_camera_in_heading,
                    geometry.horizon_row(0.5 * input.bgr.cols));
  finish_stage("image status");
  // The filter predicts in every image, so that the ball's estimate ages even while it is not seen.
  ball_filter_.predict(input.utime);
  result.ball = ball_filter_.estimate();
  if (localizer_ && input.heading_in_odometry) {
    localizer_->predict(input.utime, *input.heading_in_odometry, input.is_upright);
    result.field_pose = localizer_->estimate();
  }
  if (result.image_status != ImageStatus::kOk) return result;

  const FieldView view = field_.detect(input.bgr, geometry);
  finish_stage("field");
  // The robot looks up or over the border, so that apparent objects there are false.
  if (view.fraction < kLeastField) return result;
  FoundObjects objects = objects_.detect(sampler.half(), input.bgr.cols, input.bgr.rows, geometry);
  finish_stage("objects");
  std::vector<Circle>& places = objects.balls;
  for (const Circle& hint : find_ball_hints(view, geometry, kBallRadius)) {
    const bool is_new = std::none_of(places.begin(), places.end(),
                                     [&](const Circle& place) { return is_same(place, hint); });
    if (is_new) places.push_back(hint);
  }
  finish_stage("ball places");
  const auto ball = ball_.detect(sampler, geometry, places);
  if (ball) result.detections.push_back(*ball);
  finish_stage("ball");
  Detections obstacles = objects.robots;
  if (ball) obstacles.push_back(*ball);
  find_lines(view, geometry, obstacles, result);
  for (const Detections* found : {&objects.posts, &objects.robots}) {
    result.detections.insert(result.detections.end(), found->begin(), found->end());
  }
  localize(input, result);

  const auto seen =
      std::find_if(result.detections.begin(), result.detections.end(),
                   [](const Detection& detection) { return detection.kind == Kind::kBall; });
  if (seen != result.detections.end() && seen->has_position() && input.heading_in_odometry) {
    const Pose2& pose = *input.heading_in_odometry;
    // From the heading frame to odometry: position as a point, covariance rotated.
    const Eigen::Matrix2d R = Eigen::Rotation2Dd(pose.heading).toRotationMatrix();
    ball_filter_.update(pose * seen->position, R * seen->covariance * R.transpose());
    result.ball = ball_filter_.estimate();
  }
  return result;
}

}  // namespace nao::vision

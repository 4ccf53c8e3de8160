#include "daemons/vision/drawing.h"

#include <fmt/core.h>

#include <opencv2/imgproc.hpp>

namespace nao::vision {
namespace {

/** Blue, green, red. */
cv::Scalar color_of(Kind kind) {
  switch (kind) {
    case Kind::kBall:
      return {0, 128, 255};
    case Kind::kLine:
      return {255, 0, 0};
    case Kind::kGoalPost:
      return {255, 0, 255};
    case Kind::kRobot:
      return {255, 255, 0};
    default:
      return {0, 0, 255};
  }
}

}  // namespace

void draw_result(const VisionResult& result, cv::Mat& bgr) {
  for (const Detection& d : result.detections) {
    const cv::Scalar color = color_of(d.kind);
    if (d.kind == Kind::kLine) {
      cv::line(bgr, cv::Point2d(d.line_px[0], d.line_px[1]),
               cv::Point2d(d.line_px[2], d.line_px[3]), color, 2, cv::LINE_AA);
      continue;
    }
    cv::rectangle(bgr, cv::Point2d(d.box_px[0], d.box_px[1]), cv::Point2d(d.box_px[2], d.box_px[3]),
                  color, 1, cv::LINE_AA);
    std::string text = fmt::format("{} {:.2f}", kind_name(d.kind), d.confidence);
    if (d.has_position()) text += fmt::format(" {:.2f} m", d.position.norm());
    cv::putText(bgr, text, cv::Point2d(d.box_px[0], std::max(10.0, d.box_px[1] - 3)),
                cv::FONT_HERSHEY_SIMPLEX, 0.4, color, 1, cv::LINE_AA);
  }
  if (result.image_status != ImageStatus::kOk) {
    cv::putText(bgr, image_status_name(result.image_status), {8, 24}, cv::FONT_HERSHEY_SIMPLEX, 0.8,
                {0, 0, 255}, 2, cv::LINE_AA);
  }
}

}  // namespace nao::vision

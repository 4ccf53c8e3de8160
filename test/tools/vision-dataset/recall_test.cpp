// Perception must not become worse unnoticed: it is run on a few rendered images, of places and
// seeds that are neither trained nor tuned on. docs/vision.md has the figures of many images; the
// limits here are lower by the scatter of so few images.

#include <gmock/gmock.h>

#include "common/data_path.h"
#include "daemons/vision/ball_candidates.h"
#include "daemons/vision/object_detector.h"
#include "daemons/vision/vision_core.h"
#include "tools/vision-dataset/dataset_renderer.h"
#include "tools/vision-eval/scores.h"

namespace nao::vision {
namespace {

constexpr uint64_t kFirstPlace = 5000;
constexpr int kNumPlaces = 40;

class VisionRecall : public testing::Test {
 protected:
  /** Calls `use` with each of some images. */
  template <typename Use>
  void render(int num_images, const SceneOptions& options, const Use& use) {
    for (int i = 0; i < num_images; ++i) {
      const uint64_t place = kFirstPlace + static_cast<uint64_t>(i % kNumPlaces);
      const RandomScene scene =
          make_scene(model_, field_, options, place, 900000000 + static_cast<uint64_t>(i));
      LabelledImage image;
      use(renderer_.render(scene, image), image);
    }
  }

  static VisionInput input_of(const cv::Mat& bgr, const LabelledImage& image) {
    VisionInput input;
    input.bgr = bgr;
    input.calibration = *image.calibration;
    input.pose_camera_in_heading = image.pose_camera_in_heading;
    return input;
  }

  Detections balls(const VisionInput& input) const {
    Detections found = VisionCore(networks_).process(input).detections;
    found.erase(std::remove_if(found.begin(), found.end(),
                               [](const Detection& d) { return d.kind != Kind::kBall; }),
                found.end());
    return found;
  }

  /** Fraction of the balls of hard scenes that are found, those visible at least to this fraction
   * and nearer than a distance, m. */
  double recall(const std::vector<SceneKind>& kinds, double least_visible,
                double most_distance = 10) {
    int num_balls = 0;
    int num_found = 0;
    for (const SceneKind kind : kinds) {
      SceneOptions options;
      options.kind = kind;
      render(kNumPlaces, options, [&](const cv::Mat& bgr, const LabelledImage& image) {
        const auto label =
            std::find_if(image.labels->begin(), image.labels->end(), [&](const Label& l) {
              return l.object.kind == Kind::kBall && l.visible >= least_visible &&
                     l.object.position.norm() < most_distance;
            });
        if (label == image.labels->end()) return;
        const Eigen::Vector4d& box = label->object.box_px;
        ++num_balls;
        for (const Detection& ball : balls(input_of(bgr, image))) {
          const double offset =
              (ball.box_px.head<2>() + ball.box_px.tail<2>() - box.head<2>() - box.tail<2>())
                  .norm() /
              2;
          num_found += offset < 0.4 * (box[2] - box[0]);
        }
      });
    }
    EXPECT_GT(num_balls, 20);
    return static_cast<double>(num_found) / num_balls;
  }

  /** Number of balls that are seen in scenes of a kind that has none.
   * @param has_pose  Whether the camera's pose, and so the size of a ball, is known. */
  int num_false(SceneKind kind, int num_images, bool has_pose) {
    SceneOptions options;
    options.kind = kind;
    int number = 0;
    render(num_images, options, [&](const cv::Mat& bgr, const LabelledImage& image) {
      VisionInput input = input_of(bgr, image);
      if (!has_pose) input.pose_camera_in_heading.reset();
      number += static_cast<int>(balls(input).size());
    });
    return number;
  }

  RobotModel model_ = RobotModel::load(data_path() / "robots" / "nao");
  SceneFile field_ = SceneFile::find("soccer");
  DatasetRenderer renderer_{model_, field_};
  VisionNetworks networks_ = VisionNetworks::load();
};

TEST_F(VisionRecall, FindsBallsRobotsAndPosts) {
  Scores scores;
  render(100, {}, [&](const cv::Mat& bgr, const LabelledImage& image) {
    scores.add(image, VisionCore(networks_).process(input_of(bgr, image)).detections);
  });
  EXPECT_GT(scores.row(Kind::kBall, Scores::kNear).num_labels, 30);
  EXPECT_GE(scores.row(Kind::kBall, Scores::kNear).recall(), 0.93);
  EXPECT_GE(scores.row(Kind::kBall, Scores::kNear).precision(), 0.97);
  EXPECT_GE(scores.row(Kind::kRobot, Scores::kNear).recall(), 0.80);
  EXPECT_GE(scores.row(Kind::kRobot, Scores::kNear).precision(), 0.80);
  EXPECT_GE(scores.row(Kind::kGoalPost, Scores::kNear).recall(), 0.7);
  EXPECT_GE(scores.row(Kind::kLine, Scores::kNear).recall(), 0.75);
  EXPECT_GE(scores.row(Kind::kLine, Scores::kNear).precision(), 0.80);
}

TEST_F(VisionRecall, FindsNoBallWhereNoneIs) {
  SceneOptions options;
  options.ball_fraction = 0;
  int num_false = 0;
  render(100, options, [&](const cv::Mat& bgr, const LabelledImage& image) {
    num_false += static_cast<int>(balls(input_of(bgr, image)).size());
  });
  EXPECT_LE(num_false, 1);
}

TEST_F(VisionRecall, FindsBallsOnLinesAndBeforeShoesAndRobots) {
  EXPECT_GE(recall({SceneKind::kBallOnLine, SceneKind::kBallAtShoe, SceneKind::kBallAtRobot}, 0.6),
            0.85);
}

TEST_F(VisionRecall, FindsBallsThatTheBorderCuts) {
  EXPECT_GE(recall({SceneKind::kBallAtBorder}, 0.3), 0.85);
}

TEST_F(VisionRecall, FindsOrangeBallsNearThingsOfTheirColors) {
  EXPECT_GE(recall({SceneKind::kBallOrange}, 0.6, 3), 0.7);
}

TEST_F(VisionRecall, TakesNoCheckerboardForABall) {
  EXPECT_LE(num_false(SceneKind::kCheckerboard, 60, false), 2);
  EXPECT_LE(num_false(SceneKind::kBoardUpright, 60, false), 3);
}

TEST_F(VisionRecall, TakesNoOrangeThingForABall) {
  EXPECT_LE(num_false(SceneKind::kOrangeThings, 60, true), 1);
}

TEST_F(VisionRecall, JudgesThePlacesOfAlmostAllBalls) {
  const ObjectDetector detector(networks_.objects);
  int num_balls = 0;
  int num_found = 0;
  render(80, {1, 3}, [&](const cv::Mat& bgr, const LabelledImage& image) {
    const PatchSampler sampler(bgr);
    const CameraGeometry geometry(*image.calibration, image.pose_camera_in_heading);
    std::vector<Circle> places =
        detector.detect(sampler.half(), bgr.cols, bgr.rows, geometry).balls;
    const std::vector<Circle> more =
        find_ball_hints(FieldDetector().detect(bgr, geometry), geometry, 0.05);
    places.insert(places.end(), more.begin(), more.end());
    for (const Label& label : *image.labels) {
      if (label.object.kind != Kind::kBall || label.visible < 0.6) continue;
      const Eigen::Vector4f box = label.object.box_px.cast<float>();
      const cv::Point2f center(0.5f * (box[0] + box[2]), 0.5f * (box[1] + box[3]));
      const float radius = 0.5f * (box[2] - box[0]);
      ++num_balls;
      num_found += std::any_of(places.begin(), places.end(), [&](const Circle& place) {
        return cv::norm(place.center - center) < 0.8f * radius &&
               std::abs(std::log(place.radius / radius)) < 0.5f;
      });
    }
  });
  EXPECT_GT(num_balls, 40);
  EXPECT_GE(num_found, 0.95 * num_balls);
}

}  // namespace
}  // namespace nao::vision

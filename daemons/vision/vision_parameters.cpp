#include "daemons/vision/vision_parameters.h"

#include "common/data_path.h"
#include "common/parameter_table.h"

namespace nao::vision {
namespace {

NAO_PARAMETER_TABLE(VisionParameters, field_detector, line_points, line_detector, crossing_detector,
                    center_circle, field_observation, image_status, ball_filter, pose_filter,
                    pose_search, localizer)

}  // namespace

VisionParameters VisionParameters::load(const std::filesystem::path& robot_file) {
  return load_parameters(data_path() / "vision" / "parameters.yaml", robot_file, all_parameters());
}

}  // namespace nao::vision

#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "rendering/mesh.h"
#include "tools/vision-dataset/random_scene.h"
#include "tools/vision-eval/image_labels.h"

namespace nao::vision {

/** Colors by which the objects are recognized in a second image of the scene: robots red, green,
 * blue, the ball magenta, lines and goals white, all else black. */
Color robot_name_color(size_t robot);
Color ball_name_color();
/** A black carpet with white lines, evenly lit. */
SceneAppearance named_appearance();

/** Labels of a scene's objects. Boxes hold the visible part; visible fractions come from `named`.
 * @param image  With calibration and pose. @param named  The image with those colors. */
std::vector<Label> make_labels(const RandomScene& scene, const SceneFile& field,
                               const LabelledImage& image, const cv::Mat& named);

}  // namespace nao::vision

#pragma once

#include <vector>

#include "daemons/vision/camera_geometry.h"
#include "daemons/vision/field_detector.h"
#include "daemons/vision/patch_sampler.h"

namespace nao::vision {

/** Searches FieldView::other_or_yellow for disks that are surrounded by field, by an integral
 * image.
 * @param ball_radius  m. @return The best ones, not overlapping. */
std::vector<Circle> find_ball_hints(const FieldView& view, const CameraGeometry& geometry,
                                    double ball_radius);

}  // namespace nao::vision

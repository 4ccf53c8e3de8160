#pragma once

#include <naolcm/image_t.hpp>
#include <naolcm/robot_state_t.hpp>
#include <naolcm/vision_state_t.hpp>
#include <string>

#include "daemons/vision/pose_history.h"
#include "daemons/vision/vision_core.h"

namespace nao::vision {

/** @throws MessageError  for an unknown or missing joint, or a number that is not finite. */
RobotPosture decode_posture(const RobotModel& model, const naolcm::robot_state_t& state);

/** Intrinsics of an image. @throws MessageError  if they are not usable. */
CameraCalibration decode_calibration(const naolcm::image_t& image);

/** The message of a result. The field pose is unknown: localisation is not part of this. */
naolcm::vision_state_t encode_result(const VisionResult& result, int64_t utime,
                                     const std::string& camera);

}  // namespace nao::vision

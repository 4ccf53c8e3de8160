#pragma once

#include <string>

namespace nao {

/** Names of the schemas of Foxglove that messages are converted to. Its panels recognize them by
 * these names. Source: https://docs.foxglove.dev/docs/sdk/schemas, version 2.1.0. */
inline constexpr const char* kCameraCalibrationSchema = "foxglove.CameraCalibration";
inline constexpr const char* kCompressedImageSchema = "foxglove.CompressedImage";
inline constexpr const char* kFrameTransformsSchema = "foxglove.FrameTransforms";
inline constexpr const char* kJointStatesSchema = "foxglove.JointStates";
inline constexpr const char* kOdometrySchema = "foxglove.Odometry";
inline constexpr const char* kSceneUpdateSchema = "foxglove.SceneUpdate";

/** JSON Schema of one of these, with the fields that this project writes. */
std::string foxglove_schema(const std::string& name);

}  // namespace nao

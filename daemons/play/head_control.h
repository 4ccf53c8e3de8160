#pragma once

#include <string>

#include "daemons/play/situation.h"

namespace nao::play {

/** Limits of the joints that turn the cameras, rad. */
struct HeadLimits {
  double least_yaw = 0;
  double greatest_yaw = 0;
  double least_pitch = 0;
  double greatest_pitch = 0;
};

/** Angles of the joints that turn the cameras, rad, and the camera to use. */
struct HeadTarget {
  double yaw = 0;
  double pitch = 0;
  std::string camera;
};

/** Chooses camera and angles for a gaze: the camera that comes nearest to it, with hysteresis. The
 * joints turn about z and y (pitch positive downwards), as in every robot here. */
class HeadControl {
 public:
  HeadControl(const HeadLimits& limits, const PlayParameters::HeadControl& parameters)
      : limits_(limits), parameters_(parameters) {}

  /** @return Nothing if the robot has no camera. */
  std::optional<HeadTarget> look(const Gaze& gaze, const RobotView& robot);

 private:
  HeadTarget turn_to(double bearing, double depression, const CameraView& camera,
                     const RobotView& robot) const;

  HeadLimits limits_;
  PlayParameters::HeadControl parameters_;
  size_t camera_ = 0;
};

}  // namespace nao::play

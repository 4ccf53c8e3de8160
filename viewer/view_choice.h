#pragma once

namespace nao::viewer {

/** Contents of the 3D view. */
struct ViewChoice {
  bool estimated_robot = true;
  bool true_robot = true;
  bool contact_forces = true;
  bool com = true;
  bool center_of_pressure = true;
  bool support_polygon = true;
  bool footsteps = true;
  /** Draws the estimated robot translucent, so that markings inside of it are visible. */
  bool translucent = false;

  /** Draws only the estimated robot. */
  static ViewChoice without_markings() {
    return {true, false, false, false, false, false, false, false};
  }
};

}  // namespace nao::viewer

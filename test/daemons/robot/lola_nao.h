#pragma once

#include "common/data_path.h"
#include "lola/lola_map.h"
#include "robot_model/robot_model.h"

namespace nao::robot {

/** The NAO and its LoLA names, loaded once for all tests of a program. */
inline const RobotModel& nao_model() {
  static const RobotModel model = RobotModel::load(data_path() / "robots/nao");
  return model;
}
inline const LolaMap& nao_map() {
  static const LolaMap map = LolaMap::load(nao_model());
  return map;
}

/** A frame of a robot that stands still in a posture, upright, with charged battery. */
inline LolaState frame_of(const std::string& posture, float stiffness) {
  LolaState state;
  state.position = nao_map().to_lola(nao_model().find_posture(posture)->position, true);
  state.stiffness.fill(stiffness);
  state.temperature.fill(38);
  state.current.fill(0.1f);
  state.battery = {0.9f, 0, -1, 30};
  state.accelerometer = {0, 0, -9.81f};
  return state;
}

}  // namespace nao::robot

#pragma once

#include <functional>
#include <string>

#include "common/bus.h"
#include "common/wall_clock.h"

namespace nao {

/** Hears by DAEMON_STATUS of a second process of a program of which a bus has one, such as that of
 * another system in the same network: both would be obeyed in turns. */
class SecondProcess {
 public:
  /** @param bus  Must outlive this. @param robot  That the program serves; empty: all, as in
   * daemon_status_t. @param clock  s, monotonic. */
  SecondProcess(Bus& bus, const std::string& program, const std::string& robot = "",
                std::function<double()> clock = monotonic_seconds);

  /** "a second nao-sim is on this bus: host pc, process 12"; empty if there is none. */
  std::string describe() const;

  /** Whether the other one ran already when this one began, so that this one should end. Not if
   * both began long ago and two networks were joined: then each keeps to its own robot. */
  bool was_first() const { return was_first_; }

 private:
  std::function<double()> clock_;
  double start_;
  std::string text_;
  double last_heard_ = -1e9;
  bool was_first_ = false;
};

}  // namespace nao

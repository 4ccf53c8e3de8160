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
  /** @param bus  Must outlive this. @param clock  s, monotonic. */
  SecondProcess(Bus& bus, const std::string& program,
                std::function<double()> clock = monotonic_seconds);

  /** "a second nao-sim is on this bus: host pc, process 12"; empty if there is none. */
  std::string describe() const;

 private:
  std::function<double()> clock_;
  std::string text_;
  double last_heard_ = -1e9;
};

}  // namespace nao

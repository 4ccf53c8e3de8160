#pragma once

#include <optional>

#include "closed_loop/closed_loop.h"

namespace nao::trial {

/** Measures how long before the impact of a fall the motion core tells it. */
class FallWarning {
 public:
  /** Looks at a tick. */
  void look(ClosedLoop& trial);

  /** Whether anything but a foot has touched the floor. */
  bool has_touched() const { return touched_.has_value(); }
  /** s from the core's first sign of a fall to the first touch; nothing without a touch, -1 if the
   * core had told nothing by then. */
  std::optional<double> warning() const;

 private:
  std::optional<double> told_;
  std::optional<double> touched_;
};

}  // namespace nao::trial

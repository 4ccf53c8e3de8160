#pragma once

#include <optional>

#include "sim/closed_loop/closed_loop.h"

namespace nao::trial {

/** Measures the time between the motion core's fall prediction and the impact. */
class FallWarning {
 public:
  /** Evaluates one tick. */
  void look(ClosedLoop& trial);

  /** True once a link other than a foot has touched the floor. */
  bool has_touched() const { return touched_.has_value(); }
  /** Time from the core's fall prediction to the first contact, s; nullopt without a contact, -1 if
   * the core had predicted no fall by then. */
  std::optional<double> warning() const;

 private:
  std::optional<double> told_;
  std::optional<double> touched_;
};

}  // namespace nao::trial

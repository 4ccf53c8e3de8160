#pragma once

#include <string>

namespace nao::gateway {

/** One metric of the gateway. */
struct Metric {
  /** Snake case, with its unit; a counter ends in _total. */
  std::string name;
  double value = 0;
  /** What it counts or measures, in words. */
  std::string help;
};

}  // namespace nao::gateway

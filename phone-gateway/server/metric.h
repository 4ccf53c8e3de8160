#pragma once

#include <string>

namespace nao {

/** One of the gateway's own figures. */
struct Metric {
  /** Snake case, with its unit; one that only grows ends in _total. */
  std::string name;
  double value = 0;
  /** What it counts, for a person. */
  std::string help;
};

}  // namespace nao

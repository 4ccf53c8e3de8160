#pragma once

#include <cmath>
#include <cstdint>

namespace nao {

/** Pseudo-random numbers that depend on the seed only, not on the machine or the C++ library.
 *
 * Sources: SplitMix64 (Steele, Lea, Flood, Fast Splittable Pseudorandom Number Generators, OOPSLA
 * 2014); normal deviates by the polar method (Marsaglia and Bray, SIAM Review 6, 1964). */
class Random {
 public:
  explicit Random(uint64_t seed) : state_(seed) {}

  /** The next 64 random bits. */
  uint64_t next() {
    state_ += 0x9e3779b97f4a7c15u;
    uint64_t z = state_;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
  }

  /** Uniform in [0, 1). */
  double uniform() { return static_cast<double>(next() >> 11) * 0x1p-53; }
  /** Uniform in [lower, upper). */
  double uniform(double lower, double upper) { return lower + (upper - lower) * uniform(); }

  /** Mean 0, standard deviation 1. */
  double normal() {
    if (has_spare_) {
      has_spare_ = false;
      return spare_;
    }
    double x, y, square;
    do {
      x = uniform(-1, 1);
      y = uniform(-1, 1);
      square = x * x + y * y;
    } while (square >= 1 || square == 0);
    const double scale = std::sqrt(-2 * std::log(square) / square);
    spare_ = y * scale;
    has_spare_ = true;
    return x * scale;
  }

 private:
  uint64_t state_;
  double spare_ = 0;
  bool has_spare_ = false;
};

}  // namespace nao

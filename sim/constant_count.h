#pragma once

#include <type_traits>

namespace nao::sim {

/** Calls work(count) with a number that the compiler knows where it is kLeast to kMost, the numbers
 * of most robots: loops are then unrolled, and what they work on stays in registers. */
template <int kLeast, int kMost, class Work>
[[gnu::always_inline]] inline auto with_constant(int count, Work work) {
  if (count == kLeast) return work(std::integral_constant<int, kLeast>());
  if constexpr (kLeast < kMost) {
    return with_constant<kLeast + 1, kMost>(count, work);
  } else {
    return work(count);
  }
}

}  // namespace nao::sim

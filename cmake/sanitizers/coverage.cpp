// Which code an input reaches, for libFuzzer: GCC calls these functions in every basic block and
// before every comparison
// (-fsanitize-coverage), and libFuzzer reads the counters, a section of this name, after every
// input.
#include <cstdint>

namespace {

constexpr int kNumCounterBits = 16;

// A power of two, so that hashing is cheap; the fuzzers reach a few thousand blocks.
[[gnu::section("__libfuzzer_extra_counters")]] uint8_t counters[1 << kNumCounterBits];

}  // namespace

// From the linker: where the program was loaded, which differs from run to run.
extern "C" const char __executable_start;

/** Counts one more pass through the block that called; blocks share a counter where their hashes
 * agree. */
extern "C" void __sanitizer_cov_trace_pc() {
  const auto offset = static_cast<uint64_t>(static_cast<const char*>(__builtin_return_address(0)) -
                                            &__executable_start);
  // Multiplicative hashing by 2^64 / golden ratio (Knuth, The Art of Computer Programming, volume
  // 3, 6.4).
  ++counters[(offset * 0x9E3779B97F4A7C15u) >> (64 - kNumCounterBits)];
}

// Comparisons of numbers with a fraction, of which libFuzzer makes no use; it reads those of
// integers itself.
extern "C" void __sanitizer_cov_trace_cmpf(float, float) {}
extern "C" void __sanitizer_cov_trace_cmpd(double, double) {}

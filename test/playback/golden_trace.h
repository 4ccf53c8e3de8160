#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace nao::playback {

/** Output of a program for a golden session, as hashes, tick by tick. */
struct GoldenTrace {
  /** Name of the hashed stream, such as "joint_command". */
  std::vector<std::string> streams;
  /** One hash for each stream, by control tick. */
  std::map<int64_t, std::vector<uint64_t>> hashes;
  /** Results of the commands, in order: "TICK SOURCE COMMAND_ID COMMAND STATUS". */
  std::vector<std::string> results;
};

/** Hash over results of the mathematical functions of the C library. The library picks its
 * implementation by processor, and their last bits may differ: golden hashes hold only where this
 * is the same. */
uint64_t hash_of_math_functions();

/** Writes a trace and hash_of_math_functions() as text. @throws Error */
void write_golden_trace(const std::filesystem::path& file, const GoldenTrace& trace);

/** A trace that was written, and the machines for which it holds. */
struct GoldenExpectation {
  uint64_t math_functions = 0;
  GoldenTrace trace;
};

/** @throws Error  if the file is missing or is not a golden trace. */
GoldenExpectation read_golden_trace(const std::filesystem::path& file);

/** Where a trace differs from the expected one: for each stream the number of ticks that differ and
 * the first of them, and the first result that differs. @return A sentence each; empty if equal. */
std::vector<std::string> find_differences(const GoldenTrace& expected, const GoldenTrace& trace);

}  // namespace nao::playback

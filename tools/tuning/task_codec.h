#pragma once

#include <cstdint>
#include <vector>

#include "tools/tuning/task.h"

namespace nao {

/** Messages between the processes of a search are lists of 64-bit words; a floating-point number is
 * sent as its bits, so that it arrives unchanged. */
using Words = std::vector<uint64_t>;

/** A task and its index in the batch. */
struct IndexedTask {
  size_t index = 0;
  Task task;

  bool operator==(const IndexedTask&) const = default;
};

Words encode_task(const IndexedTask& task);
/** @throws Error  if the words are not a task. */
IndexedTask decode_task(const Words& words);

Words encode_outcome(const Outcome& outcome);
/** @throws Error  if the words are not an outcome. */
Outcome decode_outcome(const Words& words);

}  // namespace nao

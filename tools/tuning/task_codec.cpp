#include "tools/tuning/task_codec.h"

#include <fmt/core.h>

#include <bit>
#include <limits>

#include "common/error.h"

namespace nao {
namespace {

// A task: index, seed, trial, then the point's coordinates. An outcome: index, duration, number of
// figures, the figures, then the error text, one byte a word.
constexpr size_t kTaskHeader = 3;
constexpr size_t kOutcomeHeader = 3;

}  // namespace

Words encode_task(const IndexedTask& task) {
  Words words = {task.index, task.task.seed, static_cast<uint64_t>(task.task.trial)};
  for (double value : task.task.point) words.push_back(std::bit_cast<uint64_t>(value));
  return words;
}

IndexedTask decode_task(const Words& words) {
  if (words.size() < kTaskHeader ||
      words[2] > static_cast<uint64_t>(std::numeric_limits<int>::max())) {
    throw Error(fmt::format("a message of {} words is not a task", words.size()));
  }
  IndexedTask task;
  task.index = words[0];
  task.task.seed = words[1];
  task.task.trial = static_cast<int>(words[2]);
  for (size_t i = kTaskHeader; i < words.size(); ++i) {
    task.task.point.push_back(std::bit_cast<double>(words[i]));
  }
  return task;
}

Words encode_outcome(const Outcome& outcome) {
  Words words = {outcome.index, std::bit_cast<uint64_t>(outcome.duration), outcome.figures.size()};
  for (double value : outcome.figures) words.push_back(std::bit_cast<uint64_t>(value));
  for (char byte : outcome.error) words.push_back(static_cast<unsigned char>(byte));
  return words;
}

Outcome decode_outcome(const Words& words) {
  if (words.size() < kOutcomeHeader || words[2] > words.size() - kOutcomeHeader) {
    throw Error(fmt::format("a message of {} words is not an outcome of a task", words.size()));
  }
  Outcome outcome;
  outcome.index = words[0];
  outcome.duration = std::bit_cast<double>(words[1]);
  const size_t figures_end = kOutcomeHeader + words[2];
  for (size_t i = kOutcomeHeader; i < figures_end; ++i) {
    outcome.figures.push_back(std::bit_cast<double>(words[i]));
  }
  for (size_t i = figures_end; i < words.size(); ++i) {
    outcome.error += static_cast<char>(static_cast<unsigned char>(words[i]));
  }
  return outcome;
}

}  // namespace nao

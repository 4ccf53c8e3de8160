#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <string>
#include <utility>

#include "messages/command.h"

namespace nao::motion {

/** Remembers what became of commands, so that a repeated one is answered again and acted on once.
 *
 * Its memory is bounded: of more than `capacity` commands it forgets the oldest that have ended. */
class CommandLedger {
 public:
  explicit CommandLedger(size_t capacity = 4096) : capacity_(capacity) {}

  /** @return The latest result of this command; nullptr if it is new. */
  const CommandResult* find(const std::string& source, int64_t id) const;

  /** Notes a result; it replaces the command's earlier one. */
  void note(const CommandResult& result);

  size_t size() const { return results_.size(); }

 private:
  using Key = std::pair<std::string, int64_t>;

  void forget_oldest();

  size_t capacity_;
  std::map<Key, CommandResult> results_;
  std::deque<Key> order_;
};

}  // namespace nao::motion

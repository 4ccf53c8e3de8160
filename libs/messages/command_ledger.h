#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <string>
#include <utility>

#include "messages/command.h"

namespace nao {

/** Latest result of each command, so that a repeated command is answered again and executed once.
 *
 * Bounded: of more than `capacity` commands the oldest that has ended is dropped. */
class CommandLedger {
 public:
  /** @param capacity  Chosen: an hour of one command a second. */
  explicit CommandLedger(size_t capacity = 4096) : capacity_(capacity) {}

  /** @return The latest result of a command; nullptr if it is new. */
  const CommandResult* find(const std::string& source, int64_t id) const;

  /** Adds a result; it replaces the command's earlier one. */
  void note(const CommandResult& result);

  size_t size() const { return results_.size(); }

 private:
  using Key = std::pair<std::string, int64_t>;

  void drop_oldest();

  size_t capacity_;
  std::map<Key, CommandResult> results_;
  /** Oldest first. */
  std::deque<Key> order_;
};

}  // namespace nao

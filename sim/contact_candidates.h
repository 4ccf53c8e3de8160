#pragma once

#include <cstdint>
#include <vector>

#include "sim/contact.h"

namespace nao::sim {

/** The contact candidates of a step, in memory that is allocated once; further ones are left out
 * and counted. */
class ContactCandidates {
 public:
  void reserve(int max_candidates) { list_.reserve(max_candidates); }
  /** Removes the candidates, and continues to count. @param step_number  Of the step whose
   * candidates follow, rising by 1 from step to step. */
  void begin_step(int64_t step_number) {
    list_.clear();
    step_number_ = step_number;
  }
  int64_t step_number() const { return step_number_; }
  void reset_count() { num_dropped_ = 0; }

  /** Adds a candidate to be filled in. @return null if there was no room. */
  ContactCandidate* add() {
    if (list_.size() == list_.capacity()) {
      ++num_dropped_;
      return nullptr;
    }
    return &list_.emplace_back();
  }

  /** In the order in which they were added. They stay where they are until begin_step(). */
  const std::vector<ContactCandidate>& list() const { return list_; }
  /** Left out since reset_count(). */
  int64_t num_dropped() const { return num_dropped_; }

 private:
  std::vector<ContactCandidate> list_;
  int64_t step_number_ = 0;
  int64_t num_dropped_ = 0;
};

}  // namespace nao::sim

#include "tools/nao/hang_detector.h"

#include <algorithm>

namespace nao {

void HangDetector::handle_process(int process_id, const std::string& program) {
  programs_.try_emplace(process_id, Program{program, 0, false});
}

void HangDetector::handle_status(int process_id, const std::string& program) {
  programs_[process_id] = {program, 0, true};
}

int HangDetector::num_published() const {
  return static_cast<int>(std::count_if(programs_.begin(), programs_.end(), [](const auto& entry) {
    return entry.second.has_published;
  }));
}

std::vector<int> HangDetector::process_ids() const {
  std::vector<int> result;
  for (const auto& [process_id, program] : programs_) result.push_back(process_id);
  return result;
}

std::vector<HangDetector::Hung> HangDetector::step(double now) {
  const double period = last_step_ < 0 ? 0 : now - last_step_;
  last_step_ = now;
  std::vector<Hung> result;
  if (period > limits_.max_step_period || now - last_own_heartbeat_ > limits_.max_own_silence)
    return result;
  for (auto entry = programs_.begin(); entry != programs_.end();) {
    Program& program = entry->second;
    program.silence += period;
    if (program.silence > (program.has_published ? limits_.silence : limits_.first_silence)) {
      result.push_back({entry->first, program.name, program.silence});
      entry = programs_.erase(entry);
    } else {
      ++entry;
    }
  }
  return result;
}

}  // namespace nao

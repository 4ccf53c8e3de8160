#include "daemons/motion-files/motion_file_core.h"

#include <algorithm>

#include "daemons/motion-files/motion_text.h"
#include "messages/command.h"

namespace nao::motion_files {
namespace {

using motion::ActionScript;
using motion::MotionFault;

// Results that are remembered for repeated commands, and motions that wait to be checked. Chosen:
// more than all clients of the gateway have under way.
constexpr size_t kNumRemembered = 64;
constexpr size_t kMaxJobs = 32;
// Name of a motion that is checked without one.
constexpr const char* kUnnamed = "_unnamed";

template <class Message>
bool has_same_sender(const Message& message, const MotionFileCommand& command) {
  return message.source == command.source && message.id == command.id;
}

}  // namespace

void MotionFileCore::receive(const MotionFileCommand& command) {
  if (command.source.empty() || command.id == 0) return;
  if (repeat_result(command) || is_waiting(command)) return;
  switch (command.operation) {
    case MotionFileOperation::kList:
      answer(command, std::nullopt);
      return;
    case MotionFileOperation::kGet:
      get(command);
      return;
    case MotionFileOperation::kDelete:
      erase(command);
      return;
    case MotionFileOperation::kCheck:
    case MotionFileOperation::kSave:
      take_motion(command);
      return;
  }
}

bool MotionFileCore::repeat_result(const MotionFileCommand& command) {
  const auto known = std::find_if(
      past_results_.begin(), past_results_.end(),
      [&](const MotionFileResult& result) { return has_same_sender(result, command); });
  if (known == past_results_.end()) return false;
  results_.push_back(*known);
  return true;
}

bool MotionFileCore::is_waiting(const MotionFileCommand& command) const {
  if (job_ && has_same_sender(job_->command, command)) return true;
  return std::any_of(jobs_.begin(), jobs_.end(),
                     [&](const Job& job) { return has_same_sender(job.command, command); });
}

void MotionFileCore::take_motion(const MotionFileCommand& command) {
  // Its sender repeats it, when there is room again.
  if (jobs_.size() >= kMaxJobs) return;
  auto script = read(command);
  if (const auto* fault = std::get_if<MotionFault>(&script)) {
    answer(command, *fault);
    return;
  }
  jobs_.push_back({command, std::get<ActionScript>(std::move(script))});
}

std::variant<ActionScript, MotionFault> MotionFileCore::read(
    const MotionFileCommand& command) const {
  ActionScript script;
  if (command.yaml.empty()) {
    auto converted = motion::to_script(*model_, command.motion);
    if (auto* fault = std::get_if<MotionFault>(&converted)) return std::move(*fault);
    script = std::get<ActionScript>(std::move(converted));
  } else {
    try {
      script = parse_motion(*model_, command.yaml, "motion");
    } catch (const std::exception& error) {
      return MotionFault{-1, Reason("motion-malformed", {error.what()})};
    }
    if (auto fault = motion::find_form_fault(script)) return *std::move(fault);
  }
  std::string& name = script.sequence.name;
  if (!command.name.empty()) name = command.name;
  if (name.empty() && command.operation == MotionFileOperation::kCheck) name = kUnnamed;
  if (auto fault = find_name_fault(command, name)) return MotionFault{-1, *std::move(fault)};
  return script;
}

std::optional<Reason> MotionFileCore::find_name_fault(const MotionFileCommand& command,
                                                      const std::string& name) const {
  if (!is_motion_name(name)) return Reason("motion-name-invalid", {quoted(name)});
  if (command.operation != MotionFileOperation::kSave) return std::nullopt;
  if (model_->find_action(name) != nullptr) return Reason("action-name-in-use", {name});
  if (is_temporary_motion(name)) return std::nullopt;
  if (store_.find(name) != nullptr) {
    return command.may_replace ? std::nullopt
                               : std::optional<Reason>(Reason("motion-name-in-use", {name}));
  }
  if (store_.num_kept() < MotionStore::kMaxMotions) return std::nullopt;
  return Reason("too-many-motions", {std::to_string(MotionStore::kMaxMotions)});
}

void MotionFileCore::get(const MotionFileCommand& command) {
  const auto script = store_.find(command.name);
  if (script == nullptr) {
    answer(command, MotionFault{-1, Reason("motion-unknown", {quoted(command.name)})});
    return;
  }
  answer(command, std::nullopt, script.get());
}

void MotionFileCore::erase(const MotionFileCommand& command) {
  try {
    if (!store_.erase(command.name)) {
      answer(command, MotionFault{-1, Reason("motion-unknown", {quoted(command.name)})});
      return;
    }
  } catch (const std::exception& error) {
    answer(command, MotionFault{-1, Reason("motion-not-saved", {error.what()})});
    return;
  }
  changes_.push_back(command.name);
  answer(command, std::nullopt);
}

std::optional<MotionFileCore::Job> MotionFileCore::next_job() {
  if (job_ || jobs_.empty()) return std::nullopt;
  job_ = std::move(jobs_.front());
  jobs_.pop_front();
  return job_;
}

void MotionFileCore::finish(const MotionReport& report) {
  if (!job_) return;
  const Job job = *std::move(job_);
  job_.reset();
  const ActionScript* repaired = report.repaired ? &*report.repaired : nullptr;
  if (report.fault || job.command.operation == MotionFileOperation::kCheck) {
    answer(job.command, report.fault, repaired, report.repair);
    return;
  }
  // Another motion of this name may have been saved in the meantime.
  const std::string& name = job.script.sequence.name;
  if (auto fault = find_name_fault(job.command, name)) {
    answer(job.command, MotionFault{-1, *std::move(fault)});
    return;
  }
  try {
    store_.save(report.script);
  } catch (const std::exception& error) {
    answer(job.command, MotionFault{-1, Reason("motion-not-saved", {error.what()})});
    return;
  }
  changes_.push_back(name);
  answer(job.command, std::nullopt);
}

MotionFileResult MotionFileCore::list() const {
  MotionFileResult result;
  result.names = store_.names();
  return result;
}

NamedMotion MotionFileCore::find(const std::string& name) const {
  const auto script = store_.find(name);
  if (script != nullptr) return motion::to_named(*model_, *script);
  NamedMotion none;
  none.name = name;
  return none;
}

void MotionFileCore::answer(const MotionFileCommand& command,
                            const std::optional<MotionFault>& fault, const ActionScript* motion,
                            const std::string& repair) {
  MotionFileResult result = list();
  result.source = command.source;
  result.id = command.id;
  result.is_ok = !fault;
  if (fault) {
    result.keyframe = fault->keyframe;
    result.reason = fault->reason;
  }
  if (motion != nullptr) {
    result.motion = motion::to_named(*model_, *motion);
    result.yaml = to_yaml(*model_, *motion);
    result.repair = repair;
  }
  results_.push_back(result);
  past_results_.push_back(std::move(result));
  if (past_results_.size() > kNumRemembered) past_results_.pop_front();
}

}  // namespace nao::motion_files

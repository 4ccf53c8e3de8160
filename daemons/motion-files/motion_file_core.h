#pragma once

#include <deque>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "daemons/motion-files/motion_checker.h"
#include "daemons/motion-files/motion_store.h"
#include "messages/motion_file.h"
#include "robot_model/robot_model.h"

namespace nao::motion_files {

/** Answers commands about taught motions. Deleting, listing and reading are answered at once; a
 * motion that is to be checked or saved becomes a job for a MotionChecker, since simulating it
 * takes seconds.
 *
 * No bus, clock or thread; the only files are those of its MotionStore. */
class MotionFileCore {
 public:
  /** A motion to be checked, and the command that asks for it. */
  struct Job {
    MotionFileCommand command;
    motion::ActionScript script;
  };

  /** @param model  Must outlive this. @param folder  Folder of the motions' files. */
  MotionFileCore(const RobotModel& model, std::filesystem::path folder)
      : model_(&model), store_(model, std::move(folder)) {}

  const MotionStore& store() const { return store_; }

  /** Takes a command. A repeated one gets its result again; one without source or number is
   * ignored.
   */
  void receive(const MotionFileCommand& command);

  /** The next motion to be checked; the caller passes the report to finish(). Nothing if there is
   * none, or the last one has not been finished. */
  std::optional<Job> next_job();
  void finish(const MotionReport& report);

  /** Results since the last call. */
  std::vector<MotionFileResult> take_results() { return std::exchange(results_, {}); }
  /** Names of the motions that were saved or deleted since the last call. */
  std::vector<std::string> take_changes() { return std::exchange(changes_, {}); }
  /** The list of motions, as a result of no command. */
  MotionFileResult list() const;
  /** A motion to announce; without keyframes if there is none of that name. */
  NamedMotion find(const std::string& name) const;

 private:
  bool repeat_result(const MotionFileCommand& command);
  bool is_waiting(const MotionFileCommand& command) const;
  void take_motion(const MotionFileCommand& command);
  std::variant<motion::ActionScript, motion::MotionFault> read(
      const MotionFileCommand& command) const;
  std::optional<Reason> find_name_fault(const MotionFileCommand& command,
                                        const std::string& name) const;
  void get(const MotionFileCommand& command);
  void erase(const MotionFileCommand& command);
  /** @param motion  Motion of the answer; may be none. */
  void answer(const MotionFileCommand& command, const std::optional<motion::MotionFault>& fault,
              const motion::ActionScript* motion = nullptr, const std::string& repair = "");

  const RobotModel* model_;
  MotionStore store_;
  std::deque<Job> jobs_;
  /** The one that is being checked. */
  std::optional<Job> job_;
  std::vector<MotionFileResult> results_;
  std::deque<MotionFileResult> past_results_;
  std::vector<std::string> changes_;
};

}  // namespace nao::motion_files

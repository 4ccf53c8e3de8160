#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "daemons/motion/actions/action_script.h"
#include "robot_model/robot_model.h"

namespace nao {

/** The taught motions: a folder with a file NAME.yaml for each, and in memory those whose name
 * begins with '_', which have no file. */
class MotionStore {
 public:
  /** Number of motions with a file, and without one; of the latter the oldest is dropped. Chosen:
   * more than a person finds again in a list. */
  static constexpr size_t kMaxMotions = 200;
  static constexpr size_t kMaxTemporary = 8;

  /** Reads the folder, if it exists. Files that are not motions of this robot are left alone.
   * @param model  Must outlive this. */
  MotionStore(const RobotModel& model, std::filesystem::path folder);

  /** Faults of the files that were left alone, one sentence for each. */
  const std::vector<std::string>& faults() const { return faults_; }

  const std::filesystem::path& folder() const { return folder_; }
  /** Sorted. */
  std::vector<std::string> names() const;
  /** @return nullptr if there is none of that name. */
  std::shared_ptr<const motion::ActionScript> find(const std::string& name) const;
  /** Number of motions with a file. */
  size_t num_kept() const;

  /** Saves a motion under its name, and replaces one of the same name.
   * @throws Error  if the file cannot be written. */
  void save(const motion::ActionScript& script);
  /** @return false if there is none of that name. @throws Error  if the file cannot be deleted. */
  bool erase(const std::string& name);

 private:
  std::filesystem::path file_of(const std::string& name) const;

  const RobotModel* model_;
  std::filesystem::path folder_;
  std::map<std::string, std::shared_ptr<const motion::ActionScript>> motions_;
  /** Names of those without a file, oldest first. */
  std::vector<std::string> temporary_;
  std::vector<std::string> faults_;
};

}  // namespace nao

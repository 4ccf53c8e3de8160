#include "daemons/motion-files/motion_store.h"

#include <algorithm>
#include <system_error>
#include <utility>

#include "common/error.h"
#include "common/output_file.h"
#include "common/text_file.h"
#include "daemons/motion-files/motion_text.h"
#include "daemons/motion/actions/taught_script.h"
#include "messages/motion_file.h"

namespace nao {
namespace {

using motion::ActionScript;

/** @throws Error  if it is not a motion of this robot. */
ActionScript read_motion_file(const RobotModel& model, const std::filesystem::path& file) {
  if (std::filesystem::file_size(file) > kMaxMotionTextBytes) {
    throw Error(file.string() + " is too long for a motion");
  }
  ActionScript script = parse_motion(model, read_file(file), file.string());
  if (const auto fault = motion::find_form_fault(script)) {
    throw Error(file.string() + ": " + to_sentence(fault->reason));
  }
  if (script.sequence.name != file.stem()) {
    throw Error(file.string() + " has a motion of another name, " + script.sequence.name);
  }
  if (is_temporary_motion(script.sequence.name)) {
    throw Error(file.string() + ": names that begin with _ are for motions without a file");
  }
  return script;
}

}  // namespace

MotionStore::MotionStore(const RobotModel& model, std::filesystem::path folder)
    : model_(&model), folder_(std::move(folder)) {
  std::error_code error;
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder_, error)) {
    if (entry.path().extension() == ".yaml" && entry.is_regular_file(error)) {
      files.push_back(entry.path());
    }
  }
  std::sort(files.begin(), files.end());
  for (const auto& file : files) {
    if (motions_.size() >= kMaxMotions) {
      faults_.push_back(folder_.string() + " has more than " + std::to_string(kMaxMotions) +
                        " motions; the others are left out");
      break;
    }
    try {
      ActionScript script = read_motion_file(model, file);
      const std::string name = script.sequence.name;
      motions_[name] = std::make_shared<const ActionScript>(std::move(script));
    } catch (const std::exception& fault) {
      faults_.push_back(fault.what());
    }
  }
}

std::vector<std::string> MotionStore::names() const {
  std::vector<std::string> names;
  for (const auto& [name, script] : motions_) names.push_back(name);
  return names;
}

std::shared_ptr<const ActionScript> MotionStore::find(const std::string& name) const {
  const auto found = motions_.find(name);
  return found == motions_.end() ? nullptr : found->second;
}

size_t MotionStore::num_kept() const {
  return motions_.size() - temporary_.size();
}

std::filesystem::path MotionStore::file_of(const std::string& name) const {
  // The name comes from a client: nothing that leads out of the folder passes.
  if (!is_motion_name(name)) throw Error("\"" + name + "\" is not a valid motion name");
  return folder_ / (name + ".yaml");
}

void MotionStore::save(const ActionScript& script) {
  const std::string& name = script.sequence.name;
  if (is_temporary_motion(name)) {
    std::erase(temporary_, name);
    temporary_.push_back(name);
    if (temporary_.size() > kMaxTemporary) {
      motions_.erase(temporary_.front());
      temporary_.erase(temporary_.begin());
    }
  } else {
    std::filesystem::create_directories(folder_);
    replace_file(file_of(name), to_yaml(*model_, script));
  }
  motions_[name] = std::make_shared<const ActionScript>(script);
}

bool MotionStore::erase(const std::string& name) {
  if (!motions_.contains(name)) return false;
  if (!is_temporary_motion(name)) std::filesystem::remove(file_of(name));
  std::erase(temporary_, name);
  motions_.erase(name);
  return true;
}

}  // namespace nao

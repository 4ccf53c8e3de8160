#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "common/data_path.h"
#include "common/error.h"
#include "robot_model/robot_model.h"
#include "test/support/temporary_folder.h"

namespace nao {

/** Files that RobotModel::load() reads. */
inline const std::vector<std::string> kRobotFiles = {"nao.urdf", "robot.yaml", "postures.yaml"};

/** A copy of the NAO's files that a test may change. */
class CopiedRobot {
 public:
  CopiedRobot() {
    const std::filesystem::path source = data_path() / "robots" / "nao";
    for (const std::string& file : kRobotFiles) {
      std::filesystem::copy_file(source / file, folder_.path() / file);
    }
    std::filesystem::create_directory_symlink(source / "meshes", folder_.path() / "meshes");
  }
  const std::filesystem::path& path() const { return folder_.path(); }
  std::string read(const std::string& file) const { return read_text(path() / file); }
  void write(const std::string& file, const std::string& text) const {
    write_text(path() / file, text);
  }

 private:
  TemporaryFolder folder_;
};

/** @return The error's text; empty if the folder loads. */
inline std::string error_of(const std::filesystem::path& folder) {
  try {
    RobotModel::load(folder);
    return "";
  } catch (const ModelError& error) {
    return error.what();
  }
}

}  // namespace nao

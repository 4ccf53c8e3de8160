#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

#include "robot_model/robot_model.h"

namespace nao::motion {

/** The NAO with another value of a key of its robot.yaml. The key must be on a line of its own.
 * @param value  YAML of one line. */
inline RobotModel load_nao_variant(const std::string& key, const std::string& value) {
  namespace fs = std::filesystem;
  const fs::path source = fs::path(NAO_TEST_DATA) / "robots" / "nao";
  const fs::path folder = fs::path(::testing::TempDir()) /
                          (std::string("nao_variant_") +
                           ::testing::UnitTest::GetInstance()->current_test_info()->name());
  fs::remove_all(folder);
  fs::create_directories(folder);
  for (const fs::directory_entry& entry : fs::directory_iterator(source)) {
    if (entry.path().filename() == "robot.yaml") continue;
    fs::create_symlink(entry.path(), folder / entry.path().filename());
  }
  std::ifstream original(source / "robot.yaml");
  std::ofstream changed(folder / "robot.yaml");
  bool is_found = false;
  for (std::string line; std::getline(original, line);) {
    const bool is_key = line.starts_with(key + ":");
    is_found = is_found || is_key;
    changed << (is_key ? key + ": " + value : line) << "\n";
  }
  if (!is_found) throw std::runtime_error("robot.yaml has no key " + key);
  changed.close();
  return RobotModel::load(folder);
}

}  // namespace nao::motion

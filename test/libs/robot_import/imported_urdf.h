#pragma once

#include <gmock/gmock.h>

#include <filesystem>
#include <string>
#include <vector>

#include "common/error.h"
#include "robot_import/robot_import.h"
#include "robot_model/robot_model.h"
#include "test/support/test_biped.h"

namespace nao {

/** A biped's URDF that a test may change, and its import. */
class ImportedUrdf : public testing::Test {
 protected:
  /** Replaces the first occurrence after a text. */
  void replace(const std::string& after, const std::string& from, const std::string& to) {
    const size_t at = urdf_.find(from, urdf_.find(after));
    ASSERT_NE(at, std::string::npos) << from;
    urdf_.replace(at, from.size(), to);
  }
  /** Adds elements to a link. */
  void add_to_link(const std::string& link, const std::string& elements) {
    const std::string start = "<link name=\"" + link + "\">";
    replace(start, start, start + elements);
  }
  RobotModel import() {
    write_text(folder_.path() / "source" / "biped.urdf", urdf_);
    std::filesystem::remove_all(robot());
    findings_ = import_robot(folder_.path() / "source" / "biped.urdf", robot());
    lines_.clear();
    for (const Finding& finding : findings_) lines_.push_back(to_line(finding));
    return RobotModel::load(robot());
  }
  std::string error_of_import() {
    try {
      import();
      return "";
    } catch (const ModelError& error) {
      return error.what();
    }
  }
  std::filesystem::path robot() const { return folder_.path() / "biped"; }
  std::filesystem::path source() const { return folder_.path() / "source"; }
  void SetUp() override { std::filesystem::create_directories(source()); }

  TemporaryFolder folder_;
  std::string urdf_ = make_biped_urdf(TestBiped{});
  Findings findings_;
  std::vector<std::string> lines_;
};

}  // namespace nao

#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "robot_model/robot_model.h"
#include "test/support/onnx_file.h"

namespace nao::motion {

/** A copy of a robot's files to which a test adds policies. */
class PolicyRobot {
 public:
  explicit PolicyRobot(const std::string& name = "t1") {
    namespace fs = std::filesystem;
    const fs::path source = fs::path(NAO_TEST_DATA) / "robots" / name;
    fs::create_directory(folder());
    for (const auto& entry : fs::directory_iterator(source)) {
      if (entry.path().filename() != kPolicyFolder) {
        fs::create_symlink(entry.path(), folder() / entry.path().filename());
      }
    }
  }

  /** A policy of one observation that is commanded velocities and the last actions.
   * @param joints  Lines of the manifest. @param head  Lines before them. */
  void add(const std::string& name, const std::string& head, const std::string& joints,
           int num_inputs, const std::vector<OnnxLayer>& layers) {
    const std::filesystem::path policy = folder() / kPolicyFolder / name;
    std::filesystem::create_directories(policy);
    write_text(policy / kPolicyFile, "network: policy.onnx\nrate: 50\n" + head +
                                         "observations: [{quantity: velocity_command}, {quantity: "
                                         "last_action}]\njoints:\n" +
                                         joints);
    OnnxFile::write(policy / "policy.onnx", num_inputs, layers);
  }
  void remove(const std::string& file) const { std::filesystem::remove(folder() / file); }
  std::filesystem::path network_of(const std::string& name) const {
    return folder() / kPolicyFolder / name / "policy.onnx";
  }
  std::shared_ptr<const RobotModel> load() const {
    return std::make_shared<const RobotModel>(RobotModel::load(folder()));
  }

 private:
  std::filesystem::path folder() const { return temporary_.path() / "robot"; }

  TemporaryFolder temporary_;
};

}  // namespace nao::motion

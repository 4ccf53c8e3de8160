#pragma once

#include <unistd.h>

#include <string>
#include <utility>
#include <vector>

#include "common/child_process.h"

namespace nao {

/** URL of a bus of this test process alone: parallel tests must not share a bus. */
inline std::string private_bus_url() {
  return "udpm://239.255.76.67:" + std::to_string(20000 + getpid() % 10000) + "?ttl=0";
}

/** A program of the project as a child of a test; its output is the test's. */
class ChildProgram : public ChildProcess {
 public:
  ChildProgram(const std::string& name, std::vector<std::string> arguments)
      : ChildProcess(command_of(name, std::move(arguments)), Output::kInherit) {}

 private:
  static std::vector<std::string> command_of(const std::string& name,
                                             std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), program_folder() + "/" + name);
    return arguments;
  }
};

}  // namespace nao

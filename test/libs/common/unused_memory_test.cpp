#include "common/unused_memory.h"

#include <gtest/gtest.h>

#include <fstream>
#include <string>

namespace nao {
namespace {

/** Resident pages of files, kB. */
int resident_file_kb() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);) {
    if (line.rfind("RssFile:", 0) == 0) return std::stoi(line.substr(8));
  }
  return -1;
}

TEST(UnusedMemory, CodeLeavesMemoryAndComesBack) {
  const int before = resident_file_kb();
  release_unused_memory();
  const int after = resident_file_kb();
  EXPECT_GT(after, 0);
  EXPECT_LT(after, before);
}

}  // namespace
}  // namespace nao

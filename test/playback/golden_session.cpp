#include "test/playback/golden_session.h"

#include <cstdlib>

namespace nao::playback {

void expect_golden_trace(const std::string& name, const GoldenTrace& trace,
                         const std::string& hint) {
  const std::filesystem::path file = golden_file(name, "expected");
  if (std::getenv("NAO_WRITE_GOLDEN") != nullptr) {
    write_golden_trace(file, trace);
    GTEST_SKIP() << "wrote " << file;
  }
  const GoldenExpectation expected = read_golden_trace(file);
  if (expected.math_functions != hash_of_math_functions()) {
    GTEST_SKIP() << "sin(), exp() and the like give other last bits on this processor or with this "
                    "C library than where "
                 << file.filename() << " was written; nothing is compared";
  }
  for (const std::string& difference : find_differences(expected.trace, trace)) {
    ADD_FAILURE() << "session " << name << ": " << difference << hint;
  }
}

}  // namespace nao::playback

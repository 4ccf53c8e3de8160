#include "robot_import/limited_process.h"

#include <gmock/gmock.h>

#include <csignal>
#include <stdexcept>
#include <vector>

#include "common/error.h"

namespace nao {
namespace {

std::string error_of(const std::function<std::string()>& task, const ProcessLimits& limits = {}) {
  try {
    run_limited(task, limits);
    return "";
  } catch (const ModelError& error) {
    return error.what();
  }
}

TEST(LimitedProcess, ReturnsWhatTheTaskReturned) {
  // More than a pipe holds.
  const std::string large(1'000'000, 'a');
  EXPECT_EQ(run_limited([&]() -> std::string { return std::string(large); }, {}), large);
  EXPECT_EQ(run_limited([] { return std::string(); }, {}), "");
}

TEST(LimitedProcess, PassesOnTheTasksError) {
  EXPECT_EQ(error_of([]() -> std::string { throw std::runtime_error("is not a mesh"); }),
            "is not a mesh");
}

TEST(LimitedProcess, OutlivesACrash) {
  EXPECT_THAT(error_of([] {
                std::signal(SIGSEGV, SIG_DFL);
                std::raise(SIGSEGV);
                return std::string();
              }),
              testing::StartsWith("makes its reader crash"));
}

TEST(LimitedProcess, EndsATaskThatTakesTooLong) {
  volatile bool is_endless = true;
  ProcessLimits limits;
  limits.processor_time = 1;
  const auto task = [&] {
    while (is_endless) {
    }
    return std::string();
  };
  EXPECT_EQ(error_of(task, limits), "takes more than 1 s");
}

TEST(LimitedProcess, EndsATaskThatTakesTooMuchMemory) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "the memory of a build with sanitizers is not limited";
#endif
  EXPECT_EQ(
      error_of([] { return std::string(std::vector<char>(size_t{3} << 30U, 'a').data(), 1); }),
      "needs more than 2048 MiB of memory");
}

}  // namespace
}  // namespace nao

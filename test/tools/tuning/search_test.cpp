#include "tools/tuning/search.h"

#include <gtest/gtest.h>

#include <atomic>
#include <vector>

#include "common/error.h"

namespace nao {
namespace {

TEST(ForEachIndex, CallsOncePerIndexOnAnyNumberOfThreads) {
  for (const int jobs : {1, 2, 7}) {
    std::vector<std::atomic<int>> calls(100);
    for_each_index(calls.size(), jobs, [&](size_t i) { ++calls[i]; });
    for (const auto& count : calls) EXPECT_EQ(count, 1) << jobs;
  }
  for_each_index(0, 2, [](size_t) { FAIL(); });
}

TEST(Text, NamesTheFileThatCannotBeReadOrWritten) {
  EXPECT_THROW(read_text("/no/such/file"), Error);
  EXPECT_THROW(write_text("/no/such/file", "text"), Error);
}

}  // namespace
}  // namespace nao

#include "tools/tuning/task_codec.h"

#include <gtest/gtest.h>

#include <limits>

#include "common/error.h"
#include "common/random.h"

namespace nao {
namespace {

TEST(TaskCodec, KeepsEveryBitOfATask) {
  const IndexedTask task = {
      3, {{0.1, -0.0, 5e-324, std::numeric_limits<double>::infinity()}, ~uint64_t{0}, 12}};
  EXPECT_EQ(decode_task(encode_task(task)), task);
  EXPECT_EQ(decode_task(encode_task({})), IndexedTask{});
}

TEST(TaskCodec, KeepsFiguresAndErrors) {
  const Outcome good = {.index = 9, .figures = {1.0 / 3, -2}, .duration = 0.25};
  EXPECT_EQ(decode_outcome(encode_outcome(good)), good);
  const Outcome bad = {.index = 1, .error = "cannot read \xc3\xa4 file"};
  EXPECT_EQ(decode_outcome(encode_outcome(bad)), bad);
}

TEST(TaskCodec, ReportsDamagedMessages) {
  EXPECT_THROW(decode_task({}), Error);
  EXPECT_THROW(decode_task({1, 2, uint64_t{1} << 40}), Error);
  EXPECT_THROW(decode_outcome({1, 2}), Error);
  EXPECT_THROW(decode_outcome({1, 2, ~uint64_t{0}}), Error);
}

TEST(TaskCodec, SurvivesRandomMessages) {
  Random random(1);
  for (int i = 0; i < 5000; ++i) {
    Words words(random.next() % 8);
    for (uint64_t& word : words) word = random.next() >> (random.next() % 64);
    try {
      EXPECT_EQ(encode_task(decode_task(words)), words);
    } catch (const Error&) {
    }
    try {
      (void)decode_outcome(words);
    } catch (const Error&) {
    }
  }
}

}  // namespace
}  // namespace nao

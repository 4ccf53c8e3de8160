#include "tools/tuning/task_codec.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "common/error.h"
#include "common/random.h"

namespace nao {
namespace {

TEST(TaskCodec, KeepsEveryBitOfATask) {
  const IndexedTask task = {
      3, {{0.1, -0.0, 5e-324, std::numeric_limits<double>::infinity()}, ~uint64_t{0}, 12}};
  EXPECT_EQ(decode<IndexedTask>(encode(task)), task);
  EXPECT_TRUE(std::signbit(decode<IndexedTask>(encode(task)).task.point[1]));
  EXPECT_EQ(decode<IndexedTask>(encode(IndexedTask{})), IndexedTask{});
}

TEST(TaskCodec, KeepsFiguresAndErrors) {
  const Outcome good = {.index = 9, .figures = {1.0 / 3, -2}, .duration = 0.25};
  EXPECT_EQ(decode<Outcome>(encode(good)), good);
  const Outcome bad = {.index = 1, .error = "cannot read \xc3\xa4 file"};
  EXPECT_EQ(decode<Outcome>(encode(bad)), bad);
  const Outcome unknown = {.figures = {std::numeric_limits<double>::quiet_NaN()}};
  EXPECT_TRUE(std::isnan(decode<Outcome>(encode(unknown)).figures[0]));
}

TEST(TaskCodec, ReportsDamagedMessages) {
  EXPECT_THROW(decode<IndexedTask>({}), Error);
  EXPECT_THROW(decode<IndexedTask>(encode(Outcome{})), Error);
  EXPECT_THROW(decode<Outcome>(encode(IndexedTask{})), Error);
  const Bytes whole = encode(Outcome{.figures = {1, 2}});
  EXPECT_THROW(decode<Outcome>(Bytes(whole.begin(), whole.end() - 1)), Error);
}

TEST(TaskCodec, SurvivesRandomMessages) {
  Random random(1);
  const Bytes whole = encode(IndexedTask{3, {{0.1, 2}, 5, 12}});
  for (int i = 0; i < 5000; ++i) {
    Bytes bytes = whole;
    bytes[random.next() % bytes.size()] = static_cast<uint8_t>(random.next());
    try {
      (void)decode<IndexedTask>(bytes);
    } catch (const Error&) {
    }
  }
}

}  // namespace
}  // namespace nao

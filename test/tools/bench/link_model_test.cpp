#include "tools/bench/link_model.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace nao::bench {
namespace {

LinkConditions lossy(double loss) {
  LinkConditions conditions;
  conditions.loss = loss;
  return conditions;
}

TEST(LinkModel, DelaysEveryPacket) {
  LinkConditions conditions;
  conditions.delay = 0.1;
  LinkModel link(conditions, 1, 0);
  EXPECT_DOUBLE_EQ(link.send(1500, 2).value(), 2.1);
  EXPECT_DOUBLE_EQ(link.send(1500, 2).value(), 2.1);
}

TEST(LinkModel, LosesTheSameShareWithTheSameSeed) {
  const auto lost = [](uint32_t seed) {
    LinkModel link(lossy(0.1), seed, 0);
    std::vector<bool> packets;
    for (int i = 0; i < 10000; ++i) packets.push_back(!link.send(100, i));
    return packets;
  };
  const std::vector<bool> first = lost(3);
  EXPECT_EQ(first, lost(3));
  EXPECT_NE(first, lost(4));
  // Five standard deviations of the binomial distribution.
  EXPECT_NEAR(static_cast<double>(std::count(first.begin(), first.end(), true)), 1000, 150);
}

TEST(LinkModel, SendsAtItsRateAndLosesWhatFindsItsQueueFull) {
  LinkConditions conditions;
  conditions.rate = 125e3;
  LinkModel link(conditions, 1, 0);
  EXPECT_DOUBLE_EQ(link.send(1250, 1).value(), 1.01);
  EXPECT_DOUBLE_EQ(link.send(1250, 1).value(), 1.02);
  int num_taken = 2;
  while (link.send(1250, 1)) ++num_taken;
  EXPECT_NEAR(num_taken * 1250, LinkModel::kMaxWaiting, 2 * 1250);
  EXPECT_TRUE(link.send(1250, 1.5).has_value()) << "the queue has become shorter";
}

TEST(LinkModel, HoldsInAPauseWhatIsSent) {
  LinkConditions conditions;
  conditions.pause = 0.8;
  conditions.pause_period = 10;
  LinkModel link(conditions, 1, 100);
  EXPECT_DOUBLE_EQ(link.send(100, 109.1).value(), 109.1);
  EXPECT_DOUBLE_EQ(link.send(100, 109.3).value(), 110);
  EXPECT_DOUBLE_EQ(link.send(100, 109.9).value(), 110);
  EXPECT_DOUBLE_EQ(link.send(100, 110.1).value(), 110.1);
}

}  // namespace
}  // namespace nao::bench

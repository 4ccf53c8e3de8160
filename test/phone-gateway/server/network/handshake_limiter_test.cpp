#include "phone-gateway/server/network/handshake_limiter.h"

#include <gtest/gtest.h>

#include <vector>

namespace nao::gateway {
namespace {

TEST(HandshakeLimiter, EvictsTheOldestConnectionForOneTooMany) {
  HandshakeLimiter limiter(2);
  std::vector<int> evicted;
  std::vector<HandshakeLimiter::Entry> entries(3);
  for (int i = 0; i < 3; ++i) {
    const auto evict = [&, i] {
      evicted.push_back(i);
      limiter.remove(entries[i]);
    };
    EXPECT_EQ(limiter.add("10.0.0.1", evict, entries[i]), i == 2);
  }
  EXPECT_EQ(evicted, std::vector<int>{0});
  EXPECT_EQ(limiter.size(), 2u);
}

TEST(HandshakeLimiter, EvictsAnotherConnectionWhileEvictedOnesAreStillClosing) {
  HandshakeLimiter limiter(2);
  std::vector<int> evicted;
  std::vector<HandshakeLimiter::Entry> entries(6);
  for (int i = 0; i < 6; ++i) {
    const auto evict = [&evicted, i] { evicted.push_back(i); };
    limiter.add("10.0.0.1", evict, entries[i]);
  }
  EXPECT_EQ(evicted, (std::vector<int>{0, 1, 2, 3}));
  EXPECT_EQ(limiter.size(), 2u);
  for (const int i : {2, 0, 3, 1}) limiter.remove(entries[i]);
  EXPECT_EQ(limiter.size(), 2u);
  limiter.remove(entries[4]);
  EXPECT_EQ(limiter.size(), 1u);
}

TEST(HandshakeLimiter, EvictsConnectionsOfTheBusiestAddress) {
  HandshakeLimiter limiter(3);
  std::vector<std::string> evicted;
  const auto add = [&](const std::string& address) {
    HandshakeLimiter::Entry entry;
    const auto evict = [&evicted, address] { evicted.push_back(address); };
    return limiter.add(address, evict, entry);
  };
  EXPECT_FALSE(add("phone"));
  for (int i = 0; i < 10; ++i) add("crowd");
  EXPECT_EQ(evicted, std::vector<std::string>(8, "crowd"));
  EXPECT_TRUE(add("another phone"));
  EXPECT_EQ(evicted, std::vector<std::string>(9, "crowd"));
}

}  // namespace
}  // namespace nao::gateway

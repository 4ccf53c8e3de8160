#include "common/rate_limiter.h"

#include <gtest/gtest.h>

namespace nao {
namespace {

TEST(RateLimiter, PassesOneEventPerPeriodAndCountsTheRest) {
  RateLimiter limiter(1.0);
  EXPECT_EQ(limiter.allow(10.0), 0);
  EXPECT_FALSE(limiter.allow(10.2));
  EXPECT_FALSE(limiter.allow(10.9));
  EXPECT_EQ(limiter.allow(11.0), 2);
  EXPECT_FALSE(limiter.allow(11.5));
}

}  // namespace
}  // namespace nao

#include "phone-gateway/server/core/driving_lease.h"

#include <gtest/gtest.h>

namespace nao::gateway {
namespace {

TEST(DrivingLease, IsGrantedToTheFirstClientThatAsks) {
  DrivingLease lease(10);
  EXPECT_TRUE(lease.take(1, 0));
  EXPECT_FALSE(lease.take(2, 1));
  EXPECT_EQ(lease.driver(), 1u);
}

TEST(DrivingLease, IsTakenOverOnlyFromADriverWithoutACommandForTenSeconds) {
  DrivingLease lease(10);
  lease.take(1, 0);
  lease.refresh(5);
  EXPECT_FALSE(lease.take(2, 14.9));
  EXPECT_EQ(lease.driver(), 1u);
  EXPECT_TRUE(lease.take(2, 15.1));
  EXPECT_EQ(lease.driver(), 2u);
}

TEST(DrivingLease, StaysWithAnIdleDriverUntilAnotherClientAsks) {
  DrivingLease lease(10);
  lease.take(1, 0);
  EXPECT_TRUE(lease.take(1, 1000));
  EXPECT_EQ(lease.driver(), 1u);
}

TEST(DrivingLease, IsReleasedByTheDriverOnly) {
  DrivingLease lease(10);
  EXPECT_FALSE(lease.release(0));
  lease.take(1, 0);
  EXPECT_FALSE(lease.release(2));
  EXPECT_TRUE(lease.release(1));
  EXPECT_EQ(lease.driver(), 0u);
}

TEST(DrivingLease, StaysWithTheOperatorUntilReleased) {
  DrivingLease lease(10);
  lease.take(1, 0);
  EXPECT_TRUE(lease.take(kOperatorId, 1));
  EXPECT_FALSE(lease.take(1, 1000));
  EXPECT_TRUE(lease.release(kOperatorId));
  EXPECT_TRUE(lease.take(1, 1001));
}

}  // namespace
}  // namespace nao::gateway

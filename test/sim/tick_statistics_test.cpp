#include "sim/tick_statistics.h"

#include <gtest/gtest.h>

namespace nao::sim {
namespace {

TEST(TickStatistics, ReportTheTicksSinceTheLastReport) {
  TickStatistics statistics(0.01, 0);
  for (int i = 0; i < 100; ++i) statistics.note_tick(i < 98 ? 0.001 : 0.02, 0.002);
  TickStatistics::Report report = statistics.report(2);
  EXPECT_EQ(report.num_ticks, 100);
  EXPECT_NEAR(report.real_time_factor, 0.5, 1e-12);
  EXPECT_NEAR(report.duration_mean, 0.002, 1e-12);
  EXPECT_EQ(report.delay_p99, 0.02);

  report = statistics.report(3);
  EXPECT_EQ(report.num_ticks, 0);
  EXPECT_EQ(report.real_time_factor, 0);
  EXPECT_EQ(report.duration_mean, 0);
  EXPECT_EQ(report.delay_p99, 0);
}

}  // namespace
}  // namespace nao::sim

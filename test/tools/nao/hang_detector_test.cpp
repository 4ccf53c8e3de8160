#include "tools/nao/hang_detector.h"

#include <gtest/gtest.h>

namespace nao {
namespace {

/** Steps of 0.2 s from `begin` to `end`, with its own heartbeat every second. */
std::vector<HangDetector::Hung> run(HangDetector& detector, double begin, double end,
                                    bool hears_itself = true) {
  std::vector<HangDetector::Hung> all;
  double next_heartbeat = begin;
  for (double now = begin; now < end; now += 0.2) {
    if (hears_itself && now >= next_heartbeat) {
      detector.handle_own_heartbeat(now);
      next_heartbeat += 1;
    }
    for (const auto& hung : detector.step(now)) all.push_back(hung);
  }
  return all;
}

TEST(HangDetector, ReportsASilentProgramOnce) {
  HangDetector detector({});
  detector.handle_status(7, "nao-motion");
  EXPECT_TRUE(run(detector, 0, 3.8).empty());
  const auto hung = run(detector, 3.8, 4.4);
  ASSERT_EQ(hung.size(), 1u);
  EXPECT_EQ(hung[0].process_id, 7);
  EXPECT_EQ(hung[0].program, "nao-motion");
}

TEST(HangDetector, DoesNotReportAProgramThatPublishes) {
  HangDetector detector({});
  for (int second = 0; second < 60; ++second) {
    detector.handle_status(7, "nao-motion");
    EXPECT_TRUE(run(detector, second, second + 1).empty());
  }
}

TEST(HangDetector, ReportsAProgramThatNeverPublishes) {
  HangDetector detector({});
  for (int second = 0; second < 60; ++second) {
    // It is found again and again.
    detector.handle_process(7, "nao-motion");
    EXPECT_TRUE(run(detector, second, second + 0.9).empty());
  }
  EXPECT_EQ(detector.num_published(), 0);
  const auto hung = run(detector, 60, 61);
  ASSERT_EQ(hung.size(), 1u);
  EXPECT_EQ(hung[0].process_id, 7);
}

TEST(HangDetector, AProcessThatIsFoundHasPublishedOnlyOnceItDid) {
  HangDetector detector({});
  detector.handle_process(7, "nao-motion");
  detector.handle_process(8, "nao-sim");
  detector.handle_status(7, "nao-motion");
  detector.handle_process(7, "nao-motion");
  EXPECT_EQ(detector.num_published(), 1);
  EXPECT_EQ(run(detector, 0, 4.4).size(), 1u);
}

TEST(HangDetector, ReportsNothingWithoutItsOwnHeartbeat) {
  HangDetector detector({});
  run(detector, 0, 1);
  detector.handle_status(7, "nao-motion");
  EXPECT_TRUE(run(detector, 4, 60, false).empty());
}

TEST(HangDetector, DoesNotCountTimeInWhichItWasDelayedItself) {
  HangDetector detector({});
  run(detector, 0, 1);
  detector.handle_status(7, "nao-motion");
  detector.handle_own_heartbeat(100);
  EXPECT_TRUE(detector.step(100).empty());
  EXPECT_TRUE(run(detector, 100.2, 104).empty());
}

TEST(HangDetector, ForgetsAProgramThatEnded) {
  HangDetector detector({});
  detector.handle_status(7, "nao-motion");
  detector.forget(7);
  EXPECT_TRUE(run(detector, 0, 20).empty());
  EXPECT_TRUE(detector.process_ids().empty());
}

}  // namespace
}  // namespace nao

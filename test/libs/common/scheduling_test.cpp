#include "common/scheduling.h"

#include <gtest/gtest.h>
#include <sched.h>

#include <functional>
#include <thread>

namespace nao {
namespace {

/** Runs `body` in a thread of its own: the scheduling of the test thread stays unchanged. */
void run_in_thread(const std::function<void()>& body) {
  std::thread(body).join();
}

/** SCHED_RR priority of the calling thread. */
int own_priority() {
  sched_param param{};
  sched_getparam(0, &param);
  return param.sched_priority;
}

TEST(Scheduling, AppliesToTheThreadAndThoseThatItStarts) {
  // May be SCHED_BATCH or SCHED_IDLE: then the tests were started with such a policy.
  const int initial = sched_getscheduler(0);
  run_in_thread([initial] {
    if (!request_realtime_scheduling(RealtimePriority::kServing)) {
      EXPECT_EQ(sched_getscheduler(0), initial);
      GTEST_SKIP() << "requires root or RLIMIT_RTPRIO";
    }
    EXPECT_EQ(sched_getscheduler(0), SCHED_RR);
    run_in_thread([] { EXPECT_EQ(sched_getscheduler(0), SCHED_RR); });
    use_normal_scheduling();
    EXPECT_EQ(sched_getscheduler(0), SCHED_OTHER);
  });
  EXPECT_EQ(sched_getscheduler(0), initial);
}

TEST(Scheduling, GivesControlAHigherPriorityThanServing) {
  run_in_thread([] {
    if (!request_realtime_scheduling(RealtimePriority::kServing))
      GTEST_SKIP() << "requires root or RLIMIT_RTPRIO";
    const int serving = own_priority();
    ASSERT_TRUE(request_realtime_scheduling(RealtimePriority::kControl));
    if (own_priority() == serving) GTEST_SKIP() << "requires root or RLIMIT_RTPRIO of 2";
    EXPECT_GT(own_priority(), serving);
  });
}

}  // namespace
}  // namespace nao

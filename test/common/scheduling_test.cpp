#include "common/scheduling.h"

#include <gtest/gtest.h>
#include <sched.h>

#include <functional>
#include <thread>

namespace nao {
namespace {

/** What a thread has made of itself must not outlive the test. */
void run_in_thread(const std::function<void()>& body) {
  std::thread(body).join();
}

/** Of this thread. */
int own_priority() {
  sched_param param{};
  sched_getparam(0, &param);
  return param.sched_priority;
}

TEST(Scheduling, PutsAThreadAndThoseThatItStartsAheadWhereThatIsAllowed) {
  // Not SCHED_OTHER where whoever runs the tests lets them run in the background.
  const int usual = sched_getscheduler(0);
  run_in_thread([usual] {
    if (!ask_for_prompt_turns(Turns::kServing)) {
      EXPECT_EQ(sched_getscheduler(0), usual);
      GTEST_SKIP() << "takes root or RLIMIT_RTPRIO";
    }
    EXPECT_EQ(sched_getscheduler(0), SCHED_RR);
    run_in_thread([] { EXPECT_EQ(sched_getscheduler(0), SCHED_RR); });
    take_usual_turns();
    EXPECT_EQ(sched_getscheduler(0), SCHED_OTHER);
  });
  EXPECT_EQ(sched_getscheduler(0), usual);
}

TEST(Scheduling, LetsControlGoAheadOfServing) {
  run_in_thread([] {
    if (!ask_for_prompt_turns(Turns::kServing)) GTEST_SKIP() << "takes root or RLIMIT_RTPRIO";
    const int serving = own_priority();
    ASSERT_TRUE(ask_for_prompt_turns(Turns::kControl));
    if (own_priority() == serving) GTEST_SKIP() << "takes root or RLIMIT_RTPRIO of 2";
    EXPECT_GT(own_priority(), serving);
  });
}

}  // namespace
}  // namespace nao

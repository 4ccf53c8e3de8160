#include "common/scheduling.h"

#include <sched.h>

namespace nao {
namespace {

// Applies to the calling thread.
bool set_round_robin(int priority) {
  sched_param param{};
  param.sched_priority = priority;
  return sched_setscheduler(0, SCHED_RR, &param) == 0;
}

}  // namespace

bool request_realtime_scheduling(RealtimePriority priority) {
  const int lowest = sched_get_priority_min(SCHED_RR);
  // RLIMIT_RTPRIO may allow the lower of the two priorities only.
  return (priority == RealtimePriority::kControl && set_round_robin(lowest + 1)) ||
         set_round_robin(lowest);
}

void use_normal_scheduling() {
  const sched_param none{};
  sched_setscheduler(0, SCHED_OTHER, &none);
}

}  // namespace nao

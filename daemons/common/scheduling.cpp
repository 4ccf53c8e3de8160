#include "common/scheduling.h"

#include <sched.h>

namespace nao {

bool ask_for_prompt_turns() {
  sched_param lowest{};
  lowest.sched_priority = sched_get_priority_min(SCHED_RR);
  return sched_setscheduler(0, SCHED_RR, &lowest) == 0;
}

void take_usual_turns() {
  const sched_param none{};
  sched_setscheduler(0, SCHED_OTHER, &none);
}

}  // namespace nao

#include "common/scheduling.h"

#include <sched.h>

namespace nao {
namespace {

bool take_turns_at(int priority) {
  sched_param param{};
  param.sched_priority = priority;
  return sched_setscheduler(0, SCHED_RR, &param) == 0;
}

}  // namespace

bool ask_for_prompt_turns(Turns turns) {
  const int lowest = sched_get_priority_min(SCHED_RR);
  return (turns == Turns::kControl && take_turns_at(lowest + 1)) || take_turns_at(lowest);
}

void take_usual_turns() {
  const sched_param none{};
  sched_setscheduler(0, SCHED_OTHER, &none);
}

}  // namespace nao

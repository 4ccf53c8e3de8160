#include "tools/tuning/stop_signal.h"

namespace nao {
namespace {

volatile std::sig_atomic_t signal_has_come = 0;

}  // namespace

StopSignal::StopSignal() {
  signal_has_come = 0;
  struct sigaction action = {};
  action.sa_handler = [](int) { signal_has_come = 1; };
  // The handler acts once: the next signal has its usual effect. Interrupted system calls are
  // restarted.
  action.sa_flags = static_cast<int>(SA_RESETHAND) | SA_RESTART;
  sigaction(SIGINT, &action, &old_interrupt_);
  sigaction(SIGUSR1, &action, &old_user_);
}

StopSignal::~StopSignal() {
  sigaction(SIGINT, &old_interrupt_, nullptr);
  sigaction(SIGUSR1, &old_user_, nullptr);
}

bool StopSignal::has_come() const {
  return signal_has_come != 0;
}

}  // namespace nao

#include "sim/step_threads.h"

namespace nao::sim {
namespace {

/** Number of polls for the next round before a thread goes to sleep: about 50 us, longer than the
 * calling thread's own work between two steps of a tick, and much shorter than a tick. */
constexpr int kLooks = 1000;

void pause() {
#if defined(__x86_64__) || defined(__i386__)
  __builtin_ia32_pause();
#endif
}

}  // namespace

StepThreads::StepThreads(int count) {
  for (int i = 1; i < count; ++i) threads_.emplace_back([this] { work(); });
}

StepThreads::~StepThreads() {
  is_ending_ = true;
  ++round_;
  round_.notify_all();
}

void StepThreads::run(int count, Call call, void* context) {
  if (threads_.empty() || count < 2) {
    for (int i = 0; i < count; ++i) call(context, i);
    return;
  }
  call_ = call;
  context_ = context;
  count_ = count;
  next_item_ = 0;
  num_working_ = static_cast<int>(threads_.size());
  ++round_;
  round_.notify_all();
  take_items();
  // A thread that was not scheduled in time has nothing left to do, but must notice that before the
  // next round.
  for (int looks = 0; num_working_ > 0; ++looks) {
    if (looks < kLooks) {
      pause();
    } else {
      std::this_thread::yield();
    }
  }
}

void StepThreads::take_items() {
  for (int i = next_item_++; i < count_; i = next_item_++) call_(context_, i);
}

void StepThreads::work() {
  unsigned done = 0;
  for (;;) {
    for (int looks = 0; round_ == done && looks < kLooks; ++looks) pause();
    round_.wait(done);
    // A round ends only after every thread has taken part, so that none is missed.
    ++done;
    if (is_ending_) return;
    take_items();
    --num_working_;
  }
}

}  // namespace nao::sim

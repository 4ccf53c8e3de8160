#include "sim/step_threads.h"

namespace nao::sim {
namespace {

/** Number of polls for the next round before a thread goes to sleep: about 100 us, longer than the
 * rest of a program's work between two ticks, and much shorter than a tick in real time. */
constexpr int kLooks = 2000;

void pause() {
#if defined(__x86_64__) || defined(__i386__)
  __builtin_ia32_pause();
#endif
}

}  // namespace

StepThreads::StepThreads(int count) : shares_(count) {
  for (int i = 1; i < count; ++i) threads_.emplace_back([this, i] { work(i); });
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
  num_open_ = count;
  for (size_t i = 0; i < shares_.size(); ++i) {
    shares_[i].next_and_end.store(uint64_t{i} | static_cast<uint64_t>(count) << 32,
                                  std::memory_order_release);
  }
  ++round_;
  round_.notify_all();
  take_items(0);
  for (int looks = 0; num_open_ > 0; ++looks) {
    if (looks < kLooks) {
      pause();
    } else {
      std::this_thread::yield();
    }
  }
}

void StepThreads::take_items(size_t thread) {
  const size_t num_threads = shares_.size();
  for (size_t k = 0; k < num_threads; ++k) {
    Share& share = shares_[(thread + k) % num_threads];
    for (;;) {
      // A thread that was not scheduled for a while may come here in a later round. Then it takes
      // part in that one, whose call this word's store came after.
      const uint64_t taken = share.next_and_end.fetch_add(num_threads, std::memory_order_acq_rel);
      const auto item = static_cast<uint32_t>(taken);
      if (item >= taken >> 32) break;
      call_(context_, static_cast<int>(item));
      num_open_.fetch_sub(1, std::memory_order_acq_rel);
    }
  }
}

void StepThreads::work(size_t thread) {
  for (;;) {
    const unsigned seen = round_;
    if (is_ending_) return;
    take_items(thread);
    for (int looks = 0; round_ == seen && looks < kLooks; ++looks) pause();
    round_.wait(seen);
  }
}

}  // namespace nao::sim

#include "tools/tuning/mpi_evaluator.h"

#include <fmt/core.h>
#include <mpi.h>

#include <chrono>
#include <cstdint>
#include <optional>
#include <thread>
#include <utility>

#include "common/error.h"
#include "common/text_file.h"
#include "tools/tuning/task_batch.h"
#include "tools/tuning/task_codec.h"

namespace nao {
namespace {

// Interval at which a process looks for messages. Chosen: a thousandth of a second is short
// compared with a trial, which takes a tenth of a second and more, and costs 1 % of a core.
constexpr auto kPollInterval = std::chrono::milliseconds(1);

enum Tag { kTask = 1, kOutcome = 2, kEnd = 3 };

struct Message {
  int rank = 0;
  int tag = 0;
  Bytes bytes;
};

void send(int rank, Tag tag, const Bytes& bytes) {
  MPI_Send(bytes.data(), static_cast<int>(bytes.size()), MPI_BYTE, rank, tag, MPI_COMM_WORLD);
}

// The next message from any process, without waiting for one.
std::optional<Message> receive() {
  int is_there = 0;
  MPI_Status status;
  MPI_Iprobe(MPI_ANY_SOURCE, MPI_ANY_TAG, MPI_COMM_WORLD, &is_there, &status);
  if (is_there == 0) return std::nullopt;
  int size = 0;
  MPI_Get_count(&status, MPI_BYTE, &size);
  Message message;
  message.rank = status.MPI_SOURCE;
  message.tag = status.MPI_TAG;
  message.bytes.resize(static_cast<size_t>(size));
  MPI_Recv(message.bytes.data(), size, MPI_BYTE, message.rank, message.tag, MPI_COMM_WORLD,
           MPI_STATUS_IGNORE);
  return message;
}

}  // namespace

MpiEvaluator::MpiEvaluator(int num_threads, const std::string& identity, RunTask run)
    : threads_(num_threads, std::move(run)) {
  int provided = 0;
  // FUNNELED: only this thread calls MPI; worker threads never do.
  MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &provided);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
  MPI_Comm_size(MPI_COMM_WORLD, &num_processes_);
  gather_slots(identity);
}

void MpiEvaluator::gather_slots(const std::string& identity) {
  // Threads of each process and a digest of its settings: processes with other files would give
  // other results for the same task.
  const uint64_t own[2] = {static_cast<uint64_t>(threads_.count()), digest(identity)};
  std::vector<uint64_t> all(2 * static_cast<size_t>(num_processes_));
  MPI_Gather(own, 2, MPI_UINT64_T, all.data(), 2, MPI_UINT64_T, 0, MPI_COMM_WORLD);
  if (!is_first()) return;
  for (size_t rank = 0; rank < static_cast<size_t>(num_processes_); ++rank) {
    slots_.push_back(static_cast<int>(all[2 * rank]));
    if (all[2 * rank + 1] == own[1]) continue;
    // The destructor does not run after an exception here.
    end_processes();
    throw Error(
        fmt::format("process {} of {} has other options or other robot files than process 0: "
                    "install the same files on all machines",
                    rank, num_processes_));
  }
}

MpiEvaluator::~MpiEvaluator() {
  end_processes();
}

void MpiEvaluator::end_processes() {
  if (is_first()) {
    for (int rank = 1; rank < num_processes_; ++rank) send(rank, kEnd, {});
  }
  MPI_Finalize();
}

// Loop of all processes except the first, until kEnd comes.
void MpiEvaluator::serve() {
  for (;;) {
    while (const auto outcome = threads_.poll()) send(0, kOutcome, encode(*outcome));
    const auto message = receive();
    if (!message) {
      std::this_thread::sleep_for(kPollInterval);
    } else if (message->tag == kTask) {
      threads_.submit(decode<IndexedTask>(message->bytes));
    } else {
      return;
    }
  }
}

int MpiEvaluator::num_workers() const {
  int sum = 0;
  for (int slots : slots_) sum += slots;
  return sum;
}

std::vector<Outcome> MpiEvaluator::evaluate(const std::vector<Task>& tasks) {
  TaskBatch batch(tasks.size(), slots_);
  while (!batch.is_done()) {
    // Other processes come first: while messages travel, this one's threads still run.
    for (size_t rank = slots_.size(); rank-- > 0;) {
      while (const auto index = batch.assign(rank)) {
        const IndexedTask task = {*index, tasks[*index]};
        if (rank == 0) {
          threads_.submit(task);
        } else {
          send(static_cast<int>(rank), kTask, encode(task));
        }
      }
    }
    const auto message = receive();
    if (message) batch.finish(static_cast<size_t>(message->rank), decode<Outcome>(message->bytes));
    const auto outcome = threads_.poll();
    if (outcome) batch.finish(0, *outcome);
    if (!message && !outcome) std::this_thread::sleep_for(kPollInterval);
  }
  return batch.take();
}

}  // namespace nao

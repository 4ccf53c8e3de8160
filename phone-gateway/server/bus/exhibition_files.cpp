#include "phone-gateway/server/bus/exhibition_files.h"

#include <filesystem>
#include <utility>

#include "common/error.h"
#include "common/logger.h"
#include "common/output_file.h"
#include "common/text_file.h"
#include "phone-gateway/server/exhibition/queue_file.h"

namespace nao::gateway {
namespace {

/** Period of writing times, s. Chosen: what a waiting visitor is told is less than 15 s wrong after
 * a restart. */
constexpr double kTimesPeriod = 5;

/** Who drives and waits, and whether. */
std::string describe_order(const QueueState& state) {
  std::string text = state.driver ? state.driver->key : "";
  for (const Visitor& visitor : state.waiting) text += " " + visitor.key;
  text += state.is_paused ? " paused" : "";
  return text + (state.is_resting ? " rests" : "");
}

}  // namespace

QueueState ExhibitionFiles::read() const {
  if (state_file_.empty() || !std::filesystem::exists(state_file_)) return {};
  try {
    return read_queue_state(read_file(state_file_));
  } catch (const Error& error) {
    logger::warn("{} is not used, the queue begins empty: {}", state_file_, error.what());
    return {};
  }
}

void ExhibitionFiles::write(const QueueState& state, double now) {
  std::string order = describe_order(state);
  if (order == last_order_ && now - last_write_ < kTimesPeriod) return;
  last_order_ = std::move(order);
  last_write_ = now;
  write_all(state);
}

void ExhibitionFiles::write_all(const QueueState& state) {
  try {
    if (!state_file_.empty()) replace_file(state_file_, write_queue_state(state));
    if (!report_file_.empty()) replace_file(report_file_, write_exhibition_report(state));
  } catch (const Error& error) {
    // The exhibition goes on; a restart would forget the queue.
    logger::warn("{}", error.what());
  }
}

}  // namespace nao::gateway

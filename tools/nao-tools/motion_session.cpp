#include "tools/nao-tools/motion_session.h"

#include <unistd.h>

#include <naolcm/command_result_t.hpp>
#include <naolcm/motion_state_t.hpp>
#include <utility>

#include "common/wall_clock.h"

namespace nao {
namespace {

/** Period of looking for what to send, s: two control periods. */
constexpr double kSessionPeriod = 0.02;

}  // namespace

MotionSession::MotionSession(const CommonOptions& common, const std::string& program)
    : source_(program + "." + std::to_string(getpid())),
      bus_(common.lcm_url),
      channels_(common.robot),
      commands_(bus_, channels_) {
  loop_.on_readable(bus_.descriptor(), [this] { bus_.handle(); });
  bus_.subscribe<naolcm::command_result_t>(
      channels_.command_result, Bus::Queue::kAll, [this](const auto& result) {
        const bool is_own = result.source == source_ && result.command_id == command_.id;
        if (!exchange_ || !is_own) return;
        exchange_->handle_result(static_cast<ResultStatus>(result.status), result.reason,
                                 monotonic_seconds());
      });
  bus_.subscribe<naolcm::motion_state_t>(channels_.motion_state, Bus::Queue::kLatest,
                                         [this](const naolcm::motion_state_t&) {
                                           if (exchange_)
                                             exchange_->handle_sign_of_life(monotonic_seconds());
                                         });
}

std::string MotionSession::execute(Steps steps) {
  steps_ = std::move(steps);
  loop_.every(kSessionPeriod, [this] { step(); });
  const std::string reason = loop_.run();
  return reason == "end" ? fault_ : "stopped by " + reason;
}

void MotionSession::fail(const std::string& fault) {
  fault_ = fault;
  loop_.stop("end");
}

void MotionSession::step() {
  const double now = monotonic_seconds();
  if (!exchange_) {
    if (auto request = steps_.next()) {
      command_ = {source_, wall_utime(), std::move(*request)};
      exchange_.emplace("nao-motion", now);
    }
  }
  if (exchange_) {
    if (exchange_->should_send(now)) commands_.publish(command_);
    if (const auto outcome = exchange_->outcome(now)) {
      exchange_.reset();
      if (outcome->status == "unanswered" || outcome->status == "silent") {
        return fail(outcome->reason);
      }
      steps_.end(outcome->is_success ? "" : outcome->status + ": " + outcome->reason);
    }
  }
  if (steps_.is_done()) loop_.stop("end");
}

}  // namespace nao

#include "viewer/message_store.h"

#include "common/bus.h"

namespace nao::viewer {
namespace {

/** Limits of what is stored. Chosen: far above normal use; they bound the memory if a program on
 * the bus misbehaves. */
constexpr size_t kMaxResults = 100;
constexpr size_t kMaxPrograms = 50;
constexpr size_t kMaxChannels = 200;

template <class Message>
bool decode(const uint8_t* data, int num_bytes, double time,
            std::optional<Received<Message>>& place) {
  Received<Message> received;
  if (!decode_message({data, static_cast<size_t>(num_bytes)}, received.message)) return false;
  received.time = time;
  place = std::move(received);
  return true;
}

}  // namespace

bool MessageStore::receive(const std::string& channel, const uint8_t* data, int num_bytes,
                           double time) {
  // The last message of each channel, not decoded, for the plots.
  if (raw_.size() < kMaxChannels || raw_.count(channel) > 0) {
    raw_[channel].assign(data, data + num_bytes);
  }
  if (channel == channels_.robot_state) return decode(data, num_bytes, time, robot_state_);
  if (channel == channels_.body_state) return decode(data, num_bytes, time, body_state_);
  if (channel == channels_.motion_state) return decode(data, num_bytes, time, motion_state_);
  if (channel == kWorldTruthChannel) return decode(data, num_bytes, time, truth_);
  if (channel == channels_.head_camera_image) return decode(data, num_bytes, time, image_);
  if (channel == channels_.command_result) return receive_result(data, num_bytes, time);
  if (channel == kDaemonStatusChannel) return receive_status(data, num_bytes, time);
  return true;
}

bool MessageStore::receive_result(const uint8_t* data, int num_bytes, double time) {
  std::optional<Received<naolcm::command_result_t>> result;
  if (!decode(data, num_bytes, time, result)) return false;
  // Results are repeated, and each message of a walk gets the same result: only the last is kept.
  const auto is_repeated = [&](const Received<naolcm::command_result_t>& known) {
    return known.message.source == result->message.source &&
           known.message.command_id == result->message.command_id &&
           known.message.status == result->message.status;
  };
  std::erase_if(results_, is_repeated);
  results_.push_back(*result);
  if (results_.size() > kMaxResults) results_.pop_front();
  return true;
}

bool MessageStore::receive_status(const uint8_t* data, int num_bytes, double time) {
  std::optional<Received<naolcm::daemon_status_t>> status;
  if (!decode(data, num_bytes, time, status)) return false;
  // Two processes of one program are two entries.
  const std::string key =
      status->message.program + " " + std::to_string(status->message.process_id);
  if (programs_.size() < kMaxPrograms || programs_.count(key) > 0) programs_[key] = *status;
  return true;
}

void MessageStore::clear() {
  robot_state_.reset();
  body_state_.reset();
  motion_state_.reset();
  truth_.reset();
  image_.reset();
  results_.clear();
  programs_.clear();
  raw_.clear();
}

}  // namespace nao::viewer

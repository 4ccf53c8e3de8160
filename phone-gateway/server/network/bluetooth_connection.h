#pragma once

#include <algorithm>
#include <boost/asio/post.hpp>
#include <deque>
#include <functional>
#include <string>
#include <string_view>
#include <utility>

#include "common/wall_clock.h"
#include "phone-gateway/bluetooth/bluez_service.h"
#include "phone-gateway/bluetooth/fragments.h"
#include "phone-gateway/protocol/framing.h"
#include "phone-gateway/server/network/client_connection.h"
#include "phone-gateway/server/network/round_trip.h"

namespace nao::gateway {

/** A phone by Bluetooth: messages in fragments. */
class BluetoothConnection : public ClientConnection {
 public:
  /** @param phone  Its device's path. @param value_bytes  Longest value. @param ended  Called once.
   */
  BluetoothConnection(ConnectionContext& context, BluezService& service, std::string phone,
                      size_t value_bytes, std::function<void()> ended)
      : ClientConnection(context),
        service_(service),
        phone_(std::move(phone)),
        reader_(kMaxRequestBytes),
        writer_(value_bytes),
        ended_(std::move(ended)) {}

  /** Opens its session. */
  void start() { open({address_of(phone_), "bluetooth"}); }
  const std::string& phone() const { return phone_; }

  /** It has written a value. */
  void on_value(std::string_view value) {
    if (is_over_) return;
    switch (reader_.read(value)) {
      case FragmentReader::Result::kIncomplete:
        break;
      case FragmentReader::Result::kMessage:
        waiting_.push_back(reader_.take_message());
        if (waiting_.size() > kMaxWaiting) return end("does not keep to its request rate");
        if (!is_paused_) read_waiting();
        break;
      case FragmentReader::Result::kAcknowledgement:
        if (!writer_.acknowledge(reader_.awaited())) return end("wrong acknowledgement");
        round_trip_.acknowledged(writer_.num_acknowledged(), monotonic_seconds());
        send_fragments();
        break;
      case FragmentReader::Result::kFault:
        end("wrong fragment");
    }
  }

  /** Ends it. @param why  For the audit log. */
  void end(const std::string& why) {
    if (!is_over_) abort(why);
  }

 private:
  /** Messages that wait while a phone is above its request rate. Chosen: half a second of them. */
  static constexpr size_t kMaxWaiting = 64;

  /** "/org/bluez/hci0/dev_01_23..." -> "01:23...". */
  static std::string address_of(std::string path) {
    const size_t begin = path.rfind("dev_");
    if (begin != std::string::npos) path.erase(0, begin + 4);
    std::replace(path.begin(), path.end(), '_', ':');
    return path;
  }

  void read_waiting() {
    is_paused_ = false;
    while (!waiting_.empty() && !is_paused_ && !is_closing() && !is_over_) {
      const std::string message = std::exchange(waiting_.front(), {});
      waiting_.pop_front();
      is_paused_ = !receive(message);
    }
  }

  void resume_reading() override { read_waiting(); }

  bool write(MessageBytes message) override {
    writer_.put(*message);
    is_writing_ = true;
    send_fragments();
    return false;
  }

  void send_fragments() {
    while (const auto fragment = writer_.next()) {
      round_trip_.sent(writer_.num_made() - 1, monotonic_seconds());
      service_.notify(*fragment);
    }
    if (!writer_.is_sent() || !std::exchange(is_writing_, false)) return;
    // Not at once: it calls write() for the next message.
    asio::post(context_.io, [self = shared_from_this(), this] { on_written(is_over_); });
  }

  void shut_down() override { abort("closed by the gateway"); }

  LinkMeasurement measure() override { return {round_trip_.mean(), round_trip_.least(), 0}; }
  size_t unacknowledged() override { return writer_.unacknowledged(); }

  void close_socket() override {
    if (std::exchange(is_over_, true)) return;
    service_.notify(kConnectionEnd);
    ended_();
  }

  BluezService& service_;
  std::string phone_;
  FragmentReader reader_;
  FragmentWriter writer_;
  std::function<void()> ended_;
  RoundTrip round_trip_;
  std::deque<std::string> waiting_;
  bool is_paused_ = false;
  bool is_writing_ = false;
  bool is_over_ = false;
};

}  // namespace nao::gateway

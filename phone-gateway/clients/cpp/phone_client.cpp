#include "phone-gateway/clients/cpp/phone_client.h"

#include <algorithm>
#include <utility>

#include "common/wall_clock.h"

namespace nao {
namespace {

using naoremote::Notice;
using naoremote::Request;
using naoremote::Response;

/** s; see PROTOCOL.md. */
constexpr double kPingPeriod = 1;
/** Results and answers that are stored until they are taken. Chosen: more than a program has under
 * way, to bound memory. */
constexpr size_t kMaxResults = 64;
constexpr size_t kMaxResponses = 256;

naoremote::ServerMessage parse(const std::string& bytes) {
  naoremote::ServerMessage message;
  if (!message.ParseFromString(bytes))
    throw ConnectionError("the gateway sent a message that is no ServerMessage");
  return message;
}

}  // namespace

PhoneClient::PhoneClient(const Options& options, Handlers handlers)
    : options_(options),
      handlers_(std::move(handlers)),
      socket_(options.host, options.port, options.timeout) {
  // Connect is the first request; the gateway closes the connection after a refusal.
  Request hello;
  hello.mutable_connect()->set_protocol_version(kProtocolVersion);
  hello.mutable_connect()->set_token(options_.token);
  hello.mutable_connect()->set_client_name(options_.name);
  hello.mutable_connect()->set_client_software(options_.software);
  hello.mutable_connect()->set_robot(options_.robot);
  const Response response = request(hello);
  if (response.error() != naoremote::OK) throw RefusedError(response.error(), response.message());
  connected_ = response.connected();
}

uint32_t PhoneClient::send(Request request) {
  request.set_request_id(++last_request_id_);
  request.set_sent_at(monotonic_seconds());
  socket_.send(request.SerializeAsString());
  last_sent_ = monotonic_seconds();
  return last_request_id_;
}

Response PhoneClient::request(Request request) {
  const uint32_t id = send(std::move(request));
  std::optional<Response> response;
  // Notices, states and images that come before the answer go to their handlers.
  run_until([&] { return (response = take_response(id)).has_value(); }, options_.timeout);
  if (!response) throw ConnectionError("the gateway does not answer");
  return *std::move(response);
}

std::optional<Response> PhoneClient::take_response(uint32_t request_id) {
  auto node = responses_.extract(request_id);
  if (node.empty()) return std::nullopt;
  return std::move(node.mapped());
}

void PhoneClient::handle_one(double timeout) {
  const double now = monotonic_seconds();
  // Within the gateway's silence timeout something must be sent.
  if (now - last_sent_ >= kPingPeriod && connected_.client_id() != 0) {
    Request ping;
    ping.mutable_ping()->set_client_utime(static_cast<uint64_t>(wall_utime()));
    own_ping_ = send(ping);
  }
  const auto bytes = socket_.receive(std::min(timeout, kPingPeriod));
  if (!bytes) return;
  const naoremote::ServerMessage message = parse(*bytes);
  if (message.has_response()) {
    // Nobody waits for the answers to own pings.
    if (message.response().request_id() == own_ping_) return;
    responses_[message.response().request_id()] = message.response();
    if (responses_.size() > kMaxResponses) responses_.erase(responses_.begin());
  } else if (message.has_state()) {
    if (handlers_.on_state) handlers_.on_state(message.state());
  } else if (message.has_image()) {
    if (handlers_.on_image) handlers_.on_image(message.image());
  } else if (message.has_notice()) {
    handle_notice(message.notice());
  }
}

void PhoneClient::handle_notice(const Notice& notice) {
  if (notice.kind() == Notice::COMMAND_RESULT && notice.status() != Notice::ACCEPTED) {
    results_.push_back(notice);
    if (results_.size() > kMaxResults) results_.erase(results_.begin());
  } else if (notice.kind() == Notice::ROBOT_CHANGED) {
    *connected_.mutable_robot() = notice.robot();
  } else if (notice.kind() == Notice::ROBOTS_CHANGED) {
    *connected_.mutable_robots() = notice.robots();
  }
  if (handlers_.on_notice) handlers_.on_notice(notice);
}

bool PhoneClient::run_until(const std::function<bool()>& is_done, double timeout) {
  const double deadline = monotonic_seconds() + timeout;
  while (!is_done()) {
    const double left = deadline - monotonic_seconds();
    if (left <= 0) return false;
    handle_one(left);
  }
  return true;
}

void PhoneClient::run_for(double time) {
  run_until([] { return false; }, time);
}

std::optional<Notice> PhoneClient::wait_for_result(uint32_t request_id, double timeout) {
  const auto is_wanted = [&](const Notice& notice) { return notice.request_id() == request_id; };
  std::optional<Notice> result;
  run_until(
      [&] {
        const auto found = std::find_if(results_.begin(), results_.end(), is_wanted);
        if (found == results_.end()) return false;
        result = *found;
        return true;
      },
      timeout);
  return result;
}

Response PhoneClient::request_robot(Request request, const std::string& robot) {
  Response response = this->request(std::move(request));
  if (response.error() != naoremote::OK || robot.empty()) return response;
  if (!run_until([&] { return this->robot().name() == robot; }, options_.timeout)) {
    throw ConnectionError("the gateway does not describe the robot " + robot);
  }
  return response;
}

Response PhoneClient::take_control(const std::string& robot) {
  Request request;
  request.mutable_take_control()->set_robot(robot);
  return request_robot(std::move(request), robot);
}

Response PhoneClient::watch_robot(const std::string& robot) {
  Request request;
  request.mutable_watch_robot()->set_robot(robot);
  return request_robot(std::move(request), robot);
}

Response PhoneClient::release_control() {
  Request request;
  request.mutable_release_control();
  return this->request(request);
}

Response PhoneClient::get_state(bool with_image, const std::string& camera) {
  Request request;
  request.mutable_get_state()->set_with_image(with_image);
  if (!camera.empty()) request.mutable_get_state()->mutable_image()->set_camera(camera);
  return this->request(request);
}

Response PhoneClient::subscribe(double state_rate, double image_rate) {
  Request request;
  request.mutable_subscribe()->set_state_rate(state_rate);
  request.mutable_subscribe()->set_image_rate(image_rate);
  return this->request(request);
}

Response PhoneClient::walk_turn(double vx, double vy, double wz) {
  Request request;
  request.mutable_walk_turn()->set_vx(vx);
  request.mutable_walk_turn()->set_vy(vy);
  request.mutable_walk_turn()->set_wz(wz);
  return this->request(request);
}

Response PhoneClient::move_to(double x, double y, double theta) {
  Request request;
  request.mutable_move_to()->set_x(x);
  request.mutable_move_to()->set_y(y);
  request.mutable_move_to()->set_theta(theta);
  return this->request(request);
}

Response PhoneClient::go_to_posture(const std::string& posture, double speed) {
  Request request;
  request.mutable_go_to_posture()->set_posture(posture);
  request.mutable_go_to_posture()->set_speed(speed);
  return this->request(request);
}

Response PhoneClient::change_joints(const std::string& group, double yaw, double pitch, double roll,
                                    double speed) {
  Request request;
  naoremote::ChangeJoints& change = *request.mutable_change_joints();
  change.set_group(group);
  change.set_yaw(yaw);
  change.set_pitch(pitch);
  change.set_roll(roll);
  change.set_speed(speed);
  return this->request(request);
}

Response PhoneClient::do_action(const std::string& action) {
  Request request;
  request.mutable_do_action()->set_action(action);
  return this->request(request);
}

Response PhoneClient::stop() {
  Request request;
  request.mutable_stop();
  return this->request(request);
}

Response PhoneClient::ping() {
  Request request;
  request.mutable_ping()->set_client_utime(static_cast<uint64_t>(wall_utime()));
  return this->request(request);
}

Response operate(const std::string& host, uint16_t port, naoremote::Operate::Operation operation,
                 uint32_t client_id, const std::string& robot) {
  // A connection of its own, without Connect: operators are recognized by their address.
  constexpr double kTimeout = 5;  // s, chosen: the gateway on this host answers in milliseconds
  MessageSocket socket(host, port, kTimeout);
  Request request;
  request.set_request_id(1);
  request.mutable_operate()->set_operation(operation);
  request.mutable_operate()->set_client_id(client_id);
  request.mutable_operate()->set_robot(robot);
  socket.send(request.SerializeAsString());
  const auto answer = socket.receive(kTimeout);
  if (!answer) throw ConnectionError("the gateway does not answer");
  return parse(*answer).response();
}

}  // namespace nao

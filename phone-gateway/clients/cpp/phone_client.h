#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "phone-gateway/clients/cpp/message_socket.h"
#include "remote.pb.h"

namespace nao {

/** The gateway refused a Connect; the text is its reason. */
struct RefusedError : Error {
  RefusedError(naoremote::ErrorCode error_code, const std::string& message)
      : Error(message), code(error_code) {}
  naoremote::ErrorCode code;
};

/** A client of nao-phone-gateway: one connection over raw TCP.
 *
 * Blocking, without a thread of its own: messages are handled, and pings sent, inside the calls
 * that wait; call one of them at least every 4 s. Not thread-safe. */
class PhoneClient {
 public:
  struct Options {
    std::string host = "127.0.0.1";
    uint16_t port = 7668;
    /** From the gateway's URL; may be empty on its own host. */
    std::string token;
    /** Name that other clients see; empty: the gateway chooses one. */
    std::string name;
    std::string software = "nao_phone_client";
    /** Robot to watch, of a gateway of several; empty: the gateway chooses. */
    std::string robot = {};
    /** For connecting and for each answer, s. */
    double timeout = 5;
  };

  /** Handlers of states, images and notices, called inside the calls that wait. May be empty. */
  struct Handlers {
    std::function<void(const naoremote::State&)> on_state;
    std::function<void(const naoremote::Image&)> on_image;
    std::function<void(const naoremote::Notice&)> on_notice;
  };

  /** Connects.
   * @throws ConnectionError  if there is no gateway.
   * @throws RefusedError     if it refuses the client. */
  explicit PhoneClient(const Options& options, Handlers handlers = {});

  /** The gateway's answer to Connect, with the description of the robot that is watched now, and
   * the list of robots as it is now. */
  const naoremote::Connected& connected() const { return connected_; }
  const naoremote::RobotDescription& robot() const { return connected_.robot(); }

  /** Sends a request and waits for its answer.
   * @param request  Its request_id is set here.
   * @throws ConnectionError  if the connection closes, or the answer does not arrive in time. */
  naoremote::Response request(naoremote::Request request);

  /** Sends a request without waiting; its answer is stored for take_response().
   * @return Its request_id. */
  uint32_t send(naoremote::Request request);

  /** @return The answer to a request sent with send(); nothing until it has arrived. */
  [[nodiscard]] std::optional<naoremote::Response> take_response(uint32_t request_id);

  /** Handles messages for `time` s, and sends a Ping after 1 s without another request.
   * @throws ConnectionError  if the connection closes. */
  void run_for(double time);

  /** Handles messages until `is_done()`. @return false after the timeout, s. */
  bool run_until(const std::function<bool()>& is_done, double timeout);

  /** Waits for the final result of a command: DONE, REFUSED, INTERRUPTED or FAILED.
   * @return Nothing after the timeout, s. */
  std::optional<naoremote::Notice> wait_for_result(uint32_t request_id, double timeout);

  // The use cases; each function waits for the answer. Units as in remote.proto.
  /** @param robot  Watches this one of several robots from now on; empty: none other. */
  naoremote::Response take_control(const std::string& robot = "");
  /** Watches another robot; robot() is that one when this returns. */
  naoremote::Response watch_robot(const std::string& robot);
  naoremote::Response release_control();
  /** @param camera  Of the image; empty: the robot's first one. */
  naoremote::Response get_state(bool with_image, const std::string& camera = "");
  naoremote::Response subscribe(double state_rate, double image_rate);
  naoremote::Response walk_turn(double vx, double vy, double wz);
  naoremote::Response move_to(double x, double y, double theta);
  naoremote::Response go_to_posture(const std::string& posture, double speed = 0);
  naoremote::Response change_joints(const std::string& group, double yaw, double pitch, double roll,
                                    double speed = 0);
  naoremote::Response do_action(const std::string& action);
  naoremote::Response stop();
  naoremote::Response ping();

 private:
  /** Sends a request that may change the robot, and waits until robot() is the one that is named.
   */
  naoremote::Response request_robot(naoremote::Request request, const std::string& robot);
  /** Handles one message, if one arrives within `timeout` s. */
  void handle_one(double timeout);
  void handle_notice(const naoremote::Notice& notice);

  Options options_;
  Handlers handlers_;
  MessageSocket socket_;
  naoremote::Connected connected_;
  uint32_t last_request_id_ = 0;
  double last_sent_ = 0;
  std::map<uint32_t, naoremote::Response> responses_;
  /** Latest final results of commands, oldest first. */
  std::vector<naoremote::Notice> results_;
  /** Id of the last Ping that the client sent by itself; its answer is dropped. */
  uint32_t own_ping_ = 0;
};

/** Executes one operation of the operator's console, without Connect. Works on the gateway's own
 * host only. @param robot  Name of a robot, see Operate in remote.proto. @throws ConnectionError if
 * there is no gateway. */
naoremote::Response operate(const std::string& host, uint16_t port,
                            naoremote::Operate::Operation operation, uint32_t client_id = 0,
                            const std::string& robot = "");

}  // namespace nao

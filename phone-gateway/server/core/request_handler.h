#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "phone-gateway/server/core/admission.h"
#include "phone-gateway/server/core/component_monitor.h"
#include "phone-gateway/server/core/driving.h"
#include "phone-gateway/server/core/gateway_limits.h"
#include "phone-gateway/server/core/gateway_reasons.h"
#include "phone-gateway/server/core/sessions.h"
#include "phone-gateway/server/core/streams.h"

namespace nao::gateway {

/** Answers the requests of the clients: one function for each use case of remote.proto. */
class RequestHandler {
 public:
  /** The objects that requests act on. They must outlive the handler. */
  struct Objects {
    Sessions& sessions;
    const ComponentMonitor& components;
    Driving& driving;
    Streams& streams;
  };

  RequestHandler(const GatewayLimits& limits, naoremote::RobotDescription robot,
                 std::string server_version, const std::string& token, const Objects& objects)
      : limits_(limits),
        robot_(std::move(robot)),
        server_version_(std::move(server_version)),
        objects_(objects),
        admission_(limits, token) {}

  /** Executes a request. @param response  Gets the answer; its request_id is set already. */
  void handle(ClientSession& session, const naoremote::Request& request,
              naoremote::Response& response, double now);

 private:
  /** As handle(), but returns the refusal instead of writing it into the response. */
  std::optional<Refusal> execute(ClientSession& session, const naoremote::Request& request,
                                 naoremote::Response& response, double now);
  std::optional<Refusal> connect(ClientSession& session, const naoremote::Connect& request,
                                 naoremote::Response& response, double now);
  std::optional<Refusal> get_state(ClientSession& session, const naoremote::GetState& request,
                                   naoremote::Response& response, double now);
  std::optional<Refusal> subscribe(ClientSession& session, const naoremote::Subscribe& request);
  std::optional<Refusal> operate(ClientSession& session, const naoremote::Operate& request,
                                 naoremote::Response& response, double now);
  void list_clients(naoremote::Clients& clients) const;
  void ping(const naoremote::Ping& request, naoremote::Pong& pong, double now) const;

  GatewayLimits limits_;
  naoremote::RobotDescription robot_;
  std::string server_version_;
  Objects objects_;
  Admission admission_;
};

/** Notice that a component has become available or unavailable. */
naoremote::ServerMessage make_component_notice(const ComponentMonitor::Change& change);

}  // namespace nao::gateway

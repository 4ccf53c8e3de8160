#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "phone-gateway/server/core/admission.h"
#include "phone-gateway/server/core/exhibition_desk.h"
#include "phone-gateway/server/core/gateway_limits.h"
#include "phone-gateway/server/core/gateway_reasons.h"
#include "phone-gateway/server/core/match_board.h"
#include "phone-gateway/server/core/operator_console.h"
#include "phone-gateway/server/core/robots.h"
#include "phone-gateway/server/core/sessions.h"

namespace nao::gateway {

/** Answers the requests of the clients: one function for each use case of remote.proto. */
class RequestHandler {
 public:
  /** `sessions` and `robots` must outlive this. */
  RequestHandler(const GatewayLimits& limits, std::string server_version, const std::string& token,
                 Sessions& sessions, Robots& robots, const MatchBoard& match)
      : limits_(limits),
        server_version_(std::move(server_version)),
        sessions_(sessions),
        robots_(robots),
        match_(match),
        console_(sessions, robots),
        admission_(limits, token) {}

  /** Visitors drive in turn from now on. `exhibition` must outlive this. */
  void set_exhibition(ExhibitionDesk* exhibition) { exhibition_ = exhibition; }

  /** Executes a request. @param response  Gets the answer; its request_id is set already.
   * @return Whether it is answered now; otherwise MotionLibrary answers later. */
  bool handle(ClientSession& session, const naoremote::Request& request,
              naoremote::Response& response, double now);

 private:
  /** As handle(), but returns the refusal instead of writing it into the response, and sets
   * is_answered_later_. */
  std::optional<Refusal> execute(ClientSession& session, const naoremote::Request& request,
                                 naoremote::Response& response, double now);
  /** Requests about taught motions. */
  std::optional<Refusal> execute_motion_request(ClientSession& session,
                                                const naoremote::Request& request,
                                                naoremote::Response& response, double now);
  std::optional<Refusal> pass_on(ClientSession& session, uint32_t request_id,
                                 MotionFileCommand command, double now);
  std::optional<Refusal> drag(ClientSession& session, const naoremote::Drag& request, double now);
  std::optional<Refusal> connect(ClientSession& session, const naoremote::Connect& request,
                                 naoremote::Response& response, double now);
  std::optional<Refusal> join(ClientSession& session, const naoremote::Join& request, double now);
  std::optional<Refusal> get_state(ClientSession& session, const naoremote::GetState& request,
                                   naoremote::Response& response, double now);
  std::optional<Refusal> subscribe(ClientSession& session, const naoremote::Subscribe& request);
  /** Requests about control and about the robot that is watched. */
  std::optional<Refusal> execute_control_request(ClientSession& session,
                                                 const naoremote::Request& request,
                                                 naoremote::Response& response, double now);
  std::optional<Refusal> take_control(ClientSession& session, const naoremote::TakeControl& request,
                                      naoremote::Response& response, double now);
  /** Requests about the exhibition. */
  std::optional<Refusal> execute_exhibition_request(ClientSession& session,
                                                    const naoremote::Request& request,
                                                    naoremote::Response& response, double now);
  void ping(const ClientSession& session, const naoremote::Ping& request, naoremote::Pong& pong,
            double now);

  GatewayLimits limits_;
  std::string server_version_;
  Sessions& sessions_;
  Robots& robots_;
  const MatchBoard& match_;
  OperatorConsole console_;
  Admission admission_;
  /** nullptr: there is none. */
  ExhibitionDesk* exhibition_ = nullptr;
  bool is_answered_later_ = false;
};

}  // namespace nao::gateway

#pragma once

#include <map>
#include <optional>
#include <string>

#include "phone-gateway/server/core/attraction.h"
#include "phone-gateway/server/core/gateway_reasons.h"
#include "phone-gateway/server/core/gateway_robot.h"
#include "phone-gateway/server/core/sessions.h"
#include "phone-gateway/server/core/visitor_rules.h"
#include "phone-gateway/server/exhibition/exhibition_settings.h"
#include "phone-gateway/server/exhibition/visitor_queue.h"

namespace nao::gateway {

/** An exhibition, as it is set up. */
struct ExhibitionSetup {
  ExhibitionSettings settings;
  /** Secret of the operator's page. */
  std::string secret;
  /** State of the run before. */
  QueueState state;
};

/** Lets the visitors of an exhibition drive one after the other, in place of the free choice of a
 * driver: control of the robot follows the queue. */
class ExhibitionDesk {
 public:
  /** The other objects must outlive this. */
  ExhibitionDesk(ExhibitionSetup setup, Sessions& sessions, GatewayRobot& robot);
  // The driving has a reference to this.
  ExhibitionDesk(const ExhibitionDesk&) = delete;
  ExhibitionDesk& operator=(const ExhibitionDesk&) = delete;

  // Requests. Each returns why it is refused, or nothing.

  [[nodiscard]] std::optional<Refusal> attend(ClientSession& session,
                                              const naoremote::Attend& request);
  /** A wrong secret closes the connection. */
  [[nodiscard]] std::optional<Refusal> run(ClientSession& session,
                                           const naoremote::RunExhibition& request, double now);
  /** Whether a client may send this. @param is_motion  It sets the robot in motion: the driver is
   * not idle. */
  [[nodiscard]] std::optional<Refusal> check(const ClientSession& session,
                                             const naoremote::Request& request, bool is_motion);
  /** The driver's turn ends, if that is what its ReleaseControl asks for. */
  void release(const ClientSession& session);

  double volume() const { return state().choices.volume; }
  void handle_disconnect(const ClientSession& session);
  void step(double now);
  naoremote::Exhibition describe(const ClientSession& session) const;
  const QueueState& state() const { return queue_.state(); }

 private:
  /** The phone of a session; empty: it is no visitor's. */
  std::string key_of(uint32_t session) const;
  void let_drive(double now);
  void watch_robot(double now);
  void watch_challenge();
  void set_resting(bool is_resting, double now);
  void set_lights(uint32_t rgb, double now);
  void tell();

  const ExhibitionSettings settings_;
  const std::string secret_;
  Sessions& sessions_;
  GatewayRobot& robot_;
  VisitorQueue queue_;
  VisitorRules rules_;
  Challenge challenge_;
  Attraction attraction_;
  /** Newest session of each phone. */
  std::map<std::string, uint32_t> phones_;
  /** What each client was told last. */
  std::map<uint32_t, std::string> told_;
  double last_step_ = -1;
  double next_tell_ = 0;
  bool was_down_ = false;
  bool was_available_ = false;
  /** Heat or battery has ended the turn. */
  bool is_body_resting_ = false;
};

}  // namespace nao::gateway

#include "phone-gateway/server/core/exhibition_desk.h"

#include <algorithm>
#include <cmath>

#include "phone-gateway/server/core/driving_lease.h"
#include "phone-gateway/server/core/secret.h"

namespace nao::gateway {
namespace {

/** Period of notices to clients, s. Chosen: a countdown of seconds is right within it. */
constexpr double kTellPeriod = 0.2;
/** Nicknames that a client is told. Chosen: what a big display shows. */
constexpr int kMaxTold = 12;
constexpr size_t kMinKey = 16;
constexpr size_t kMaxKey = 64;
/** Least factor of the speed, and most that a turn is prolonged at once, s. */
constexpr double kMinSpeed = 0.1;
constexpr double kMaxMoreTime = 600;
/** Fraction of the highest speed of a posture between turns. Chosen: the gateway's own default. */
constexpr double kPostureSpeed = 0.5;

bool is_in_range(double value, double least, double most) {
  return value >= least && value <= most;
}

Refusal refuse_value(double value) {
  return {naoremote::INVALID_ARGUMENT,
          gateway_reason("exhibition-value-invalid", {to_argument(value)})};
}

/** Whether a robot with this body must rest: what is hot or empty only recovers without load. */
bool needs_rest(const std::optional<naoremote::Body>& body) {
  if (!body) return false;
  return std::any_of(body->warnings().begin(), body->warnings().end(), [](const auto& warning) {
    return warning == "battery-low" || warning == "battery-hot" || warning == "joint-hot";
  });
}

uint32_t whole_seconds(double time) {
  return static_cast<uint32_t>(std::ceil(std::max(0.0, time)));
}

}  // namespace

ExhibitionDesk::ExhibitionDesk(ExhibitionSetup setup, Sessions& sessions, GatewayRobot& robot)
    : settings_(std::move(setup.settings)),
      secret_(plain_token(setup.secret)),
      sessions_(sessions),
      robot_(robot),
      queue_(settings_.rules, settings_.nicknames, std::move(setup.state)),
      rules_(settings_, queue_.choices(), robot),
      challenge_(settings_.challenge),
      attraction_(settings_, robot) {
  robot_.driving().limit_walks(
      [this](const WalkCommand& velocity) { return rules_.limit(velocity); });
}

std::string ExhibitionDesk::key_of(uint32_t session) const {
  const auto found = std::find_if(phones_.begin(), phones_.end(),
                                  [&](const auto& phone) { return phone.second == session; });
  return found == phones_.end() ? "" : found->first;
}

std::optional<Refusal> ExhibitionDesk::attend(ClientSession& session,
                                              const naoremote::Attend& request) {
  const std::string& key = request.visitor_key();
  if (key.size() < kMinKey || key.size() > kMaxKey) {
    return Refusal{naoremote::INVALID_ARGUMENT, gateway_reason("exhibition-key-invalid")};
  }
  // One connection is one visitor's.
  const std::string before = key_of(session.id);
  if (!before.empty() && before != key) {
    return Refusal{naoremote::INVALID_ARGUMENT, gateway_reason("already-connected")};
  }
  if (request.leaves()) {
    queue_.leave(key);
    return std::nullopt;
  }
  if (!queue_.attend(key, request.again())) {
    return Refusal{naoremote::TOO_MANY_CLIENTS, gateway_reason("exhibition-full")};
  }
  phones_[key] = session.id;
  // What others see of a visitor, and what the log has.
  session.name = queue_.view(key).nickname;
  return std::nullopt;
}

std::optional<Refusal> ExhibitionDesk::run(ClientSession& session,
                                           const naoremote::RunExhibition& request, double now) {
  if (!session.endpoint.is_operator && !equals_secret(plain_token(request.secret()), secret_)) {
    Refusal refusal{naoremote::NOT_ALLOWED, gateway_reason("exhibition-secret-wrong")};
    sessions_.close(session, refusal.reason, now);
    return refusal;
  }
  if (request.has_speed() && !is_in_range(request.speed(), kMinSpeed, 1)) {
    return refuse_value(request.speed());
  }
  if (request.has_volume() && !is_in_range(request.volume(), 0, 1)) {
    return refuse_value(request.volume());
  }
  if (!is_in_range(request.more_time(), 0, kMaxMoreTime)) return refuse_value(request.more_time());
  if (request.has_light_rgb() && request.light_rgb() > 0xFFFFFF) {
    return refuse_value(request.light_rgb());
  }
  if (request.has_is_paused()) queue_.set_paused(request.is_paused());
  if (request.has_forbids_kicks()) queue_.choices().forbids_kicks = request.forbids_kicks();
  if (request.has_forbids_falls()) queue_.choices().forbids_falls = request.forbids_falls();
  if (request.has_speed()) queue_.choices().speed = request.speed();
  if (request.has_volume()) queue_.choices().volume = request.volume();
  if (request.has_light_rgb()) set_lights(request.light_rgb(), now);
  if (request.skips()) queue_.skip();
  if (request.more_time() > 0) queue_.extend(request.more_time());
  if (request.has_is_resting()) {
    is_body_resting_ = false;
    set_resting(request.is_resting(), now);
  }
  return std::nullopt;
}

std::optional<Refusal> ExhibitionDesk::check(const ClientSession& session,
                                             const naoremote::Request& request, bool is_motion) {
  if (request.has_stop()) ++queue_.counts().stops;
  if (auto refusal = rules_.check(request)) return refusal;
  const Visitor* driver = queue_.driver();
  if (is_motion && driver != nullptr && key_of(session.id) == driver->key) queue_.note_command();
  return std::nullopt;
}

void ExhibitionDesk::release(const ClientSession& session) {
  const std::string key = key_of(session.id);
  if (queue_.driver() != nullptr && queue_.driver()->key == key) queue_.leave(key);
}

void ExhibitionDesk::handle_disconnect(const ClientSession& session) {
  told_.erase(session.id);
  const std::string key = key_of(session.id);
  if (key.empty()) return;
  phones_.erase(key);
  queue_.lose(key);
}

void ExhibitionDesk::set_resting(bool is_resting, double now) {
  if (queue_.state().is_resting == is_resting) return;
  queue_.set_resting(is_resting);
  let_drive(now);
  const naoremote::RobotDescription& robot = robot_.description();
  const std::string& posture = is_resting ? robot.rest_posture() : robot.ready_posture();
  if (!posture.empty()) {
    robot_.driving().command_by_itself(PostureCommand{posture, kPostureSpeed}, now);
  }
}

void ExhibitionDesk::set_lights(uint32_t rgb, double now) {
  const LightColor color{((rgb >> 16) & 255) / 255.0, ((rgb >> 8) & 255) / 255.0,
                         (rgb & 255) / 255.0};
  LightCommand command;
  for (const naoremote::Light& light : robot_.description().lights()) {
    command.light_names.push_back(light.name());
    command.light_rgb.push_back(color);
  }
  if (!command.light_names.empty()) robot_.services().send({}, std::move(command), now);
}

void ExhibitionDesk::step(double now) {
  const double dt = last_step_ < 0 ? 0 : now - last_step_;
  last_step_ = now;
  rules_.step();
  watch_robot(now);
  // The operator at the gateway's own console drives, or the robot's programs are gone: the clock
  // stands, as in a pause.
  if (robot_.driving().driver() != kOperatorId && was_available_) queue_.step(dt);
  let_drive(now);
  watch_challenge();
  const bool is_free = !queue_.has_visitors() && !queue_.is_halted() && robot_.is_free();
  attraction_.step(is_free, volume(), now);
  if (now < next_tell_) return;
  next_tell_ = now + kTellPeriod;
  tell();
}

// Control follows the queue, however either of them has changed.
void ExhibitionDesk::let_drive(double now) {
  Driving& driving = robot_.driving();
  if (driving.driver() == kOperatorId) return;
  const Visitor* visitor = queue_.driver();
  const auto phone = visitor == nullptr ? phones_.end() : phones_.find(visitor->key);
  ClientSession* session = phone == phones_.end() ? nullptr : sessions_.find(phone->second);
  if (session != nullptr && (session->is_muted || !session->is_connected)) session = nullptr;
  const uint32_t wanted = session == nullptr ? 0 : session->id;
  if (driving.driver() == wanted) return;
  if (ClientSession* before = sessions_.find(driving.driver())) {
    driving.release_control(*before, 0, now);
    // Ends what goes on without control, and the next visitor finds the robot ready.
    const std::string& ready = robot_.description().ready_posture();
    if (ready.empty()) {
      driving.command_by_itself(StopCommand{}, now);
    } else {
      driving.command_by_itself(PostureCommand{ready, kPostureSpeed}, now);
    }
  }
  if (session == nullptr) return;
  attraction_.step(false, volume(), now);
  driving.assign_control(*session, now);
}

void ExhibitionDesk::watch_robot(double now) {
  const RobotMirror& mirror = robot_.streams().mirror();
  const Mode mode = mirror.motion().mode;
  const bool is_down = mode == Mode::kFalling || mode == Mode::kFallen;
  if (is_down && !was_down_) ++queue_.counts().falls;
  was_down_ = is_down;
  const bool is_available = robot_.components().is_available(Component::kRobot);
  if (!is_available && was_available_) ++queue_.counts().faults;
  was_available_ = is_available;
  const bool must_rest = needs_rest(mirror.body());
  if (must_rest && !queue_.state().is_resting) {
    is_body_resting_ = true;
    set_resting(true, now);
  } else if (!must_rest && is_body_resting_) {
    is_body_resting_ = false;
    set_resting(false, now);
  }
}

void ExhibitionDesk::watch_challenge() {
  const bool is_goal = challenge_.settings().is_goal;
  if (challenge_.step(is_goal ? rules_.ball() : rules_.robot())) queue_.note_challenge();
}

naoremote::Exhibition ExhibitionDesk::describe(const ClientSession& session) const {
  const QueueState& state = queue_.state();
  naoremote::Exhibition result;
  const std::string key = key_of(session.id);
  const VisitorView view = key.empty() ? VisitorView{} : queue_.view(key);
  result.set_phase(static_cast<naoremote::Exhibition::Phase>(view.phase));
  result.set_nickname(view.nickname);
  if (view.phase == VisitorView::Phase::kWaiting) {
    result.set_place(static_cast<uint32_t>(view.place));
    result.set_wait(whole_seconds(view.wait));
  }
  if (state.driver) {
    result.set_driver(state.driver->nickname);
    result.set_turn_left(whole_seconds(state.turn_left));
    result.set_is_warned(queue_.is_warned());
  }
  result.set_num_waiting(static_cast<uint32_t>(state.waiting.size()));
  for (const Visitor& visitor : state.waiting) {
    if (result.waiting_size() == kMaxTold) break;
    result.add_waiting(visitor.nickname);
  }
  result.set_is_paused(state.is_paused);
  result.set_is_resting(state.is_resting);
  result.set_forbids_kicks(state.choices.forbids_kicks);
  result.set_forbids_falls(state.choices.forbids_falls);
  result.set_speed(state.choices.speed);
  result.set_volume(state.choices.volume);
  result.set_has_challenge(!settings_.challenge.posts.empty());
  result.set_challenge_is_goal(settings_.challenge.is_goal);
  result.set_challenge_time(state.challenge_time);
  result.set_best_time(state.best_time);
  result.set_best_nickname(state.best_nickname);
  result.set_is_robot_away(!was_available_);
  result.set_num_turns(static_cast<uint32_t>(state.counts.turns - (state.driver ? 1 : 0)));
  result.set_language(settings_.language);
  return result;
}

void ExhibitionDesk::tell() {
  for (const auto& [id, session] : sessions_.all()) {
    if (!session->is_connected) continue;
    naoremote::Exhibition exhibition = describe(*session);
    std::string bytes = exhibition.SerializeAsString();
    std::string& last = told_[id];
    if (bytes == last) continue;
    last = std::move(bytes);
    naoremote::ServerMessage message;
    message.mutable_notice()->set_kind(naoremote::Notice::EXHIBITION_CHANGED);
    *message.mutable_notice()->mutable_exhibition() = std::move(exhibition);
    session->send(message);
  }
}

}  // namespace nao::gateway

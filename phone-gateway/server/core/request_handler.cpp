#include "phone-gateway/server/core/request_handler.h"

#include <limits>
#include <utility>
#include <variant>

#include "phone-gateway/protocol/framing.h"
#include "phone-gateway/server/core/request_check.h"
#include "phone-gateway/server/core/secret.h"

namespace nao::gateway {
namespace {

using naoremote::Request;
using naoremote::Response;

/** Executes a request whose fields have been checked; passes on the refusal of the check. */
template <class Checked, class Execute>
std::optional<Refusal> execute_checked(std::variant<Checked, Refusal> checked, Execute execute) {
  if (auto* refusal = std::get_if<Refusal>(&checked)) return std::move(*refusal);
  return execute(std::get<Checked>(std::move(checked)));
}

/** Whether the request ends a motion. */
bool ends_motion(const Request& request) {
  return request.has_walk_turn() || request.has_stop() || request.has_play();
}

/** Whether the request sets the robot in motion. Ending a walk or a behavior is always in time. */
bool starts_motion(const Request& request) {
  switch (request.use_case_case()) {
    case Request::kWalkTurn: {
      const naoremote::WalkTurn& walk = request.walk_turn();
      return walk.vx() != 0 || walk.vy() != 0 || walk.wz() != 0;
    }
    case Request::kPlay:
      return request.play().behavior() != naoremote::Play::NONE;
    case Request::kMoveTo:
    case Request::kGoToPosture:
    case Request::kChangeJoints:
    case Request::kDoAction:
    case Request::kDrag:
      return true;
    default:
      return false;
  }
}

}  // namespace

bool RequestHandler::handle(ClientSession& session, const Request& request, Response& response,
                            double now) {
  is_answered_later_ = false;
  const auto refusal = execute(session, request, response, now);
  if (!refusal) return !is_answered_later_;
  response.set_error(refusal->error);
  write_reason(refusal->reason, response);
  // So that the app can say who drives.
  if (refusal->error == naoremote::CONTROL_TAKEN && !response.has_control()) {
    *response.mutable_control() = robots_.of(session).driving().control().describe(session);
  }
  return true;
}

std::optional<Refusal> RequestHandler::execute(ClientSession& session, const Request& request,
                                               Response& response, double now) {
  // The operator's console on the gateway's host needs no token.
  const bool is_console = request.has_operate() && session.endpoint.is_local;
  if (!session.is_connected && !request.has_connect() && !request.has_join() && !is_console &&
      request.use_case_case() != Request::USE_CASE_NOT_SET) {
    return Refusal{naoremote::NOT_CONNECTED, gateway_reason("not-connected")};
  }
  // The fastest of the requests took half of the least round trip.
  const double age = session.age.take(request.sent_at(), now) + session.least_round_trip / 2;
  const bool is_overtaken = session.copies && (starts_motion(request) || ends_motion(request)) &&
                            !session.copies->is_newest_motion(request.request_id());
  const bool is_late = request.sent_at() > 0 && age > limits_.max_command_age;
  if ((is_late || is_overtaken) && starts_motion(request)) {
    return Refusal{naoremote::TOO_LATE,
                   gateway_reason("command-too-late",
                                  {to_argument(age), to_argument(limits_.max_command_age)})};
  }
  if (exhibition_ != nullptr) {
    if (auto refusal = exhibition_->check(session, request, starts_motion(request))) return refusal;
  }
  GatewayRobot& robot = robots_.of(session);
  Driving& driving = robot.driving();
  const naoremote::RobotDescription& description = robot.description();
  const uint32_t id = request.request_id();
  const auto send_command = [&](auto command) {
    return driving.command(session, id, std::move(command), now);
  };
  const auto send_service = [&](auto command) -> std::optional<Refusal> {
    if (auto refusal = driving.check_control(session, now)) return refusal;
    robot.services().send({session.id, id}, std::move(command), now);
    return std::nullopt;
  };
  switch (request.use_case_case()) {
    case Request::kConnect:
      return connect(session, request.connect(), response, now);
    case Request::kJoin:
      return join(session, request.join(), now);
    case Request::kGetState:
      return get_state(session, request.get_state(), response, now);
    case Request::kSubscribe:
      return subscribe(session, request.subscribe());
    case Request::kWalkTurn:
      return execute_checked(
          check(request.walk_turn(), description), [&](const WalkCommand& velocity) {
            return driving.walk(session, id, velocity, request.walk_turn().is_held(), now);
          });
    case Request::kMoveTo:
      return execute_checked(check(request.move_to()), send_command);
    case Request::kGoToPosture:
      return execute_checked(check(request.go_to_posture(), description), send_command);
    case Request::kChangeJoints:
      return execute_checked(check(request.change_joints(), description), send_command);
    case Request::kDoAction:
      // A taught motion has neither ball nor strength.
      if (robot.motions().has(request.do_action().action())) {
        const double nan = std::numeric_limits<double>::quiet_NaN();
        return send_command(ActionCommand{request.do_action().action(), nan, nan, nan});
      }
      return execute_checked(check(request.do_action(), description), send_command);
    case Request::kSay:
      return execute_checked(check(request.say()), [&](SpeechCommand speech) {
        if (exhibition_ != nullptr) speech.volume *= exhibition_->volume();
        return send_service(std::move(speech));
      });
    case Request::kSetLights:
      return execute_checked(check(request.set_lights(), description), send_service);
    case Request::kPlay:
      return execute_checked(check(request.play()), [&](const PlayCommand& command) {
        return driving.play(session, id, command, now);
      });
    case Request::kStop:
      return driving.stop(session, id, now);
    case Request::kTakeControl:
    case Request::kReleaseControl:
    case Request::kWatchRobot:
      return execute_control_request(session, request, response, now);
    case Request::kPing:
      ping(session, request.ping(), *response.mutable_pong(), now);
      return std::nullopt;
    case Request::kOperate:
      return console_.execute(session, request.operate(), response, now);
    case Request::kListMotions:
    case Request::kGetMotion:
    case Request::kCheckMotion:
    case Request::kSaveMotion:
    case Request::kDeleteMotion:
      return execute_motion_request(session, request, response, now);
    case Request::kDrag:
      return drag(session, request.drag(), now);
    case Request::kAttend:
    case Request::kRunExhibition:
      return execute_exhibition_request(session, request, response, now);
    case Request::USE_CASE_NOT_SET:
      break;
  }
  return Refusal{naoremote::INVALID_REQUEST, gateway_reason("use-case-unknown")};
}

std::optional<Refusal> RequestHandler::execute_control_request(ClientSession& session,
                                                               const Request& request,
                                                               Response& response, double now) {
  if (request.has_take_control()) {
    return take_control(session, request.take_control(), response, now);
  }
  if (request.has_watch_robot()) {
    const auto index = robots_.find(request.watch_robot().robot());
    if (!index) return robots_.refuse_unknown(request.watch_robot().robot());
    robots_.change(session, *index, now);
  } else if (exhibition_ != nullptr) {
    exhibition_->release(session);
  } else {
    const uint32_t successor = request.release_control().successor_id();
    robots_.of(session).driving().release_control(session, successor, now);
  }
  *response.mutable_control() = robots_.of(session).driving().control().describe(session);
  return std::nullopt;
}

std::optional<Refusal> RequestHandler::execute_exhibition_request(ClientSession& session,
                                                                  const Request& request,
                                                                  Response& response, double now) {
  if (exhibition_ == nullptr) {
    return Refusal{naoremote::INVALID_ARGUMENT, gateway_reason("exhibition-none")};
  }
  if (request.has_attend()) {
    auto refusal = exhibition_->attend(session, request.attend());
    *response.mutable_exhibition() = exhibition_->describe(session);
    return refusal;
  }
  return exhibition_->run(session, request.run_exhibition(), now);
}

std::optional<Refusal> RequestHandler::take_control(ClientSession& session,
                                                    const naoremote::TakeControl& request,
                                                    Response& response, double now) {
  const std::string& robot = request.robot();
  const std::optional<size_t> index = robot.empty() ? session.robot : robots_.find(robot);
  if (!index) return robots_.refuse_unknown(robot);
  Driving& driving = robots_.at(*index).driving();
  // First: a client that does not get the other robot keeps its own.
  auto refusal = driving.control().check_taking(session, now);
  if (!refusal) {
    robots_.change(session, *index, now);
    refusal = driving.take_control(session, now);
  }
  const bool may_wait = request.wait() && *index == session.robot;
  if (refusal && refusal->error == naoremote::CONTROL_TAKEN && may_wait) {
    driving.wait_for_control(session);
  }
  if (!refusal || refusal->error == naoremote::CONTROL_TAKEN) {
    *response.mutable_control() = driving.control().describe(session);
  }
  return refusal;
}

std::optional<Refusal> RequestHandler::execute_motion_request(ClientSession& session,
                                                              const Request& request,
                                                              Response& response, double now) {
  const uint32_t id = request.request_id();
  GatewayRobot& robot = robots_.of(session);
  const bool changes_files = request.has_save_motion() || request.has_delete_motion();
  if (changes_files) {
    if (auto refusal = robot.driving().check_control(session, now)) return refusal;
  }
  MotionFileCommand command;
  switch (request.use_case_case()) {
    case Request::kListMotions:
      response.mutable_motions();
      for (const std::string& name : robot.motions().listed()) {
        response.mutable_motions()->add_names(name);
      }
      return std::nullopt;
    case Request::kGetMotion:
      command.operation = MotionFileOperation::kGet;
      command.name = request.get_motion().name();
      break;
    case Request::kDeleteMotion:
      command.operation = MotionFileOperation::kDelete;
      command.name = request.delete_motion().name();
      break;
    default: {
      const bool saves = request.has_save_motion();
      auto checked = check(saves ? request.save_motion().motion() : request.check_motion().motion(),
                           robot.description());
      if (auto* refusal = std::get_if<Refusal>(&checked)) return std::move(*refusal);
      command = std::get<MotionFileCommand>(std::move(checked));
      command.operation = saves ? MotionFileOperation::kSave : MotionFileOperation::kCheck;
      command.may_replace = saves && request.save_motion().replace();
      return pass_on(session, id, std::move(command), now);
    }
  }
  if (!is_motion_name(command.name)) {
    return Refusal{naoremote::INVALID_ARGUMENT,
                   Reason("motion-name-invalid", {nao::quoted(command.name)})};
  }
  return pass_on(session, id, std::move(command), now);
}

std::optional<Refusal> RequestHandler::pass_on(ClientSession& session, uint32_t request_id,
                                               MotionFileCommand command, double now) {
  auto refusal =
      robots_.of(session).motions().request(session.id, request_id, std::move(command), now);
  is_answered_later_ = !refusal;
  return refusal;
}

std::optional<Refusal> RequestHandler::drag(ClientSession& session, const naoremote::Drag& request,
                                            double now) {
  GatewayRobot& robot = robots_.of(session);
  if (auto refusal = robot.driving().check_driving(session, now)) return refusal;
  if (!robot.components().is_simulated(now)) {
    return Refusal{naoremote::ROBOT_UNAVAILABLE, gateway_reason("not-simulated")};
  }
  return execute_checked(check(request), [&](const DragCommand& command) -> std::optional<Refusal> {
    robot.drag(command);
    return std::nullopt;
  });
}

std::optional<Refusal> RequestHandler::connect(ClientSession& session,
                                               const naoremote::Connect& request,
                                               Response& response, double now) {
  if (session.is_connected)
    return Refusal{naoremote::INVALID_ARGUMENT, gateway_reason("already-connected")};
  if (auto refusal = admission_.check(session.endpoint, request, sessions_, now)) {
    // The answer with the reason is sent before the connection closes.
    sessions_.refuse(session, request, refusal->reason, now);
    return refusal;
  }
  const std::optional<size_t> index =
      request.robot().empty() ? robots_.choose() : robots_.find(request.robot());
  // The connection stays open: the client may choose another one.
  if (!index) return robots_.refuse_unknown(request.robot());
  session.robot = *index;
  const GatewayRobot& robot = robots_.of(session);
  sessions_.connect(session, request);
  naoremote::Connected& connected = *response.mutable_connected();
  connected.set_protocol_version(kProtocolVersion);
  connected.set_server_version(server_version_);
  connected.set_client_id(session.id);
  connected.set_client_name(session.name);
  *connected.mutable_robot() = robot.describe(now);
  *connected.mutable_control() = robot.driving().control().describe(session);
  if (robots_.size() > 1) *connected.mutable_robots() = robots_.list();
  if (match_.match() != nullptr) *connected.mutable_match() = *match_.match();
  if (exhibition_ != nullptr) *connected.mutable_exhibition() = exhibition_->describe(session);
  // A new client learns once what is unavailable; later changes come as notices to all.
  robot.report_missing_components(session);
  return std::nullopt;
}

// The key is that of one client: nobody else gets its images, or drives with its control.
std::optional<Refusal> RequestHandler::join(ClientSession& session, const naoremote::Join& request,
                                            double now) {
  if (session.is_connected || session.first != 0)
    return Refusal{naoremote::INVALID_ARGUMENT, gateway_reason("already-connected")};
  ClientSession* first = sessions_.find(request.client_id());
  const bool is_known = first != nullptr && first->is_connected && !first->join_key.empty() &&
                        equals_secret(request.key(), first->join_key);
  if (!is_known) {
    Refusal refusal{naoremote::INVALID_ARGUMENT,
                    gateway_reason("client-unknown", {std::to_string(request.client_id())})};
    sessions_.refuse(session, {}, refusal.reason, now);
    return refusal;
  }
  sessions_.join(*first, session, now);
  return std::nullopt;
}

std::optional<Refusal> RequestHandler::get_state(ClientSession& session,
                                                 const naoremote::GetState& request,
                                                 Response& response, double now) {
  GatewayRobot& robot = robots_.of(session);
  auto checked = check(request.image(), robot.description());
  if (auto* refusal = std::get_if<Refusal>(&checked)) return std::move(*refusal);
  naoremote::StateAndImage result;
  const ImageSelection* selection =
      request.with_image() ? &std::get<ImageSelection>(checked) : nullptr;
  if (!robot.streams().get(session, selection, now, result)) {
    return Refusal{naoremote::ROBOT_UNAVAILABLE, gateway_reason("no-state-yet")};
  }
  *response.mutable_state_and_image() = std::move(result);
  return std::nullopt;
}

std::optional<Refusal> RequestHandler::subscribe(ClientSession& session,
                                                 const naoremote::Subscribe& request) {
  GatewayRobot& robot = robots_.of(session);
  return execute_checked(check(request, robot.description(), limits_),
                         [&](const Subscription& subscription) -> std::optional<Refusal> {
                           robot.streams().subscribe(session, subscription);
                           return std::nullopt;
                         });
}

void RequestHandler::ping(const ClientSession& session, const naoremote::Ping& request,
                          naoremote::Pong& pong, double now) {
  pong.set_client_utime(request.client_utime());
  // With the round-trip time a client computes the age of states and images without a common clock.
  pong.set_sent_at(now);
  const Streams& streams = robots_.of(session).streams();
  pong.set_robot_utime(static_cast<uint64_t>(streams.calc_robot_utime(now)));
  pong.set_num_clients(static_cast<uint32_t>(sessions_.num_connected()));
}

}  // namespace nao::gateway

#include "phone-gateway/server/core/streams.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace nao::gateway {
namespace {

/** Period of the last state's repetition while the robot is unavailable, s; see PROTOCOL.md. */
constexpr double kStaleStatePeriod = 1.0;
/** Rate of the images requested for a client that polls, 1/s: at the usual ten polls a second each
 * finds a new image. */
constexpr double kPolledImageRate = 15;
/** Time after which an image that no newer one has replaced is dropped, s. Chosen: longer than any
 * client waits for an image, so that the bound only limits memory. */
constexpr double kImageLifetime = 10;
/** Longest plausible time from exposure to reception of an image, s. Chosen: far above the 17 ms
 * that are measured (median, docs/performance.md), far below the difference of two programs'
 * starts. */
constexpr double kMaxImageDelay = 2;
/** Fractional part of the golden ratio. The multiples of it, modulo 1, are spread evenly over [0,
 * 1) for any number of clients (Knuth, The Art of Computer Programming, vol. 3, section 6.4). */
constexpr double kGoldenRatioFraction = 0.6180339887;
/** Clients of one phase. Chosen: with 32 clients a state's age is 0.16 ms instead of 0.13
 * (medians), and the gateway takes a tenth less processor time than with a phase for each. */
constexpr uint32_t kClientsOfAPhase = 16;

/** Calls use(request) for each image that a client requests now. */
template <class Use>
void for_each_request(const ClientStreams& streams, double now, double poll_timeout, Use use) {
  if (streams.subscription.image_rate > 0) use({streams.image(), streams.subscription.image_rate});
  if (now - streams.last_poll < poll_timeout) use({streams.polled_image, kPolledImageRate});
}

}  // namespace

void merge(const CameraRequest& request, std::vector<CameraRequest>& requests) {
  for (CameraRequest& known : requests) {
    if (!known.image.is_same_stream(request.image)) continue;
    known.rate = std::max(known.rate, request.rate);
    if (effective_quality(request.image.quality) > effective_quality(known.image.quality)) {
      known.image.quality = request.image.quality;
    }
    return;
  }
  requests.push_back(request);
}

void Streams::set_robot(const RobotSnapshot& robot, double now) {
  mirror_.set(robot, now);
  // The encoding is shared by all clients, and made anew for a new state.
  state_encoding_.reset();
  sessions_.for_each([now](ClientSession& session) {
    if (session.streams.state_throttle.allow(now)) session.request_state(now);
  });
}

void Streams::set_motion(const MotionSnapshot& motion) {
  mirror_.set(motion);
  state_encoding_.reset();
}

void Streams::set_body(std::optional<naoremote::Body> body) {
  mirror_.set_body(std::move(body));
}

void Streams::set_lights(std::vector<uint32_t> light_rgb) {
  mirror_.set_lights(std::move(light_rgb));
  state_encoding_.reset();
}

void Streams::add_audio(const SpeechPiece& piece) {
  if (piece.source != speech_source_ || piece.command_id != speech_command_id_) {
    speech_source_ = piece.source;
    speech_command_id_ = piece.command_id;
    ++speech_number_;
  }
  naoremote::ServerMessage message;
  naoremote::Audio& audio = *message.mutable_audio();
  audio.set_speech(speech_number_);
  audio.set_sample_rate(piece.sample_rate);
  audio.set_first_sample(piece.first_sample);
  audio.set_is_last(piece.is_last);
  audio.set_samples(piece.samples);
  const MessageBytes bytes = encode(message);
  sessions_.for_each([&](ClientSession& session) {
    if (!session.streams.subscription.has_audio) return;
    // The speech was stopped: what waits is not to be played.
    if (piece.samples.empty()) session.outbox.clear_audio();
    session.send_audio(bytes);
  });
}

void Streams::add_image(CachedImage image, double now) {
  const ImageSelection received{image.camera, image.width, 0};
  images_.put(std::move(image), now);
  sessions_.for_each([&](ClientSession& session) {
    ClientStreams& streams = session.streams;
    // Clients of other cameras or sizes wait for theirs.
    if (streams.subscription.image.camera != received.camera ||
        !streams.image().is_same_stream(received)) {
      return;
    }
    if (streams.image_throttle.allow(now)) session.request_image();
  });
}

void Streams::subscribe(ClientSession& session, const Subscription& subscription) const {
  ClientStreams& streams = session.streams;
  streams.subscription = subscription;
  // A few clients have a phase of their own: otherwise one state would be due for all clients at
  // once, and the last one served would wait for all others.
  const uint32_t group = session.id / kClientsOfAPhase;
  const double phase = std::fmod(group * kGoldenRatioFraction, 1);
  streams.state_throttle = StreamThrottle(subscription.state_rate, phase);
  streams.image_throttle = StreamThrottle(subscription.image_rate);
}

// What the client subscribed to goes on with this robot.
void Streams::adopt(ClientSession& session, const naoremote::RobotDescription& robot) const {
  ClientStreams& streams = session.streams;
  streams.last_image = 0;
  streams.last_poll = -1e9;
  session.outbox.clear_audio();
  Subscription subscription = streams.subscription;
  const auto& cameras = robot.cameras();
  const bool has_camera =
      std::find(cameras.begin(), cameras.end(), subscription.image.camera) != cameras.end();
  if (!has_camera) subscription.image.camera = cameras.empty() ? "" : cameras[0];
  subscribe(session, subscription);
}

// Polling: the answer to GetState, with an image that this client has not had yet.
bool Streams::get(ClientSession& session, const ImageSelection* selection, double now,
                  naoremote::StateAndImage& result) {
  ClientStreams& streams = session.streams;
  if (selection != nullptr) {
    streams.polled_image = *selection;
    streams.last_poll = now;
  }
  if (!mirror_.has_state()) return false;
  mirror_.write(*result.mutable_state(), components_.is_available(Component::kRobot), now);
  if (selection == nullptr) return true;
  if (const CachedImage* image = images_.find(*selection, streams.last_image)) {
    streams.last_image = image->number;
    write_image(*image, *result.mutable_image(), now);
  }
  return true;
}

MessageBytes Streams::make_state_message(double now) {
  if (!mirror_.has_state()) return nullptr;
  return state_encoding_.get(now, [&]() -> const naoremote::ServerMessage& {
    state_message_.mutable_state()->Clear();
    mirror_.write(*state_message_.mutable_state(), components_.is_available(Component::kRobot),
                  now);
    return state_message_;
  });
}

MessageBytes Streams::make_image_message(ClientSession& session, double now) {
  ClientStreams& streams = session.streams;
  CachedImage* image = images_.find(streams.image(), streams.last_image);
  if (image == nullptr) return nullptr;
  streams.image_pacer.note_sent(image->jpeg.size(), now);
  streams.last_image = image->number;
  return image->encoding.get(now, [&] {
    naoremote::ServerMessage message;
    write_image(*image, *message.mutable_image(), now);
    return message;
  });
}

void Streams::write_image(const CachedImage& cached, naoremote::Image& image, double now) const {
  image.set_utime(static_cast<uint64_t>(cached.utime));
  // The age counts from the exposure on the robot's clock. If that is implausible (robot and camera
  // may have been restarted separately, and their clocks differ), it counts from the reception.
  const double since_reception = now - cached.received_at;
  const double since_exposure =
      static_cast<double>(mirror_.calc_robot_utime(now) - cached.utime) * 1e-6;
  const bool is_plausible =
      since_exposure >= since_reception && since_exposure < since_reception + kMaxImageDelay;
  image.set_age_ms((is_plausible ? since_exposure : since_reception) * 1e3);
  image.set_camera(cached.camera);
  image.set_width(cached.width);
  image.set_height(cached.height);
  image.set_jpeg(cached.jpeg);
  image.set_sent_at(now);
}

// What the head camera is asked for: one request for each camera and width, with the highest rate
// and quality that a client wants.
std::vector<CameraRequest> Streams::camera_requests(double now) const {
  std::vector<CameraRequest> requests;
  const auto add = [&](const CameraRequest& request) { merge(request, requests); };
  sessions_.for_each([&](const ClientSession& session) {
    for_each_request(session.streams, now, limits_.poll_timeout, add);
  });
  return requests;
}

bool Streams::has_image_client(double now) const {
  return sessions_.has_any([&](const ClientSession& session) {
    bool is_requested = false;
    const auto look = [&](const CameraRequest& request) {
      is_requested |= request.image.camera != kOverviewCamera;
    };
    for_each_request(session.streams, now, limits_.poll_timeout, look);
    return is_requested;
  });
}

// While no states come, clients still get the last one now and then, with its age.
void Streams::step(double now) {
  images_.drop_before(now - kImageLifetime);
  if (components_.is_available(Component::kRobot) || now < next_stale_state_) return;
  next_stale_state_ = now + kStaleStatePeriod;
  sessions_.for_each([now](ClientSession& session) {
    if (session.streams.subscription.state_rate > 0) session.request_state(now);
  });
}

}  // namespace nao::gateway

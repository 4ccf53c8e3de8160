#include "daemons/speaker/speaker_daemon.h"

#include <unistd.h>

#include <algorithm>
#include <naolcm/light_command_t.hpp>
#include <naolcm/speech_audio_t.hpp>
#include <utility>

#include "common/bus.h"
#include "common/event_loop.h"
#include "common/logger.h"
#include "common/wall_clock.h"
#include "messages/light_command.h"
#include "messages/result_message.h"

namespace nao::speaker {
namespace {

const char* const kProgram = "nao-speaker";
/** s; the second one of steps in silence. */
constexpr double kStatusPeriod = 1;
constexpr double kIdlePeriod = 1;
/** Time after the last text in which results are repeated (ResultReminder), s. */
constexpr double kBusyTime = 2;
/** Color of the eyes while the robot speaks loudest, and the fraction of it in silence. Chosen:
 * distinct from the colors that show the state of a robot (daemons/robot/eyes.h). */
constexpr LightColor kSpeechColor{0.5, 0.9, 1};
constexpr double kSilentFraction = 0.15;
/** Time for which one light command is shown, in periods of the loudness, so that one may be lost.
 */
constexpr double kLightPeriods = 2;

/** Low byte first, on every host. */
std::vector<uint8_t> to_bytes(const std::vector<int16_t>& samples) {
  std::vector<uint8_t> bytes;
  bytes.reserve(2 * samples.size());
  for (const int16_t sample : samples) {
    const auto bits = static_cast<uint16_t>(sample);
    bytes.push_back(static_cast<uint8_t>(bits & 0xff));
    bytes.push_back(static_cast<uint8_t>(bits >> 8));
  }
  return bytes;
}

}  // namespace

SpeakerDaemon::SpeakerDaemon(Bus& bus, Synthesizer& synthesizer,
                             std::unique_ptr<AudioOutput> output, const SpeakerOptions& options)
    : bus_(bus),
      options_(options),
      channels_(options.robot),
      status_(bus, kProgram, options.robot),
      commands_(bus, channels_),
      core_(synthesizer, options.language),
      output_(std::move(output)),
      source_("speaker." + std::to_string(getpid())),
      // Numbers that no earlier speaker with the same process id has used.
      last_light_id_(wall_utime()) {
  bus_.subscribe<naolcm::speech_command_t>(
      channels_.speech_command, Bus::Queue::kAll, [this](const auto& message) {
        requests_.push_back({message.source, message.command_id, to_speech_command(message)});
      });
  publish_status(monotonic_seconds());
}

void SpeakerDaemon::attach(EventLoop& loop) {
  loop.on_readable(bus_.descriptor(), [this] {
    bus_.handle();
    if (!requests_.empty()) step(monotonic_seconds());
  });
  const int timer = loop.every(kStepPeriod, [this] { step(monotonic_seconds()); });
  on_step_ = [this, &loop, timer] {
    const bool is_busy = core_.is_speaking() || output_ || last_step_ - last_busy_ < kBusyTime;
    loop.set_period(timer, is_busy ? kStepPeriod : kIdlePeriod);
    is_busy ? commands_.wake() : commands_.nap();
  };
  loop.every_aligned(kStatusPeriod, [this] { publish_status(monotonic_seconds()); });
}

void SpeakerDaemon::step(double now) {
  const double dt = last_step_ > 0 ? now - last_step_ : 0;
  last_step_ = now;
  status_.tick(now);
  if (!requests_.empty() || core_.is_speaking()) last_busy_ = now;
  const SpeechOutput output = core_.step(std::exchange(requests_, {}), dt);
  for (const CommandResult& result : output.results) {
    if (result.status == ResultStatus::kRefused || result.status == ResultStatus::kFailed) {
      logger::info("{} {}: {}", quoted(result.source), to_string(result.status),
                   to_sentence(result.reason));
    }
    bus_.publish(channels_.command_result, to_message(result, commands_.robot_utime()));
  }
  for (const AudioPiece& piece : output.audio) {
    publish(piece);
    if (output_) output_->play(piece);
  }
  if (output_) output_->step();
  if (output.loudness) light_eyes(*output.loudness, output.time_left);
  if (on_step_) on_step_();
}

void SpeakerDaemon::publish(const AudioPiece& piece) {
  naolcm::speech_audio_t message;
  message.utime = commands_.robot_utime();
  message.source = piece.source;
  message.command_id = piece.command_id;
  message.sample_rate = piece.sample_rate;
  message.first_sample = piece.first_sample;
  message.is_last = piece.is_last ? 1 : 0;
  message.format = "s16le";
  message.data = to_bytes(piece.samples);
  message.size_bytes = static_cast<int32_t>(message.data.size());
  bus_.publish(channels_.speech_audio, message);
}

void SpeakerDaemon::light_eyes(double loudness, double time_left) {
  if (options_.eyes.empty()) return;
  LightColor color = kSpeechColor;
  for (double& part : color) part *= kSilentFraction + (1 - kSilentFraction) * loudness;
  LightCommand command;
  command.light_names = options_.eyes;
  command.light_rgb.assign(options_.eyes.size(), color);
  // The duration is above 0, which would mean "until replaced".
  command.duration =
      std::clamp(time_left, kStepPeriod, kLightPeriods * SpeechCore::kLoudnessPeriod);
  commands_.publish(channels_.light_command, to_message(command), source_, ++last_light_id_);
}

void SpeakerDaemon::publish_status(double now) {
  status_.tick(now);
  status_.set_state("ready", core_.is_speaking() ? "speaks" : "");
  status_.publish({{"texts_spoken", static_cast<double>(core_.num_spoken())},
                   {"texts_waiting", static_cast<double>(core_.num_waiting())}});
}

}  // namespace nao::speaker

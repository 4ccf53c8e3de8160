#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "common/channels.h"
#include "common/status_reporter.h"
#include "daemons/speaker/audio_output.h"
#include "daemons/speaker/speech_core.h"
#include "messages/command_publisher.h"

namespace nao {
class Bus;
class EventLoop;
}  // namespace nao

namespace nao::speaker {

struct SpeakerOptions {
  /** Prefix of the channels. */
  std::string robot = "NAO";
  /** Language of texts that state none; one of kSpeechLanguages. */
  std::string language = "en";
  /** Lights that are lit while the robot speaks. */
  std::vector<std::string> eyes;
};

/** Connects SpeechCore to the bus: receives NAO_SPEECH_COMMAND; publishes NAO_COMMAND_RESULT,
 * NAO_SPEECH_AUDIO and, while it speaks, NAO_LIGHT_COMMAND for the eyes. */
class SpeakerDaemon {
 public:
  /** s between two calls of step(). Chosen: a fifth of a piece of sound. */
  static constexpr double kStepPeriod = 0.05;

  /** @param bus, synthesizer  Must outlive this. @param output  May be nullptr. */
  SpeakerDaemon(Bus& bus, Synthesizer& synthesizer, std::unique_ptr<AudioOutput> output,
                const SpeakerOptions& options);

  /** Registers message handling, steps and status with the loop. */
  void attach(EventLoop& loop);

  /** @param now  s, monotonic. */
  void step(double now);
  void publish_status(double now);

  int64_t num_spoken() const { return core_.num_spoken(); }

 private:
  void publish(const AudioPiece& piece);
  /** @param loudness  0 to 1. @param time_left  s. */
  void light_eyes(double loudness, double time_left);

  Bus& bus_;
  SpeakerOptions options_;
  RobotChannels channels_;
  StatusReporter status_;
  CommandPublisher commands_;
  SpeechCore core_;
  std::unique_ptr<AudioOutput> output_;
  std::vector<SpeechRequest> requests_;
  std::string source_;
  int64_t last_light_id_;
  /** Slows down the steps in silence. */
  std::function<void()> on_step_;
  /** s; 0 before the first step. */
  double last_step_ = 0;
  /** When a text was spoken last, s. */
  double last_busy_ = 0;
};

}  // namespace nao::speaker

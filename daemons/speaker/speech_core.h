#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "daemons/speaker/synthesizer.h"
#include "messages/command.h"
#include "messages/command_ledger.h"
#include "messages/result_reminder.h"

namespace nao::speaker {

/** A speech_command_t as received. */
struct SpeechRequest {
  std::string source;
  int64_t id = 0;
  SpeechCommand command;
};

/** A piece of a text's sound; speech_audio_t documents every field. */
struct AudioPiece {
  std::string source;
  int64_t command_id = 0;
  int sample_rate = 0;
  int64_t first_sample = 0;
  bool is_last = false;
  std::vector<int16_t> samples;
};

/** Messages that one step publishes. */
struct SpeechOutput {
  /** Results in order, including repetitions. */
  std::vector<CommandResult> results;
  std::vector<AudioPiece> audio;
  /** Loudness of the next kLoudnessPeriod, 0 to 1, once in that time while a text is spoken. */
  std::optional<double> loudness;
  /** Time for which the text will still be spoken, s. */
  double time_left = 0;
};

/** The speaker without bus, clock, sound device and synthesizer: checks commands, queues texts,
 * divides their sound into timed pieces, and reports the result of each command. */
class SpeechCore {
 public:
  /** Texts that wait while another is spoken; one more is refused. Chosen. */
  static constexpr size_t kMaxWaiting = 8;
  /** Longest piece, and the time before it is due at which a piece is published, s. Chosen: it
   * covers the jitter of a receiver over Wi-Fi, and does not delay a stop, since `is_last` recalls
   * the rest. */
  static constexpr double kPieceDuration = 0.25;
  static constexpr double kLead = 0.5;
  /** Time between two values of the loudness, s. Chosen: about a syllable (4 to 5 a second). */
  static constexpr double kLoudnessPeriod = 0.2;

  /** @param synthesizer  Must outlive this.
   * @param language  Language of texts without one: of kSpeechLanguages. */
  SpeechCore(Synthesizer& synthesizer, std::string language)
      : synthesizer_(synthesizer), language_(std::move(language)) {}

  /** @param requests  Received since the last step, in order. @param dt  Time since the last step,
   * s. */
  SpeechOutput step(const std::vector<SpeechRequest>& requests, double dt);

  bool is_speaking() const { return current_.has_value(); }
  size_t num_waiting() const { return waiting_.size(); }
  int64_t num_spoken() const { return num_spoken_; }

 private:
  /** The text that is being spoken. */
  struct Current {
    SpeechRequest request;
    Speech speech;
    /** Samples that are due by now, and that were published. */
    double position = 0;
    int64_t num_published = 0;
    /** Time until the loudness is published next, s. */
    double loudness_due = 0;
  };

  void take(const SpeechRequest& request, SpeechOutput& output);
  /** Ends the text that is being spoken, and those that wait. */
  void interrupt(const Reason& reason, SpeechOutput& output);
  /** Begins the first waiting text that can be spoken. */
  void begin_next(SpeechOutput& output);
  void publish_pieces(SpeechOutput& output);
  void tell_loudness(SpeechOutput& output);
  void report(const SpeechRequest& request, ResultStatus status, const Reason& reason,
              SpeechOutput& output);

  Synthesizer& synthesizer_;
  std::string language_;
  std::optional<Current> current_;
  std::deque<SpeechRequest> waiting_;
  CommandLedger ledger_;
  ResultReminder reminder_;
  int64_t num_spoken_ = 0;
};

}  // namespace nao::speaker

#include "daemons/speaker/speech_core.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace nao::speaker {
namespace {

using Operation = SpeechCommand::Operation;

/** Root mean square of the samples at loudness 1. Measured: the loudest 0.2 s of English, German
 * and Spanish sentences of espeak-ng at full volume have 5000 to 7000. */
constexpr double kLoudRms = 6000;

double root_mean_square(const int16_t* begin, const int16_t* end) {
  double sum = 0;
  for (const int16_t* sample = begin; sample != end; ++sample) {
    sum += static_cast<double>(*sample) * *sample;
  }
  return begin == end ? 0 : std::sqrt(sum / static_cast<double>(end - begin));
}

}  // namespace

SpeechOutput SpeechCore::step(const std::vector<SpeechRequest>& requests, double dt) {
  SpeechOutput output;
  output.results = reminder_.due(dt);
  if (current_) {
    current_->position += dt * current_->speech.sample_rate;
    current_->loudness_due -= dt;
  }
  for (const SpeechRequest& request : requests) take(request, output);
  if (current_ && current_->position >= static_cast<double>(current_->speech.samples.size())) {
    ++num_spoken_;
    report(current_->request, ResultStatus::kDone, {}, output);
    current_.reset();
  }
  if (!current_) begin_next(output);
  publish_pieces(output);
  tell_loudness(output);
  return output;
}

void SpeechCore::take(const SpeechRequest& request, SpeechOutput& output) {
  if (const CommandResult* result = ledger_.find(request.source, request.id)) {
    output.results.push_back(*result);
    return;
  }
  std::optional<Reason> fault = check_sender(request.source, request.id);
  if (!fault) fault = check(request.command);
  const Operation operation = request.command.operation;
  if (!fault && operation == Operation::kSayAfter && waiting_.size() >= kMaxWaiting) {
    fault = Reason("speech-queue-full", {std::to_string(waiting_.size())});
  }
  if (fault) {
    report(request, ResultStatus::kRefused, *fault, output);
    return;
  }
  report(request, ResultStatus::kAccepted, {}, output);
  if (operation == Operation::kStop) {
    interrupt(Reason("speech-stopped"), output);
    report(request, ResultStatus::kDone, {}, output);
    return;
  }
  if (operation == Operation::kSay) interrupt(Reason("replaced", {"say"}), output);
  waiting_.push_back(request);
  std::string& language = waiting_.back().command.language;
  language = language.empty() ? language_ : std::string(find_speech_language(language));
}

void SpeechCore::interrupt(const Reason& reason, SpeechOutput& output) {
  if (current_) {
    const auto position = static_cast<int64_t>(current_->position);
    output.audio.push_back({current_->request.source,
                            current_->request.id,
                            current_->speech.sample_rate,
                            std::min(position, current_->num_published),
                            true,
                            {}});
    report(current_->request, ResultStatus::kInterrupted, reason, output);
    current_.reset();
  }
  for (const SpeechRequest& request : std::exchange(waiting_, {})) {
    report(request, ResultStatus::kInterrupted, reason, output);
  }
}

void SpeechCore::begin_next(SpeechOutput& output) {
  while (!waiting_.empty() && !current_) {
    SpeechRequest request = std::move(waiting_.front());
    waiting_.pop_front();
    std::optional<Speech> speech = synthesizer_.synthesize(request.command);
    if (speech && !speech->samples.empty()) {
      current_ = Current{std::move(request), std::move(*speech)};
      return;
    }
    const std::string& language = request.command.language;
    report(request, ResultStatus::kFailed,
           speech ? Reason("text-not-speakable", {language}) : Reason("speech-failed", {language}),
           output);
  }
}

void SpeechCore::publish_pieces(SpeechOutput& output) {
  if (!current_) return;
  const std::vector<int16_t>& samples = current_->speech.samples;
  const auto num_samples = static_cast<int64_t>(samples.size());
  const int rate = current_->speech.sample_rate;
  const auto piece_size = static_cast<int64_t>(kPieceDuration * rate);
  const double end = current_->position + kLead * rate;
  while (current_->num_published < num_samples &&
         static_cast<double>(current_->num_published) < end) {
    const int64_t begin = current_->num_published;
    current_->num_published = std::min(num_samples, begin + piece_size);
    output.audio.push_back({current_->request.source,
                            current_->request.id,
                            rate,
                            begin,
                            current_->num_published == num_samples,
                            {samples.begin() + begin, samples.begin() + current_->num_published}});
  }
}

void SpeechCore::tell_loudness(SpeechOutput& output) {
  if (!current_) return;
  const std::vector<int16_t>& samples = current_->speech.samples;
  const int rate = current_->speech.sample_rate;
  output.time_left = (static_cast<double>(samples.size()) - current_->position) / rate;
  // Steps of a fraction of the period add up to it but for their rounding.
  if (current_->loudness_due > 1e-6) return;
  current_->loudness_due += kLoudnessPeriod;
  const auto begin = static_cast<size_t>(current_->position);
  const size_t end = std::min(samples.size(), begin + static_cast<size_t>(kLoudnessPeriod * rate));
  output.loudness =
      std::min(1.0, root_mean_square(samples.data() + begin, samples.data() + end) / kLoudRms);
}

void SpeechCore::report(const SpeechRequest& request, ResultStatus status, const Reason& reason,
                        SpeechOutput& output) {
  output.results.push_back({request.source, request.id, CommandKind::kSpeech, status, reason});
  ledger_.note(output.results.back());
  reminder_.note(output.results.back());
}

}  // namespace nao::speaker

#include "daemons/speaker/espeak_synthesizer.h"

#include <gmock/gmock.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/types.h>
#include <unistd.h>

#include <atomic>
#include <cstdio>
#include <filesystem>

#include "daemons/speaker/isolated_synthesizer.h"
#include "daemons/speaker/speech_core.h"
#include "test/daemons/speaker/odd_texts.h"

namespace {
/** In memory that child processes share. */
std::atomic<int>& num_processes() {
  static auto& count = *static_cast<std::atomic<int>*>(mmap(nullptr, sizeof(std::atomic<int>),
                                                            PROT_READ | PROT_WRITE,
                                                            MAP_SHARED | MAP_ANONYMOUS, -1, 0));
  return count;
}
}  // namespace

// All calls of the program and its libraries to start a process arrive here instead of in the C
// library. fork() works: the texts are spoken in child processes.
extern "C" {
int system(const char*) {
  ++num_processes();
  return -1;
}
FILE* popen(const char*, const char*) {
  ++num_processes();
  return nullptr;
}
pid_t fork() noexcept {
  ++num_processes();
  return _Fork();
}
pid_t vfork() noexcept {
  ++num_processes();
  return -1;
}
int execve(const char*, char* const[], char* const[]) noexcept {
  ++num_processes();
  return -1;
}
int execv(const char*, char* const[]) noexcept {
  ++num_processes();
  return -1;
}
int execvp(const char*, char* const[]) noexcept {
  ++num_processes();
  return -1;
}
int posix_spawn(pid_t*, const char*, const posix_spawn_file_actions_t*, const posix_spawnattr_t*,
                char* const[], char* const[]) {
  ++num_processes();
  return -1;
}
int posix_spawnp(pid_t*, const char*, const posix_spawn_file_actions_t*, const posix_spawnattr_t*,
                 char* const[], char* const[]) {
  ++num_processes();
  return -1;
}
}

namespace nao::speaker {
namespace {

/** The one of this process. */
EspeakSynthesizer& the_synthesizer() {
  static EspeakSynthesizer synthesizer;
  return synthesizer;
}

double duration_of(const std::optional<Speech>& speech) {
  return speech ? static_cast<double>(speech->samples.size()) / speech->sample_rate : 0;
}

SpeechCommand command(const std::string& text, const std::string& language = "en",
                      double volume = 1, double rate = 1) {
  return {SpeechCommand::Operation::kSay, text, language, volume, rate};
}

int loudest(const Speech& speech) {
  int result = 0;
  for (const int16_t sample : speech.samples) result = std::max(result, std::abs(int{sample}));
  return result;
}

TEST(EspeakSynthesizer, SpeaksEveryLanguageOfTheTable) {
  EspeakSynthesizer& synthesizer = the_synthesizer();
  for (const std::string_view language : kSpeechLanguages) {
    const auto speech = synthesizer.synthesize(command("12", std::string(language)));
    ASSERT_TRUE(speech) << language;
    EXPECT_GT(duration_of(speech), 0.2) << language;
    EXPECT_LT(duration_of(speech), 5) << language;
    EXPECT_GT(loudest(*speech), 1000) << language;
  }
}

TEST(EspeakSynthesizer, LanguagesSoundDifferent) {
  EspeakSynthesizer& synthesizer = the_synthesizer();
  const auto english = synthesizer.synthesize(command("die hand", "en"));
  const auto german = synthesizer.synthesize(command("die hand", "de"));
  ASSERT_TRUE(english && german);
  EXPECT_NE(english->samples, german->samples);
}

TEST(EspeakSynthesizer, ObeysVolumeAndRateAndForgetsThem) {
  EspeakSynthesizer& synthesizer = the_synthesizer();
  const std::string text = "one two three four";
  const auto normal = synthesizer.synthesize(command(text));
  const auto quiet = synthesizer.synthesize(command(text, "en", 0.25));
  const auto fast = synthesizer.synthesize(command(text, "en", 1, 2));
  const auto slow = synthesizer.synthesize(command(text, "en", 1, 0.5));
  const auto again = synthesizer.synthesize(command(text));
  ASSERT_TRUE(normal && quiet && fast && slow && again);
  EXPECT_LT(loudest(*quiet), 0.5 * loudest(*normal));
  EXPECT_LT(duration_of(fast), 0.75 * duration_of(normal));
  EXPECT_GT(duration_of(slow), 1.4 * duration_of(normal));
  EXPECT_NEAR(duration_of(again), duration_of(normal), 0.05);
}

TEST(EspeakSynthesizer, DoesNotInterpretMarkupOrPhonemes) {
  EspeakSynthesizer& synthesizer = the_synthesizer();
  // As markup it would be silent for an hour, or silent at once.
  EXPECT_LT(duration_of(synthesizer.synthesize(command("a <break time=\"3600s\"/> b"))), 30);
  EXPECT_GT(duration_of(synthesizer.synthesize(command("<audio src=\"hello world\">"))), 0.5);
}

TEST(EspeakSynthesizer, SpeaksOrRefusesOddTextsInWordsAndStartsNoOtherProgram) {
  IsolatedSynthesizer synthesizer(the_synthesizer());
  num_processes() = 0;
  const std::vector<std::string> texts = odd_texts();
  ASSERT_GE(texts.size(), 200u);
  int num_done = 0;
  int num_refused = 0;
  int num_failed = 0;
  int num_faults = 0;
  int64_t id = 0;
  for (const std::string& text : texts) {
    // Each with another language, and the first part of them with a fast voice.
    const std::string language(kSpeechLanguages[static_cast<size_t>(id) % kSpeechLanguages.size()]);
    SpeechCore core(synthesizer, "en");
    ++id;
    std::vector<CommandResult> results =
        core.step({{"test", id, command(text, language, 1, 2)}}, 0).results;
    // Longer than the longest sound.
    const std::vector<CommandResult> later = core.step({}, 1000).results;
    results.insert(results.end(), later.begin(), later.end());
    const std::string shown = testing::PrintToString(text.substr(0, 60));
    ASSERT_FALSE(results.empty()) << shown;
    const CommandResult& end = results.back();
    switch (end.status) {
      case ResultStatus::kDone:
        ++num_done;
        break;
      case ResultStatus::kRefused:
        ++num_refused;
        break;
      case ResultStatus::kFailed:
        ++num_failed;
        num_faults += end.reason.code == "speech-failed";
        EXPECT_THAT(end.reason.code, testing::AnyOf("text-not-speakable", "speech-failed"))
            << shown;
        break;
      default:
        ADD_FAILURE() << shown << ": " << to_string(end.status);
    }
    const bool is_explained = end.status == ResultStatus::kDone || !to_sentence(end.reason).empty();
    EXPECT_TRUE(is_explained) << shown;
  }
  RecordProperty("texts", static_cast<int>(texts.size()));
  RecordProperty("spoken", num_done);
  RecordProperty("refused", num_refused);
  RecordProperty("not_speakable", num_failed);
  RecordProperty("faults", num_faults);
  EXPECT_GT(num_done, 100);
  EXPECT_GT(num_refused, 50);
  // The library's faults with random letters.
  EXPECT_LT(num_faults, 30);
  // One for each text that was not refused, and none that a text began.
  EXPECT_EQ(num_processes(), num_done + num_failed);
  EXPECT_FALSE(std::filesystem::exists("/tmp/speech-was-here"));
}

TEST(EspeakSynthesizer, ExistsOnce) {
  the_synthesizer();
  EXPECT_ANY_THROW(EspeakSynthesizer());
}

}  // namespace
}  // namespace nao::speaker

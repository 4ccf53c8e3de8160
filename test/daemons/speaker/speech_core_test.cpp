#include "daemons/speaker/speech_core.h"

#include <gmock/gmock.h>

#include <map>
#include <string>

namespace nao::speaker {
namespace {

using Operation = SpeechCommand::Operation;
using testing::ElementsAre;
using testing::IsEmpty;

/** One second of a square wave, at 1000 samples a second, for each character. */
class FakeSynthesizer : public Synthesizer {
 public:
  std::optional<Speech> synthesize(const SpeechCommand& command) override {
    commands.push_back(command);
    if (command.text == "broken") return std::nullopt;
    if (command.text == "silent") return Speech{1000, {}};
    Speech speech{1000, {}};
    for (size_t i = 0; i < 1000 * command.text.size(); ++i) {
      speech.samples.push_back(static_cast<int16_t>(i % 2 == 0 ? 3000 : -3000));
    }
    return speech;
  }
  std::vector<SpeechCommand> commands;
};

class SpeechCoreTest : public testing::Test {
 protected:
  /** @return The results, as "1 done": without repetitions. */
  std::vector<std::string> step(std::vector<SpeechRequest> requests, double dt = 0.05) {
    output_ = core_.step(requests, dt);
    std::vector<std::string> results;
    for (const CommandResult& result : output_.results) {
      const std::string text = std::to_string(result.id) + " " + to_string(result.status) +
                               (result.reason.empty() ? "" : " " + result.reason.code);
      if (last_result_[result.id] == text) continue;
      last_result_[result.id] = text;
      results.push_back(text);
    }
    for (const AudioPiece& piece : output_.audio) pieces_.push_back(piece);
    return results;
  }
  static SpeechRequest say(int64_t id, const std::string& text,
                           Operation operation = Operation::kSay) {
    return {"test", id, {operation, text}};
  }
  static SpeechRequest stop(int64_t id) { return {"test", id, {Operation::kStop}}; }

  FakeSynthesizer synthesizer_;
  SpeechCore core_{synthesizer_, "pt"};
  SpeechOutput output_;
  std::vector<AudioPiece> pieces_;
  std::map<int64_t, std::string> last_result_;
};

TEST_F(SpeechCoreTest, SpeaksATextForAsLongAsItsSoundLasts) {
  EXPECT_THAT(step({say(1, "ab")}), ElementsAre("1 accepted"));
  for (int i = 0; i < 39; ++i) EXPECT_THAT(step({}), IsEmpty());
  EXPECT_TRUE(core_.is_speaking());
  EXPECT_THAT(step({}, 0.06), ElementsAre("1 done"));
  EXPECT_FALSE(core_.is_speaking());
  EXPECT_EQ(core_.num_spoken(), 1);
}

TEST_F(SpeechCoreTest, PublishesTheSoundInPiecesAheadOfTime) {
  step({say(1, "ab")});
  // Half a second ahead: two pieces.
  ASSERT_EQ(pieces_.size(), 2u);
  for (int i = 0; i < 60; ++i) {
    step({});
    EXPECT_LE(output_.audio.size(), 1u);
  }
  ASSERT_EQ(pieces_.size(), 8u);
  int64_t next = 0;
  for (const AudioPiece& piece : pieces_) {
    EXPECT_EQ(piece.first_sample, next);
    EXPECT_EQ(piece.samples.size(), 250u);
    EXPECT_EQ(piece.is_last, next == 1750);
    EXPECT_EQ(piece.sample_rate, 1000);
    next += static_cast<int64_t>(piece.samples.size());
  }
}

TEST_F(SpeechCoreTest, ANewTextReplacesTheOneBefore) {
  step({say(1, "abc"), say(2, "d", Operation::kSayAfter)});
  pieces_.clear();
  EXPECT_THAT(step({say(3, "e")}, 0.1),
              ElementsAre("3 accepted", "1 interrupted replaced", "2 interrupted replaced"));
  // What was sent of the first text is recalled from where it was.
  ASSERT_GE(pieces_.size(), 2u);
  EXPECT_EQ(pieces_[0].command_id, 1);
  EXPECT_TRUE(pieces_[0].is_last);
  EXPECT_THAT(pieces_[0].samples, IsEmpty());
  EXPECT_EQ(pieces_[0].first_sample, 100);
  EXPECT_EQ(pieces_[1].command_id, 3);
  EXPECT_EQ(pieces_[1].first_sample, 0);
}

TEST_F(SpeechCoreTest, ATextMayFollowTheOneBefore) {
  EXPECT_THAT(step({say(1, "a"), say(2, "b", Operation::kSayAfter)}),
              ElementsAre("1 accepted", "2 accepted"));
  EXPECT_THAT(step({}, 1.1), ElementsAre("1 done"));
  EXPECT_TRUE(core_.is_speaking());
  EXPECT_THAT(step({}, 1.1), ElementsAre("2 done"));
}

TEST_F(SpeechCoreTest, RefusesMoreThanEightWaitingTexts) {
  std::vector<SpeechRequest> requests{say(1, "a")};
  step(requests);
  for (int64_t id = 2; id <= 9; ++id) step({say(id, "b", Operation::kSayAfter)});
  EXPECT_THAT(step({say(10, "c", Operation::kSayAfter)}),
              ElementsAre("10 refused speech-queue-full"));
}

TEST_F(SpeechCoreTest, StopEndsEverything) {
  step({say(1, "a"), say(2, "b", Operation::kSayAfter)});
  EXPECT_THAT(step({stop(3)}), ElementsAre("3 accepted", "1 interrupted speech-stopped",
                                           "2 interrupted speech-stopped", "3 done"));
  EXPECT_FALSE(core_.is_speaking());
  EXPECT_THAT(step({stop(4)}), ElementsAre("4 accepted", "4 done"));
}

TEST_F(SpeechCoreTest, ExecutesARepeatedCommandOnceAndAnswersItAgain) {
  step({say(1, "a")});
  output_ = core_.step({say(1, "a")}, 0.05);
  ASSERT_EQ(output_.results.size(), 1u);
  EXPECT_EQ(output_.results[0].status, ResultStatus::kAccepted);
  EXPECT_EQ(synthesizer_.commands.size(), 1u);
  step({}, 1.1);
  output_ = core_.step({say(1, "a")}, 0.01);
  ASSERT_EQ(output_.results.size(), 1u);
  EXPECT_EQ(output_.results[0].status, ResultStatus::kDone);
  // The final result is repeated by itself, too.
  EXPECT_EQ(core_.step({}, 0.1).results.size(), 1u);
  EXPECT_EQ(core_.step({}, 0.5).results.size(), 1u);
  EXPECT_EQ(core_.step({}, 0.5).results.size(), 0u);
}

TEST_F(SpeechCoreTest, RefusesWhatItsCheckFinds) {
  EXPECT_THAT(step({say(1, "")}), ElementsAre("1 refused text-missing"));
  EXPECT_THAT(step({{"", 2, {Operation::kSay, "a"}}}), ElementsAre("2 refused source-missing"));
  EXPECT_THAT(step({{"test", 0, {Operation::kSay, "a"}}}),
              ElementsAre("0 refused command-id-zero"));
  EXPECT_THAT(synthesizer_.commands, IsEmpty());
}

TEST_F(SpeechCoreTest, TellsWhyATextWasNotSpokenAndGoesOn) {
  EXPECT_THAT(step({say(1, "broken"), say(2, "silent", Operation::kSayAfter),
                    say(3, "a", Operation::kSayAfter)}),
              ElementsAre("1 accepted", "2 accepted", "3 accepted", "1 failed speech-failed",
                          "2 failed text-not-speakable"));
  EXPECT_TRUE(core_.is_speaking());
}

TEST_F(SpeechCoreTest, GivesTheSynthesizerALanguageThatItHas) {
  step({say(1, "a")});
  step({{"test", 2, {Operation::kSay, "b", "de-AT"}}});
  ASSERT_EQ(synthesizer_.commands.size(), 2u);
  EXPECT_EQ(synthesizer_.commands[0].language, "pt");
  EXPECT_EQ(synthesizer_.commands[1].language, "de");
}

TEST_F(SpeechCoreTest, TellsTheLoudnessFiveTimesASecondAndNoLongerThanItSpeaks) {
  int num_told = 0;
  for (int i = 0; i < 30; ++i) {
    step(i == 0 ? std::vector{say(1, "a")} : std::vector<SpeechRequest>{});
    if (!output_.loudness) continue;
    ++num_told;
    EXPECT_NEAR(*output_.loudness, 0.5, 0.01);
    EXPECT_GT(output_.time_left, 0);
    EXPECT_LE(output_.time_left, 1);
  }
  EXPECT_EQ(num_told, 5);
}

}  // namespace
}  // namespace nao::speaker

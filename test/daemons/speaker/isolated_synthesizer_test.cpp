#include "daemons/speaker/isolated_synthesizer.h"

#include <gmock/gmock.h>
#include <unistd.h>

#include <atomic>
#include <csignal>

#include "common/error.h"

namespace nao::speaker {
namespace {

using testing::ElementsAre;

/** Does what its text names. */
class FaultySynthesizer : public Synthesizer {
 public:
  std::optional<Speech> synthesize(const SpeechCommand& command) override {
    ++num_texts_;
    if (command.text == "crash") std::raise(SIGKILL);
    if (command.text == "throw") throw Error("not today");
    if (command.text == "exit") _exit(3);
    if (command.text == "fail") return std::nullopt;
    if (command.text == "silence") return Speech{16000, {}};
    if (command.text == "long") return Speech{22050, std::vector<int16_t>(3'000'000, 7)};
    while (command.text == "hang") time_wasted_ = time_wasted_ + 1;
    return Speech{16000, {1, -2, static_cast<int16_t>(num_texts_)}};
  }

 private:
  int num_texts_ = 0;
  std::atomic<int> time_wasted_ = 0;
};

struct IsolatedSynthesizerTest : testing::Test {
  std::optional<Speech> say(const std::string& text) {
    return isolated.synthesize({SpeechCommand::Operation::kSay, text, "en", 1, 1});
  }

  FaultySynthesizer faulty;
  IsolatedSynthesizer isolated{faulty, 1};
};

TEST_F(IsolatedSynthesizerTest, PassesTheSpeechOn) {
  const auto speech = say("hello");
  ASSERT_TRUE(speech);
  EXPECT_EQ(speech->sample_rate, 16000);
  EXPECT_THAT(speech->samples, ElementsAre(1, -2, 1));
  const auto silence = say("silence");
  ASSERT_TRUE(silence);
  EXPECT_TRUE(silence->samples.empty());
  const auto longest = say("long");
  ASSERT_TRUE(longest);
  EXPECT_EQ(longest->samples, std::vector<int16_t>(3'000'000, 7));
}

TEST_F(IsolatedSynthesizerTest, OutlivesEveryFaultAndForgetsIt) {
  for (const char* text : {"crash", "throw", "exit", "fail", "hang"}) {
    EXPECT_FALSE(say(text)) << text;
    const auto next = say("hello");
    ASSERT_TRUE(next) << text;
    EXPECT_THAT(next->samples, ElementsAre(1, -2, 1)) << text;
  }
}

}  // namespace
}  // namespace nao::speaker

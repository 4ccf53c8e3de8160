#include "daemons/speaker/speaker_daemon.h"

#include <gmock/gmock.h>

#include <naolcm/command_result_t.hpp>
#include <naolcm/daemon_status_t.hpp>
#include <naolcm/light_command_t.hpp>
#include <naolcm/motion_state_t.hpp>
#include <naolcm/speech_audio_t.hpp>

#include "common/bus.h"
#include "common/error.h"

namespace nao::speaker {
namespace {

/** Half a second of the numbers 0, 1, 2, ... */
class CountingSynthesizer : public Synthesizer {
 public:
  std::optional<Speech> synthesize(const SpeechCommand&) override {
    Speech speech{1000, {}};
    for (int16_t i = 0; i < 500; ++i) speech.samples.push_back(static_cast<int16_t>(i - 250));
    return speech;
  }
};

class RecordingOutput : public AudioOutput {
 public:
  explicit RecordingOutput(std::vector<AudioPiece>& pieces) : pieces_(pieces) {}
  void play(const AudioPiece& piece) override { pieces_.push_back(piece); }
  void step() override {}

 private:
  std::vector<AudioPiece>& pieces_;
};

class SpeakerDaemonTest : public testing::Test {
 protected:
  SpeakerDaemonTest()
      : bus_("memq://"),
        daemon_(bus_, synthesizer_, std::make_unique<RecordingOutput>(played_),
                {"NAO", "en", {"left-eye", "right-eye"}}) {
    bus_.subscribe<naolcm::command_result_t>(
        "NAO_COMMAND_RESULT", Bus::Queue::kAll,
        [this](const naolcm::command_result_t& result) { results_.push_back(result); });
    bus_.subscribe<naolcm::speech_audio_t>(
        "NAO_SPEECH_AUDIO", Bus::Queue::kAll,
        [this](const naolcm::speech_audio_t& audio) { audio_.push_back(audio); });
    bus_.subscribe<naolcm::light_command_t>(
        "NAO_LIGHT_COMMAND", Bus::Queue::kAll,
        [this](const naolcm::light_command_t& light) { lights_.push_back(light); });
  }

  void say(const std::string& text) {
    naolcm::speech_command_t command{};
    command.source = "test";
    command.command_id = ++last_id_;
    command.text = text;
    command.volume = 1;
    command.rate = 1;
    bus_.publish("NAO_SPEECH_COMMAND", command);
  }

  void run(double seconds) {
    for (int i = 0; i < seconds / 0.05; ++i) {
      while (bus_.handle_for(0)) {
      }
      daemon_.step(now_ += 0.05);
    }
    while (bus_.handle_for(0)) {
    }
  }

  CountingSynthesizer synthesizer_;
  std::vector<AudioPiece> played_;
  Bus bus_;
  SpeakerDaemon daemon_;
  std::vector<naolcm::command_result_t> results_;
  std::vector<naolcm::speech_audio_t> audio_;
  std::vector<naolcm::light_command_t> lights_;
  int64_t last_id_ = 0;
  double now_ = 100;
};

TEST_F(SpeakerDaemonTest, PublishesResultsInRobotTime) {
  naolcm::motion_state_t state{};
  state.utime = 5000000;
  bus_.publish("NAO_MOTION_STATE", state);
  say("hello");
  run(1);
  ASSERT_GE(results_.size(), 2u);
  EXPECT_EQ(results_[0].status, naolcm::command_result_t::STATUS_ACCEPTED);
  EXPECT_EQ(results_[0].utime, 5000000);
  EXPECT_EQ(results_[0].command_kind, naolcm::command_result_t::COMMAND_KIND_SPEECH);
  EXPECT_EQ(results_[1].status, naolcm::command_result_t::STATUS_DONE);
  EXPECT_EQ(results_[1].command_id, 1);
}

TEST_F(SpeakerDaemonTest, PublishesAndPlaysTheSamples) {
  say("hello");
  run(1);
  ASSERT_EQ(audio_.size(), 2u);
  EXPECT_EQ(played_.size(), 2u);
  EXPECT_EQ(audio_[0].format, "s16le");
  EXPECT_EQ(audio_[0].sample_rate, 1000);
  ASSERT_EQ(audio_[0].size_bytes, 500);
  // -250 and -249, low byte first.
  EXPECT_EQ(std::vector<int>(audio_[0].data.begin(), audio_[0].data.begin() + 4),
            (std::vector<int>{0x06, 0xff, 0x07, 0xff}));
  EXPECT_EQ(audio_[1].first_sample, 250);
  EXPECT_EQ(audio_[1].is_last, 1);
}

TEST_F(SpeakerDaemonTest, LightsTheEyesAsLongAsItSpeaks) {
  say("hello");
  run(2);
  // Half a second, five times a second.
  ASSERT_EQ(lights_.size(), 3u);
  for (const naolcm::light_command_t& light : lights_) {
    EXPECT_EQ(light.light_names, (std::vector<std::string>{"left-eye", "right-eye"}));
    EXPECT_GT(light.duration, 0);
    EXPECT_LE(light.duration, 0.5);
  }
  EXPECT_LE(lights_.back().duration, 0.1001);
  EXPECT_NE(lights_[0].command_id, lights_[1].command_id);
}

TEST_F(SpeakerDaemonTest, RefusesInWords) {
  say("");
  run(0.1);
  ASSERT_EQ(results_.size(), 1u);
  EXPECT_EQ(results_[0].reason_code, "text-missing");
  EXPECT_EQ(results_[0].reason, "There is no text to speak.");
}

TEST(AudioOutput, IsNamed) {
  EXPECT_EQ(make_audio_output("none"), nullptr);
  EXPECT_THROW(make_audio_output("radio"), ConfigError);
  EXPECT_THROW(make_audio_output("alsa:no-such-device"), Error);
}

TEST(AudioOutput, PlaysOnAlsasNullDevice) {
  std::unique_ptr<AudioOutput> output;
  try {
    output = make_audio_output("alsa:null");
  } catch (const Error& error) {
    GTEST_SKIP() << error.what();
  }
  AudioPiece piece{"test", 1, 22050, 0, false, std::vector<int16_t>(5512, 1000)};
  for (int i = 0; i < 20; ++i) {
    output->play(piece);
    output->step();
  }
  // Stops, and begins again.
  output->play({"test", 1, 22050, 100, true, {}});
  output->play(piece);
  output->step();
}

}  // namespace
}  // namespace nao::speaker

#include "messages/speech_command.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace nao {
namespace {

std::string fault_of(const SpeechCommand& command) {
  const auto fault = check(command);
  return fault ? fault->code : "";
}

std::string fault_of_text(const std::string& text) {
  SpeechCommand command;
  command.text = text;
  return fault_of(command);
}

TEST(SpeechCommand, AllowsEveryTextOfUpTo1000Bytes) {
  EXPECT_EQ(fault_of_text("Hello"), "");
  EXPECT_EQ(fault_of_text("two\nlines\tand a tab\r\n"), "");
  EXPECT_EQ(fault_of_text("$(reboot); `ls` <speak/> \U0001f916"), "");
  EXPECT_EQ(fault_of_text(std::string(1000, 'a')), "");
}

TEST(SpeechCommand, RefusesTextsThatAreEmptyTooLongOrNoText) {
  EXPECT_EQ(fault_of_text(""), "text-missing");
  EXPECT_EQ(fault_of_text(" \n\t "), "text-missing");
  EXPECT_EQ(fault_of_text(std::string(1001, 'a')), "text-too-long");
  EXPECT_EQ(fault_of_text(std::string(10000, 'a')), "text-too-long");
  EXPECT_EQ(fault_of_text("caf\xe9"), "text-not-unicode");
  EXPECT_EQ(fault_of_text("a\x01"
                          "50P"),
            "text-control-character");
  EXPECT_EQ(fault_of_text(std::string("a\0b", 3)), "text-control-character");
  EXPECT_EQ(fault_of_text("\x7f"), "text-control-character");
  EXPECT_EQ(fault_of_text("\u0090"), "text-control-character");
  SpeechCommand command;
  command.text = "bell\a";
  EXPECT_EQ(to_sentence(*check(command)), "The text has the control character U+0007; remove it.");
}

TEST(SpeechCommand, RefusesNumbersOutOfRangeAndUnknownLanguages) {
  for (const double volume : {-0.1, 1.1, std::nan("")}) {
    EXPECT_EQ(fault_of({.text = "a", .volume = volume}), "volume-out-of-range");
  }
  for (const double rate : {0.4, 2.1, std::nan("")}) {
    EXPECT_EQ(fault_of({.text = "a", .rate = rate}), "rate-out-of-range");
  }
  EXPECT_EQ(fault_of({.text = "a", .language = "xx"}), "language-unknown");
  EXPECT_EQ(fault_of({.text = "a", .language = "../../etc/passwd"}), "language-unknown");
  EXPECT_EQ(fault_of({.operation = static_cast<SpeechCommand::Operation>(7), .text = "a"}),
            "speech-operation-unknown");
  EXPECT_EQ(fault_of({.operation = SpeechCommand::Operation::kStop}), "");
}

TEST(SpeechCommand, LooksUpLanguagesWithoutRegion) {
  EXPECT_GE(kSpeechLanguages.size(), 5u);
  EXPECT_EQ(find_speech_language("de"), "de");
  EXPECT_EQ(find_speech_language("de-AT"), "de");
  EXPECT_EQ(find_speech_language("zh-Hans-CN"), "zh");
  EXPECT_EQ(find_speech_language("EN-gb"), "en");
  EXPECT_EQ(find_speech_language(""), "");
  EXPECT_EQ(find_speech_language("-"), "");
}

TEST(SpeechCommand, IsTheSameAfterItsMessage) {
  SpeechCommand command{SpeechCommand::Operation::kSayAfter, "Hallo", "de", 0.5, 1.5};
  const SpeechCommand read = to_speech_command(to_message(command));
  EXPECT_EQ(read.operation, command.operation);
  EXPECT_EQ(read.text, command.text);
  EXPECT_EQ(read.language, command.language);
  EXPECT_EQ(read.volume, command.volume);
  EXPECT_EQ(read.rate, command.rate);
}

}  // namespace
}  // namespace nao

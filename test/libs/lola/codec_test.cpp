#include "lola/codec.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <string>

#include "common/random.h"
#include "test/libs/lola/lola_frames.h"

namespace nao {
namespace {

using Status = LolaDecoding::Status;

/** Bytes of a message put together by hand, independent of MsgpackWriter. */
class Bytes {
 public:
  Bytes& add(std::initializer_list<int> values) {
    for (const int value : values) bytes_.push_back(static_cast<uint8_t>(value));
    return *this;
  }
  Bytes& text(const std::string& text) {
    add({0xa0 + static_cast<int>(text.size())});
    bytes_.insert(bytes_.end(), text.begin(), text.end());
    return *this;
  }
  Bytes& number(float value) {
    const auto bits = std::bit_cast<uint32_t>(value);
    return add({0xca, static_cast<int>(bits >> 24), static_cast<int>(bits >> 16 & 0xff),
                static_cast<int>(bits >> 8 & 0xff), static_cast<int>(bits & 0xff)});
  }
  template <class Values>
  Bytes& numbers(const std::string& key, const Values& values) {
    text(key);
    if (values.size() < 16) {
      add({0x90 + static_cast<int>(values.size())});
    } else {
      add({0xdc, 0, static_cast<int>(values.size())});
    }
    for (const float value : values) number(value);
    return *this;
  }
  const std::vector<uint8_t>& get() const { return bytes_; }

 private:
  std::vector<uint8_t> bytes_;
};

template <class Message>
LolaDecoding decode(const Bytes& bytes, Message& message) {
  return nao::decode(bytes.get(), message);
}

template <class Message>
std::string error_of(const Bytes& bytes) {
  Message message;
  const LolaDecoding result = decode(bytes, message);
  EXPECT_EQ(result.status, Status::kMalformed);
  return result.error;
}

TEST(LolaCodec, WritesAStateOf896BytesInTheOrderOfTheFrame) {
  const LolaState state = numbered_state();
  Bytes expected;
  expected.add({0x8d});
  expected.numbers("Position", state.position).numbers("Stiffness", state.stiffness);
  expected.numbers("Temperature", state.temperature).numbers("Current", state.current);
  expected.text("Status").add({0xdc, 0, 25});
  for (const int value : state.status) expected.add({value});
  expected.numbers("Battery", state.battery).numbers("Accelerometer", state.accelerometer);
  expected.numbers("Gyroscope", state.gyroscope).numbers("Angles", state.angles);
  expected.numbers("Sonar", state.sonar).numbers("FSR", state.fsr).numbers("Touch", state.touch);
  expected.text("RobotConfig").add({0x94});
  for (const std::string& text : state.robot_config) expected.text(text);
  EXPECT_EQ(encoded(state), expected.get());
  EXPECT_EQ(expected.get().size(), 896u);
}

TEST(LolaCodec, WritesWholeNumbersAsFloat32) {
  LolaCommand command;
  command.chest = {0, 1, 2};
  EXPECT_EQ(encoded(command), Bytes().add({0x81}).numbers("Chest", *command.chest).get());
}

TEST(LolaCodec, WritesACommandOfAllKeysIn786Bytes) {
  const LolaCommand command = numbered_command();
  Bytes expected;
  expected.add({0x8b});
  expected.numbers("Position", *command.position).numbers("Stiffness", *command.stiffness);
  expected.numbers("REar", *command.right_ear).numbers("LEar", *command.left_ear);
  expected.numbers("Chest", *command.chest).numbers("LEye", *command.left_eye);
  expected.numbers("REye", *command.right_eye).numbers("LFoot", *command.left_foot);
  expected.numbers("RFoot", *command.right_foot).numbers("Skull", *command.skull);
  expected.text("Sonar").add({0x92, 0xc3, 0xc2});
  EXPECT_EQ(encoded(command), expected.get());
  EXPECT_EQ(expected.get().size(), kLolaCommandBytes);
}

TEST(LolaCodec, WritesPositionAndStiffnessIn276Bytes) {
  LolaCommand command;
  command.position.emplace();
  command.stiffness.emplace();
  EXPECT_EQ(encoded(command).size(), 276u);
}

TEST(LolaCodec, WritesNothingIntoTooLittleMemory) {
  std::array<uint8_t, 895> memory;
  EXPECT_EQ(encode(numbered_state(), memory), 0u);
}

TEST(LolaCodec, ReadsWhatItWrites) {
  LolaState state;
  ASSERT_EQ(nao::decode(encoded(numbered_state()), state).status, Status::kDone);
  EXPECT_EQ(encoded(state), encoded(numbered_state()));
  LolaCommand command;
  ASSERT_EQ(nao::decode(encoded(numbered_command()), command).status, Status::kDone);
  EXPECT_EQ(encoded(command), encoded(numbered_command()));
}

TEST(LolaCodec, ReadsPartialCommandsInAnyOrder) {
  Bytes bytes;
  bytes.add({0x82})
      .text("Sonar")
      .add({0x92, 0xc2, 0xc3})
      .numbers("Chest", std::array{0.f, .5f, 1.f});
  LolaCommand command;
  const LolaDecoding result = decode(bytes, command);
  ASSERT_EQ(result.status, Status::kDone);
  EXPECT_EQ(result.size, bytes.get().size());
  EXPECT_THAT(*command.sonar, testing::ElementsAre(false, true));
  EXPECT_THAT(*command.chest, testing::ElementsAre(0, 0.5f, 1));
  EXPECT_FALSE(command.position);
  EXPECT_FALSE(command.skull);
}

TEST(LolaCodec, AnEmptyCommandSetsNothing) {
  LolaCommand command = numbered_command();
  ASSERT_EQ(decode(Bytes().add({0x80}), command).status, Status::kDone);
  EXPECT_EQ(encoded(command), std::vector<uint8_t>{0x80});
}

TEST(LolaCodec, ReadsNumbersOfEveryType) {
  Bytes bytes;
  bytes.add({0xde, 0, 2}).text("Skull").add({0xdd, 0, 0, 0, 12});
  bytes.add({1, 0xcc, 2, 0xcd, 0, 3, 0xce, 0, 0, 0, 4, 0xcf, 0, 0, 0, 0, 0, 0, 0, 5});
  bytes.add({0xff, 0xd0, 0xfe, 0xd1, 0xff, 0xfd, 0xd2, 0xff, 0xff, 0xff, 0xfc});
  bytes.add({0xd3, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xfb}).number(0.5f);
  bytes.add({0xcb, 0x3f, 0xd0, 0, 0, 0, 0, 0, 0});
  bytes.add({0xd9, 5}).add({'S', 'o', 'n', 'a', 'r'}).add({0x92, 1, 0});
  LolaCommand command;
  const LolaDecoding result = decode(bytes, command);
  ASSERT_EQ(result.status, Status::kDone) << result.error;
  EXPECT_THAT(*command.skull, testing::ElementsAre(1, 2, 3, 4, 5, -1, -2, -3, -4, -5, 0.5f, 0.25f));
  EXPECT_THAT(*command.sonar, testing::ElementsAre(true, false));
}

TEST(LolaCodec, IgnoresUnknownKeys) {
  Bytes bytes;
  bytes.add({0x82}).text("Tail").add({0x82, 1, 0x92, 0xc0, 0xc4, 1, 7, 2, 0x81, 3, 4});
  bytes.numbers("LFoot", std::array{0.f, .5f, 1.f});
  LolaCommand command;
  ASSERT_EQ(decode(bytes, command).status, Status::kDone);
  EXPECT_TRUE(command.left_foot);
}

TEST(LolaCodec, EveryBeginningOfAMessageIsIncomplete) {
  const std::vector<uint8_t> state = encoded(numbered_state());
  const std::vector<uint8_t> command = encoded(numbered_command());
  for (size_t size = 0; size < state.size(); ++size) {
    LolaState read;
    ASSERT_EQ(nao::decode(std::span(state).first(size), read).status, Status::kIncomplete) << size;
  }
  for (size_t size = 0; size < command.size(); ++size) {
    LolaCommand read;
    ASSERT_EQ(nao::decode(std::span(command).first(size), read).status, Status::kIncomplete)
        << size;
  }
}

TEST(LolaCodec, NamesWhatIsWrong) {
  EXPECT_EQ(error_of<LolaCommand>(Bytes().add({0x93, 1, 2, 3})), "it is not a map");
  EXPECT_EQ(error_of<LolaCommand>(Bytes().add({0xc1})), "it is not a map");
  EXPECT_EQ(error_of<LolaCommand>(Bytes().add({0x81, 7, 7})), "a key is not text");
  EXPECT_EQ(error_of<LolaCommand>(Bytes().add({0x81}).text("Chest").add({0xa1, 'x'})),
            "Chest is not a list");
  EXPECT_EQ(error_of<LolaCommand>(Bytes().add({0x81}).text("Chest").add({0x92, 0, 0})),
            "Chest has 2 values and must have 3");
  EXPECT_EQ(error_of<LolaCommand>(Bytes().add({0x81}).text("Chest").add({0x93, 0, 0xa0, 0})),
            "a value of Chest has a wrong type or is out of range");
  EXPECT_EQ(error_of<LolaCommand>(Bytes().add({0x81}).text("Tail").add({0xc7, 1, 1, 1})),
            "a value is unreadable");
  Bytes doubled;
  doubled.add({0x82})
      .numbers("LFoot", std::array{0.f, 0.f, 0.f})
      .numbers("LFoot", std::array{1.f, 1.f, 1.f});
  EXPECT_EQ(error_of<LolaCommand>(doubled), "key LFoot is there twice");
  EXPECT_EQ(error_of<LolaState>(Bytes().add({0x81}).numbers("Sonar", std::array{0.f, 0.f})),
            "key Position is missing");
  Bytes status;
  status.add({0x81}).text("Status").add({0xdc, 0, 25, 0, 4});
  EXPECT_EQ(error_of<LolaState>(status), "a value of Status has a wrong type or is out of range");
}

TEST(LolaCodec, HostileLengthsNeverReadBeyondTheInput) {
  // A text, a binary, a list and a map of 4 G elements, as value of an unknown key.
  for (const int type : {0xdb, 0xc6, 0xdd, 0xdf}) {
    LolaCommand command;
    const Bytes bytes = Bytes().add({0x81}).text("Tail").add({type, 0xff, 0xff, 0xff, 0xff, 1});
    EXPECT_EQ(decode(bytes, command).status, Status::kIncomplete) << type;
  }
  EXPECT_EQ(
      error_of<LolaCommand>(Bytes().add({0x81}).text("Skull").add({0xdd, 0xff, 0xff, 0xff, 0xff})),
      "Skull has 4294967295 values and must have 12");
}

TEST(LolaCodec, ChangedBytesNeverMakeItReadBeyondTheInput) {
  Random random(3);
  const std::vector<uint8_t> state = encoded(numbered_state());
  for (int i = 0; i < 20000; ++i) {
    std::vector<uint8_t> bytes = state;
    for (int k = 0; k < 3; ++k) {
      bytes[static_cast<size_t>(random.uniform() * 896)] =
          static_cast<uint8_t>(random.uniform() * 256);
    }
    LolaState read;
    const LolaDecoding result = nao::decode(bytes, read);
    if (result.status == Status::kDone) {
      EXPECT_LE(result.size, bytes.size());
    }
    LolaCommand command;
    (void)nao::decode(bytes, command);
  }
}

template <class Message>
int num_messages(const std::vector<uint8_t>& bytes, size_t piece, LolaStream<Message>& stream) {
  int result = 0;
  Message message;
  for (size_t start = 0; start < bytes.size(); start += piece) {
    const size_t size = std::min({piece, bytes.size() - start, stream.free_memory().size()});
    std::copy_n(bytes.begin() + static_cast<long>(start), size, stream.free_memory().begin());
    stream.note_received(size);
    while (stream.next(message)) ++result;
  }
  return result;
}

TEST(LolaStream, FindsMessagesHoweverTheyAreCut) {
  std::vector<uint8_t> bytes;
  LolaCommand sonar;
  sonar.sonar = {true, true};
  for (int i = 0; i < 5; ++i) {
    for (const auto& part : {encoded(numbered_command()), encoded(sonar)}) {
      bytes.insert(bytes.end(), part.begin(), part.end());
    }
  }
  for (const size_t piece : {1, 2, 3, 10, 275, 276, 786, 1000, 1600}) {
    LolaStream<LolaCommand> stream;
    EXPECT_EQ(num_messages(bytes, piece, stream), 10) << piece;
    EXPECT_EQ(stream.error(), "");
  }
}

TEST(LolaStream, RejectsAnEndlessMessage) {
  // A binary of 4 GB under an unknown key.
  std::vector<uint8_t> bytes =
      Bytes().add({0x81}).text("Tail").add({0xc6, 0xff, 0xff, 0xff, 0xff}).get();
  bytes.resize(5000);
  LolaStream<LolaCommand> stream;
  EXPECT_EQ(num_messages(bytes, 100, stream), 0);
  EXPECT_EQ(stream.error(), "it is longer than 3584 bytes");
}

TEST(LolaStream, GivesNothingAfterAnError) {
  std::vector<uint8_t> bytes{0xc1};
  const std::vector<uint8_t> good = encoded(numbered_command());
  bytes.insert(bytes.end(), good.begin(), good.end());
  LolaStream<LolaCommand> stream;
  EXPECT_EQ(num_messages(bytes, 100, stream), 0);
  EXPECT_EQ(stream.error(), "it is not a map");
}

}  // namespace
}  // namespace nao

#include "phone-gateway/bluetooth/fragments.h"

#include <gtest/gtest.h>

#include <string>

namespace nao {
namespace {

using Result = FragmentReader::Result;

/** A message of a length, of different bytes. */
std::string message_of(size_t length) {
  std::string message;
  for (size_t i = 0; i < length; ++i) message.push_back(static_cast<char>(i * 7));
  return message;
}

TEST(Fragments, MakeTheMessageAgainAtAnyLengthOfValues) {
  for (const size_t value_bytes : {kMinValueBytes, size_t{182}, kMaxValueBytes}) {
    FragmentWriter writer(value_bytes);
    FragmentReader reader(10000);
    // More fragments than there are numbers.
    for (const size_t length : {1, 19, 20, 500, 9000, 3}) {
      writer.put(message_of(length));
      size_t num_fragments = 0;
      Result result = Result::kIncomplete;
      while (!writer.is_sent()) {
        const auto fragment = writer.next();
        ASSERT_TRUE(fragment);
        EXPECT_LE(fragment->size(), value_bytes);
        ASSERT_EQ(result, Result::kIncomplete);
        result = reader.read(*fragment);
        ++num_fragments;
        ASSERT_TRUE(writer.acknowledge(static_cast<uint8_t>(writer.num_made() % 128)));
      }
      EXPECT_EQ(result, Result::kMessage);
      EXPECT_EQ(reader.take_message(), message_of(length));
      EXPECT_EQ(num_fragments, (length + value_bytes - 2) / (value_bytes - 1));
    }
  }
}

TEST(Fragments, WaitForAcknowledgements) {
  FragmentWriter writer(101);
  writer.put(message_of(5000));
  int num_made = 0;
  while (writer.next()) ++num_made;
  EXPECT_EQ(num_made, 15) << "1500 bytes";
  EXPECT_FALSE(writer.is_sent());
  EXPECT_EQ(writer.unacknowledged(), 15u * 101);
  EXPECT_TRUE(writer.acknowledge(10));
  EXPECT_EQ(writer.unacknowledged(), 5u * 101);
  EXPECT_EQ(writer.num_acknowledged(), 10u);
  EXPECT_TRUE(writer.acknowledge(10)) << "nothing new";
  EXPECT_FALSE(writer.acknowledge(9)) << "went back";
  EXPECT_FALSE(writer.acknowledge(16)) << "was not sent";
  EXPECT_FALSE(writer.acknowledge(200)) << "is no number";
}

TEST(Fragments, AreFewEnoughForTheirNumbers) {
  FragmentWriter writer(kMinValueBytes);
  writer.put(message_of(5000));
  int num_made = 0;
  while (writer.next()) ++num_made;
  EXPECT_LT(num_made, 128);
}

TEST(Fragments, ThatAreLostRepeatedOrTooMuchAreFaults) {
  FragmentReader reader(8);
  EXPECT_EQ(reader.read(""), Result::kFault);
  EXPECT_EQ(reader.read(std::string("\x00"
                                    "abc",
                                    4)),
            Result::kIncomplete);
  EXPECT_EQ(reader.read(std::string("\x00"
                                    "abc",
                                    4)),
            Result::kFault)
      << "repeated";
  EXPECT_EQ(reader.read("\x02"
                        "abc"),
            Result::kFault)
      << "one is lost";
  EXPECT_EQ(reader.read("\x81"
                        "defghi"),
            Result::kFault)
      << "9 bytes";
  EXPECT_EQ(reader.read("\x81"
                        "defgh"),
            Result::kMessage);
  EXPECT_EQ(reader.take_message(), "abcdefgh");
  EXPECT_EQ(reader.read("\x07"), Result::kAcknowledgement);
  EXPECT_EQ(reader.awaited(), 7);
  EXPECT_EQ(reader.read(kConnectionEnd), Result::kFault) << "is the gateway's";
}

}  // namespace
}  // namespace nao

#include "phone-gateway/protocol/framing.h"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "remote.pb.h"

namespace nao {
namespace {

TEST(Framing, PutsTheLengthBeforeTheMessageMostSignificantByteFirst) {
  const std::string message(0x0102, 'x');
  const std::string framed = frame(message);
  EXPECT_EQ(framed.substr(0, 4), std::string("\0\0\1\2", 4));
  EXPECT_EQ(framed.substr(4), message);
}

TEST(Framing, FindsMessagesInPiecesOfAnySize) {
  const std::string stream = frame("one") + frame("") + frame("three");
  for (size_t piece = 1; piece <= stream.size(); ++piece) {
    FrameReader reader(kMaxRequestBytes);
    std::vector<std::string> messages;
    for (size_t start = 0; start < stream.size(); start += piece) {
      reader.add(std::string_view(stream).substr(start, piece));
      while (auto message = reader.next()) messages.push_back(*message);
    }
    EXPECT_EQ(messages, (std::vector<std::string>{"one", "", "three"})) << "pieces of " << piece;
    EXPECT_EQ(reader.num_waiting_bytes(), 0u);
  }
}

TEST(Framing, AcceptsTheLongestMessageAndRefusesOneByteMore) {
  FrameReader reader(10);
  reader.add(frame(std::string(10, 'x')));
  EXPECT_TRUE(reader.next().has_value());
  reader.add(frame(std::string(11, 'x')));
  EXPECT_FALSE(reader.next().has_value());
  EXPECT_TRUE(reader.is_oversized());
}

TEST(Framing, StoresNothingAfterAnOversizedLength) {
  FrameReader reader(10);
  reader.add("GET / HTTP/1.1\r\n");
  EXPECT_FALSE(reader.next().has_value());
  EXPECT_TRUE(reader.is_oversized());
  reader.add(std::string(100000, 'x'));
  EXPECT_EQ(reader.num_waiting_bytes(), 0u);
}

/** The bytes of an example of PROTOCOL.md: pairs of hexadecimal digits at the beginnings of its
 * lines.
 * @param index  Number of the code block, counted from 0. */
std::string example_bytes(int index) {
  std::ifstream document(PROTOCOL_MD);
  std::string bytes;
  int num_marks = 0;
  for (std::string line; std::getline(document, line);) {
    if (line == "```") ++num_marks;
    if (line == "```" || num_marks != 2 * index + 1) continue;
    std::istringstream words(line);
    for (std::string word; words >> word && word.size() == 2;) {
      bytes.push_back(static_cast<char>(std::stoi(word, nullptr, 16)));
    }
  }
  return bytes;
}

TEST(Framing, AgreesWithTheExamplesOfTheDocument) {
  naoremote::Request request;
  request.set_request_id(1);
  request.mutable_connect()->set_protocol_version(1);
  request.mutable_connect()->set_token("k7");
  request.mutable_connect()->set_client_name("Ana");
  EXPECT_EQ(frame(request.SerializeAsString()), example_bytes(0));

  naoremote::ServerMessage message;
  naoremote::State& state = *message.mutable_state();
  state.set_utime(123456);
  state.set_age_ms(1.5);
  for (const float angle : {0.5F, -0.25F}) state.add_joint_position(angle);
  for (const float x : {1.0F, 0.0F, 0.3125F}) state.add_torso_position(x);
  state.set_mode(naoremote::MODE_HOLDING);
  EXPECT_EQ(frame(message.SerializeAsString()), example_bytes(1));
}

}  // namespace
}  // namespace nao

#include "tools/nao-tools/channel_statistics.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <naolcm/stop_command_t.hpp>
#include <vector>

namespace nao {
namespace {

using testing::HasSubstr;

std::vector<uint8_t> encoded_stop() {
  naolcm::stop_command_t command{0, 1, "test", 2};
  std::vector<uint8_t> bytes(command.getEncodedSize());
  command.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  return bytes;
}

TEST(ChannelStatistics, MeasuresTheRateOfThePeriodThatEnded) {
  const auto bytes = encoded_stop();
  ChannelStatistics statistics;
  for (int i = 0; i < 50; ++i) {
    statistics.add("NAO_STOP_COMMAND", bytes.data(), static_cast<int>(bytes.size()), i * 0.02);
  }
  statistics.finish_period(1.0);
  const ChannelRecord& record = statistics.channels().at("NAO_STOP_COMMAND");
  EXPECT_EQ(record.type, "stop_command_t");
  EXPECT_DOUBLE_EQ(record.rate, 50);
  EXPECT_EQ(record.num_messages, 50);
  EXPECT_DOUBLE_EQ(record.bytes_per_second, 50.0 * static_cast<double>(bytes.size()));

  statistics.finish_period(2.0);
  EXPECT_DOUBLE_EQ(statistics.channels().at("NAO_STOP_COMMAND").rate, 0);
}

TEST(ChannelStatistics, CountsWhatItCannotDecode) {
  auto bytes = encoded_stop();
  ChannelStatistics statistics;
  statistics.add("A", bytes.data(), static_cast<int>(bytes.size()), 0);
  statistics.add("A", bytes.data(), static_cast<int>(bytes.size()) - 1, 0.1);
  statistics.add("B", "garbage", 7, 0.2);
  statistics.finish_period(1.0);
  EXPECT_EQ(statistics.channels().at("A").num_undecodable, 1);
  EXPECT_EQ(statistics.channels().at("B").type, "?");
  EXPECT_EQ(statistics.num_undecodable(), 2);
  EXPECT_THAT(statistics.to_text(1.0), HasSubstr("stop_command_t"));
  EXPECT_THAT(statistics.to_json(1.0), HasSubstr(R"("channel":"B","type":"?")"));
}

}  // namespace
}  // namespace nao

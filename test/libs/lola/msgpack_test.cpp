#include "lola/msgpack.h"

#include <gtest/gtest.h>

#include <array>
#include <vector>

namespace nao {
namespace {

using Kind = MsgpackReader::Kind;

TEST(Msgpack, SkipsNestedValuesAsAWhole) {
  // [{"a": [nil, true]}, 1.5 as float64], then 7.
  const std::vector<uint8_t> bytes{0x92, 0x81, 0xa1, 'a', 0x92, 0xc0, 0xc3, 0xcb, 0x3f,
                                   0xf8, 0,    0,    0,   0,    0,    0,    7};
  MsgpackReader reader(bytes);
  EXPECT_EQ(reader.skip(), Kind::kArray);
  EXPECT_EQ(reader.next().number, 7);
  EXPECT_EQ(reader.next().kind, Kind::kIncomplete);
}

TEST(Msgpack, DeepNestingNeedsNoStack) {
  const std::vector<uint8_t> bytes(1000000, 0x91);
  EXPECT_EQ(MsgpackReader(bytes).skip(), Kind::kIncomplete);
}

TEST(Msgpack, WritesLongListsAndTextsWithTheirLength) {
  std::array<uint8_t, 100> memory;
  MsgpackWriter writer(memory);
  writer.map(16);
  writer.text(std::string(40, 'x'));
  EXPECT_EQ(writer.size(), 3u + 3u + 40u);
  EXPECT_EQ(memory[0], 0xde);
  EXPECT_EQ(memory[2], 16);
  EXPECT_EQ(memory[3], 0xda);
  EXPECT_EQ(memory[5], 40);
}

}  // namespace
}  // namespace nao

#include "messages/utf8.h"

#include <gtest/gtest.h>

#include <string>

namespace nao {
namespace {

TEST(Utf8, ReadsCharactersOfOneToFourBytes) {
  const std::string text = "a\u00fc\u20ac\U0001f916";
  const std::array<Utf8Character, 4> expected{{{'a', 1}, {0xfc, 2}, {0x20ac, 3}, {0x1f916, 4}}};
  size_t position = 0;
  for (const Utf8Character& character : expected) {
    const auto read = read_utf8(text, position);
    ASSERT_TRUE(read);
    EXPECT_EQ(read->code, character.code);
    EXPECT_EQ(read->num_bytes, character.num_bytes);
    position += read->num_bytes;
  }
  EXPECT_FALSE(read_utf8(text, text.size()));
}

TEST(Utf8, RefusesWhatRfc3629Forbids) {
  for (const std::string& text : {
           std::string("\x80"),              // continuation without a beginning
           std::string("\xc3"),              // cut off
           std::string("\xe2\x82"),          // cut off
           std::string("\xf0\x9f\xa4"),      // cut off
           std::string("\xc3("),             // no continuation
           std::string("\xc0\xaf"),          // '/' in two bytes
           std::string("\xe0\x80\xaf"),      // '/' in three bytes
           std::string("\xf0\x80\x80\xaf"),  // '/' in four bytes
           std::string("\xed\xa0\x80"),      // surrogate
           std::string("\xf4\x90\x80\x80"),  // above U+10FFFF
           std::string("\xff"),
           std::string("\xf8\x88\x80\x80\x80"),
       }) {
    EXPECT_FALSE(read_utf8(text, 0)) << testing::PrintToString(text);
  }
}

}  // namespace
}  // namespace nao

#include "common/text_file.h"

#include <gtest/gtest.h>

#include "common/error.h"

namespace nao {
namespace {

TEST(TextFile, NamesTheFileThatCannotBeRead) {
  EXPECT_THROW(read_file("/no/such/file"), Error);
}

TEST(TextFile, DigestIsFnv1a) {
  // Test values of the draft.
  EXPECT_EQ(digest(""), 0xcbf29ce484222325u);
  EXPECT_EQ(digest("a"), 0xaf63dc4c8601ec8cu);
  EXPECT_EQ(digest("foobar"), 0x85944171f73967e8u);
}

}  // namespace
}  // namespace nao

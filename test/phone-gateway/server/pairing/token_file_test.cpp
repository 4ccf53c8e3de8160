#include "phone-gateway/server/pairing/token_file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include "common/error.h"
#include "test/support/temporary_folder.h"

namespace nao::gateway {
namespace {

TEST(TokenFile, IsCreatedOnceAndReused) {
  const TemporaryFolder folder;
  const std::string first = token_from_file(folder.path() / "token");
  EXPECT_EQ(first.size(), 9u);
  EXPECT_EQ(token_from_file(folder.path() / "token"), first);
}

TEST(TokenFile, CanOnlyBeReadByItsOwner) {
  const TemporaryFolder folder;
  token_from_file(folder.path() / "token");
  struct stat status = {};
  ASSERT_EQ(stat((folder.path() / "token").c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777, 0600u);
}

TEST(TokenFile, GivesTheTokenThatAUserHasWritten) {
  const TemporaryFolder folder;
  write_text(folder.path() / "token", "secret\n");
  EXPECT_EQ(token_from_file(folder.path() / "token"), "secret");
}

TEST(TokenFile, RefusesAnEmptyFileAndAMissingFolder) {
  const TemporaryFolder folder;
  write_text(folder.path() / "token", "");
  EXPECT_THROW(token_from_file(folder.path() / "token"), Error);
  EXPECT_THROW(token_from_file(folder.path() / "missing" / "token"), Error);
}

}  // namespace
}  // namespace nao::gateway

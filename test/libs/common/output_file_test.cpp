#include "common/output_file.h"

#include <gmock/gmock.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <csignal>

#include "common/error.h"
#include "test/support/temporary_folder.h"

namespace nao {
namespace {

using testing::HasSubstr;

class OutputFileTest : public testing::Test {
 protected:
  size_t num_files() const {
    const std::filesystem::directory_iterator files(folder_.path());
    return static_cast<size_t>(std::distance(begin(files), end(files)));
  }

  const TemporaryFolder folder_;
  const std::filesystem::path file_ = folder_.path() / "result";
};

TEST_F(OutputFileTest, AppearsWhenItIsFinished) {
  replace_file(file_, "old");
  {
    OutputFile output(file_);
    output.stream() << std::string(1'000'000, 'x') << std::flush;
    EXPECT_EQ(read_text(file_), "old");
    output.finish();
  }
  EXPECT_EQ(read_text(file_), std::string(1'000'000, 'x'));
  EXPECT_EQ(num_files(), 1u);
}

TEST_F(OutputFileTest, LeavesNothingIfItIsNotFinished) {
  {
    OutputFile file(file_);
    file.stream() << "half";
  }
  EXPECT_EQ(num_files(), 0u);
}

TEST_F(OutputFileTest, TellsWhyItCannotBeWrittenAndKeepsTheOldFile) {
  replace_file(file_, "old");
  // A limit of the size of files, which shows as a full disk does. Ignored, the signal is an error.
  rlimit limit{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &limit), 0);
  const rlimit small{100'000, limit.rlim_max};
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
  std::string why;
  try {
    replace_file(file_, std::string(1'000'000, 'x'));
  } catch (const Error& error) {
    why = error.what();
  }
  setrlimit(RLIMIT_FSIZE, &limit);
  std::signal(SIGXFSZ, handler);
  EXPECT_THAT(why, HasSubstr(file_.string() + ": File too large"));
  EXPECT_EQ(read_text(file_), "old");
  EXPECT_EQ(num_files(), 1u);
  EXPECT_THROW(replace_file(folder_.path() / "no" / "result", ""), Error);
}

TEST_F(OutputFileTest, FollowsLinksAndKeepsPermissions) {
  replace_file(file_, "old", 0600);
  const std::filesystem::path link = folder_.path() / "link";
  std::filesystem::create_symlink("result", link);
  replace_file(link, "new");
  EXPECT_TRUE(std::filesystem::is_symlink(link));
  EXPECT_EQ(read_text(file_), "new");
  struct stat status = {};
  ASSERT_EQ(stat(file_.c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777, 0600u);
}

TEST_F(OutputFileTest, WritesToADeviceDirectly) {
  replace_file("/dev/null", "text");
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
  EXPECT_THROW(replace_file("/dev/full", "text"), Error);
}

}  // namespace
}  // namespace nao

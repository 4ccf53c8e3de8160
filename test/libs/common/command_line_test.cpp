#include "common/command_line.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <vector>

namespace nao {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;

/** A program with subcommands, one of which has subcommands of its own. */
class CommandLineTest : public testing::Test {
 protected:
  CommandLineTest() : line_("Trials", "trial") {
    line_.add_subcommand("sprint", "Straight ahead")->add_option("--seed", seed_, "Number");
    line_.add_subcommand("kick", "The ball");
    CommandLine* world = line_.add_subcommand("world", "The simulator");
    world->add_subcommand("pause", "Stop");
    world->require_subcommand();
    line_.require_subcommand();
  }

  /** What is printed to stderr. */
  std::string parse(std::vector<const char*> words) {
    words.insert(words.begin(), "trial");
    testing::internal::CaptureStderr();
    status_ = line_.parse(static_cast<int>(words.size()), words.data());
    return testing::internal::GetCapturedStderr();
  }

  CommandLine line_;
  int seed_ = 0;
  std::optional<int> status_;
};

TEST_F(CommandLineTest, RunsWithASubcommandAndItsOptions) {
  EXPECT_THAT(parse({"sprint", "--seed", "3"}), IsEmpty());
  EXPECT_EQ(status_, std::nullopt);
  EXPECT_EQ(seed_, 3);
}

TEST_F(CommandLineTest, NamesAnUnknownSubcommandAndThoseThereAre) {
  EXPECT_THAT(parse({"gallop"}), AllOf(HasSubstr("'gallop'"), HasSubstr("sprint kick world")));
  EXPECT_EQ(status_, 2);
  EXPECT_THAT(parse({"world", "stop"}), AllOf(HasSubstr("'stop'"), HasSubstr("pause")));
  EXPECT_EQ(status_, 2);
}

TEST_F(CommandLineTest, SaysThatASubcommandIsMissing) {
  EXPECT_THAT(parse({}), HasSubstr("subcommand is required"));
  EXPECT_EQ(status_, 2);
}

TEST_F(CommandLineTest, NamesAValueThatIsNoNumber) {
  EXPECT_THAT(parse({"sprint", "--seed", "x"}), HasSubstr("--seed"));
  EXPECT_EQ(status_, 2);
}

}  // namespace
}  // namespace nao

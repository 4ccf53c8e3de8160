#include "messages/reason.h"

#include <gmock/gmock.h>

#include <cmath>
#include <set>
#include <sstream>

namespace nao {
namespace {

TEST(Reason, MakesASentenceOfCodeAndArguments) {
  EXPECT_EQ(to_sentence({"joint-unknown", {"\"Tail\""}}), "The robot has no joint \"Tail\".");
  EXPECT_EQ(to_sentence({"joint-value-not-finite", {"HeadYaw", "position"}}),
            "The position of joint HeadYaw is not a finite number.");
}

TEST(Reason, IsEmptyWithoutACode) {
  EXPECT_TRUE(Reason().empty());
  EXPECT_EQ(to_sentence(Reason()), "");
}

TEST(Reason, ShowsACodeThatTheTableDoesNotHave) {
  Reason reason;
  reason.code = "from-the-future";
  EXPECT_EQ(to_sentence(reason), "from-the-future");
}

TEST(Reason, ShowsAMissingArgumentAsItsPlaceholder) {
  EXPECT_EQ(to_sentence({"joint-unknown"}), "The robot has no joint {0}.");
}

TEST(Reason, DoesNotFillInPlaceholdersOfArguments) {
  EXPECT_EQ(to_sentence({"joint-value-not-finite", {"{1}", "x"}}),
            "The x of joint {1} is not a finite number.");
}

TEST(Reason, WritesNumbersBriefly) {
  EXPECT_EQ(to_argument(1.7), "1.7");
  EXPECT_EQ(to_argument(2), "2");
  EXPECT_EQ(to_argument(std::nan("")), "nan");
}

TEST(ReasonTable, HasLowerCaseCodesWithHyphensOnceEach) {
  std::set<std::string_view> codes;
  for (const ReasonEntry& entry : kReasons) {
    EXPECT_THAT(std::string(entry.code), testing::MatchesRegex("[a-z]+(-[a-z]+)*"));
    EXPECT_TRUE(codes.insert(entry.code).second) << entry.code << " is there twice";
  }
}

TEST(ReasonTable, UsesEveryArgumentAndNoOther) {
  for (const ReasonEntry& entry : kReasons) {
    size_t num_arguments = entry.arguments.empty() ? 0 : 1;
    for (char c : entry.arguments) num_arguments += c == ',' ? 1 : 0;
    for (size_t i = 0; i <= 9; ++i) {
      const std::string placeholder = "{" + std::to_string(i) + "}";
      EXPECT_EQ(entry.sentence.find(placeholder) != std::string_view::npos, i < num_arguments)
          << entry.code << " " << placeholder;
    }
  }
}

}  // namespace
}  // namespace nao

#include "phone-gateway/server/core/gateway_reasons.h"

#include <gmock/gmock.h>

#include <set>

namespace nao::gateway {
namespace {

TEST(GatewayReasons, FillTheArgumentsIntoTheSentence) {
  EXPECT_EQ(describe_reason(gateway_reason("control-taken", {"Ana"})), "Ana has control.");
  EXPECT_EQ(describe_reason(Reason("joint-unknown", {"Tail"})), "The robot has no joint Tail.")
      << "a reason of nao-motion";
}

TEST(GatewayReasons, AreWrittenIntoResponsesAndNotices) {
  naoremote::Response response;
  write_reason(gateway_reason("width-unsupported", {"319"}), response);
  EXPECT_EQ(response.reason_code(), "width-unsupported");
  ASSERT_EQ(response.reason_arguments_size(), 1);
  EXPECT_EQ(response.reason_arguments(0), "319");
  EXPECT_EQ(response.message(), "Image width 319 is none of 640, 320 and 160 pixels.");
}

TEST(GatewayReasons, HaveUniqueLowerCaseCodesThatNaoMotionDoesNotUse) {
  std::set<std::string_view> codes;
  for (const ReasonEntry& entry : kGatewayReasons) {
    EXPECT_THAT(std::string(entry.code), testing::MatchesRegex("[a-z]+(-[a-z]+)*"));
    EXPECT_TRUE(codes.insert(entry.code).second) << entry.code << " is there twice";
    EXPECT_EQ(find_reason_entry(entry.code), kReasons.size()) << entry.code;
  }
}

TEST(GatewayReasons, UseEveryArgumentAndNoOther) {
  for (const ReasonEntry& entry : kGatewayReasons) {
    size_t num_arguments = entry.arguments.empty() ? 0 : 1;
    for (const char c : entry.arguments) num_arguments += c == ',' ? 1 : 0;
    for (size_t i = 0; i <= 9; ++i) {
      const std::string placeholder = "{" + std::to_string(i) + "}";
      EXPECT_EQ(entry.sentence.find(placeholder) != std::string_view::npos, i < num_arguments)
          << entry.code << " " << placeholder;
    }
  }
}

}  // namespace
}  // namespace nao::gateway

#include "tools/nao-tools/channel_pattern.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/error.h"

namespace nao {
namespace {

TEST(ChannelPattern, MatchesWholeNames) {
  const ChannelPattern pattern("--channels", "NAO_.*STATE|WORLD");
  EXPECT_TRUE(pattern.matches("NAO_SENSOR_STATE"));
  EXPECT_TRUE(pattern.matches("WORLD"));
  EXPECT_FALSE(pattern.matches("NAO_SENSOR_STATES"));
  EXPECT_FALSE(pattern.matches("WORLD_TRUTH"));
  EXPECT_FALSE(pattern.matches("MY_WORLD"));
}

TEST(ChannelPattern, RefusesWhatIsNoRegularExpression) {
  EXPECT_THAT([] { ChannelPattern("--without", "NAO_("); },
              testing::ThrowsMessage<ConfigError>(
                  testing::StartsWith("--without NAO_( is not a regular expression: ")));
}

}  // namespace
}  // namespace nao

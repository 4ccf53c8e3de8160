#include "phone-gateway/server/pairing/phone_urls.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace nao::gateway {
namespace {

using testing::ElementsAre;

TEST(PhoneUrls, NameEveryOwnAddressOfAGatewayThatListensOnAll) {
  EXPECT_THAT(phone_urls({"0.0.0.0", 8080, false, "t"}, {"192.168.1.5", "10.0.0.2"}),
              ElementsAre("http://192.168.1.5:8080/#token=t", "http://10.0.0.2:8080/#token=t"));
}

TEST(PhoneUrls, NameTheAddressThatTheGatewayListensOn) {
  EXPECT_THAT(phone_urls({"10.0.0.2", 8443, true, "t"}, {"192.168.1.5"}),
              ElementsAre("https://10.0.0.2:8443/#token=t"));
  EXPECT_THAT(phone_urls({"fd00::1", 8080, false, "t"}, {}),
              ElementsAre("http://[fd00::1]:8080/#token=t"));
}

TEST(PhoneUrls, NameThisHostWithoutANetwork) {
  EXPECT_THAT(phone_urls({"0.0.0.0", 8080, false, "t"}, {}),
              ElementsAre("http://127.0.0.1:8080/#token=t"));
}

}  // namespace
}  // namespace nao::gateway

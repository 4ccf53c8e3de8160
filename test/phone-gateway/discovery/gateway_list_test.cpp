#include "phone-gateway/discovery/gateway_list.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace nao {
namespace {

GatewayService service(const std::string& name) {
  GatewayService service;
  service.name = name;
  service.address = "192.168.1.20";
  service.http_port = 8080;
  service.tcp_port = 7668;
  return service;
}

TEST(GatewayList, IsATableWithTheAddressesOfAppAndClients) {
  EXPECT_EQ(gateways_to_text({service("NAO on a"), service("Pepe on lab-b")}),
            "NAO on a       http://192.168.1.20:8080  tcp 192.168.1.20:7668\n"
            "Pepe on lab-b  http://192.168.1.20:8080  tcp 192.168.1.20:7668\n");
  EXPECT_EQ(gateways_to_text({}), "");
}

TEST(GatewayList, ShowsNoControlCharactersThatAnotherHostAnnounces) {
  EXPECT_THAT(gateways_to_text({service("\x1b[2Jx\n")}), testing::StartsWith("?[2Jx?  http"));
}

TEST(GatewayList, IsEmptyJsonWhereNothingIsKnown) {
  const ServiceDiscovery discovery(std::nullopt);
  EXPECT_EQ(gateways_to_json(discovery), R"({"announced_as":"","alias":"","gateways":[]})");
}

TEST(ServiceDiscovery, AliasesAreNumbered) {
  const std::vector<std::string> names = ServiceDiscovery::alias_names("nao");
  ASSERT_EQ(names.size(), 9u);
  EXPECT_EQ(names[0], "nao.local");
  EXPECT_EQ(names[8], "nao-9.local");
}

}  // namespace
}  // namespace nao

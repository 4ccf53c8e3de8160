#include "phone-gateway/server/pairing/own_addresses.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

namespace nao::gateway {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

constexpr char kTitles[] =
    "Iface\tDestination\tGateway \tFlags\tRefCnt\tUse\tMetric\tMask\t\tMTU\tWindow\tIRTT\n";

std::string default_interface_of(const std::string& routes) {
  std::istringstream table(kTitles + routes);
  return default_interface(table);
}

TEST(OwnAddresses, TakesTheDefaultRouteWithTheSmallestMetric) {
  EXPECT_EQ(default_interface_of("eth0\t0001A8C0\t00000000\t0001\t0\t0\t100\t00FFFFFF\t0\t0\t0\n"
                                 "wlan0\t00000000\t0101A8C0\t0003\t0\t0\t600\t00000000\t0\t0\t0\n"
                                 "eth0\t00000000\t0101A8C0\t0003\t0\t0\t100\t00000000\t0\t0\t0\n"),
            "eth0");
}

TEST(OwnAddresses, FindsNoDefaultRouteInATableWithoutOne) {
  EXPECT_EQ(default_interface_of(""), "");
  EXPECT_EQ(default_interface_of("eth0\t0001A8C0\t00000000\t0001\t0\t0\t0\t00FFFFFF\t0\t0\t0\n"),
            "");
  EXPECT_EQ(default_interface_of("eth0\t00000000\n\nx\n"), "") << "incomplete lines";
}

TEST(OwnAddresses, BeginsWithTheDefaultRoute) {
  EXPECT_THAT(reachable_addresses({{"eth1", "10.0.0.2"}, {"wlan0", "192.168.1.5"}}, "wlan0"),
              ElementsAre("192.168.1.5", "10.0.0.2"));
}

TEST(OwnAddresses, LeavesOutNetworksWithinThisHost) {
  EXPECT_THAT(reachable_addresses({{"docker0", "172.17.0.1"},
                                   {"br-1234", "172.18.0.1"},
                                   {"virbr0", "192.168.122.1"},
                                   {"veth12", "172.19.0.1"},
                                   {"eth0", "169.254.3.4"}},
                                  "docker0"),
              IsEmpty());
  EXPECT_THAT(reachable_addresses({{"br0", "192.168.1.5"}}, ""), ElementsAre("192.168.1.5"))
      << "a bridge to the outside";
}

}  // namespace
}  // namespace nao::gateway

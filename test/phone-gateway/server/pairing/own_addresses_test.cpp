#include "phone-gateway/server/pairing/own_addresses.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <sstream>

#include "test/support/temporary_folder.h"

namespace nao::gateway {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

constexpr char kTitles[] =
    "Iface\tDestination\tGateway \tFlags\tRefCnt\tUse\tMetric\tMask\t\tMTU\tWindow\tIRTT\n";

std::vector<std::string> default_interfaces_of(const std::string& routes) {
  std::istringstream table(kTitles + routes);
  return default_interfaces(table);
}

TEST(OwnAddresses, TakesTheDefaultRouteWithTheSmallestMetricFirst) {
  EXPECT_THAT(
      default_interfaces_of("eth0\t0001A8C0\t00000000\t0001\t0\t0\t100\t00FFFFFF\t0\t0\t0\n"
                            "wlan0\t00000000\t0101A8C0\t0003\t0\t0\t600\t00000000\t0\t0\t0\n"
                            "eth0\t00000000\t0101A8C0\t0003\t0\t0\t100\t00000000\t0\t0\t0\n"),
      ElementsAre("eth0", "wlan0"));
}

TEST(OwnAddresses, FindsNoDefaultRouteInATableWithoutOne) {
  EXPECT_THAT(default_interfaces_of(""), IsEmpty());
  EXPECT_THAT(default_interfaces_of("eth0\t0001A8C0\t00000000\t0001\t0\t0\t0\t00FFFFFF\t0\t0\t0\n"),
              IsEmpty());
  EXPECT_THAT(default_interfaces_of("eth0\t00000000\n\nx\n"), IsEmpty()) << "incomplete lines";
}

TEST(OwnAddresses, BeginsWithTheDefaultRoute) {
  EXPECT_THAT(reachable_addresses({{"eth1", "10.0.0.2"}, {"wlan0", "192.168.1.5"}}, {"wlan0"}),
              ElementsAre("192.168.1.5", "10.0.0.2"));
}

TEST(OwnAddresses, EndsWithTheVpnAlsoIfItHasTheDefaultRoute) {
  EXPECT_THAT(reachable_addresses({{"tun0", "10.8.0.2", InterfaceKind::kPointToPoint},
                                   {"eth0", "10.0.0.2"},
                                   {"wlan0", "192.168.1.5"}},
                                  {"tun0", "wlan0"}),
              ElementsAre("192.168.1.5", "10.0.0.2", "10.8.0.2"));
}

TEST(OwnAddresses, LeavesOutNetworksWithinThisHost) {
  EXPECT_THAT(reachable_addresses({{"cni0", "10.42.0.1", InterfaceKind::kInnerBridge},
                                   {"lxcbr0", "10.0.3.1", InterfaceKind::kInnerBridge},
                                   {"vmnet8", "172.16.5.1", InterfaceKind::kVirtual},
                                   {"eth1", "169.254.3.4"},
                                   {"eth0", "192.168.1.5"}},
                                  {"cni0"}),
              ElementsAre("192.168.1.5"));
}

TEST(OwnAddresses, OfAContainerAreVirtual) {
  EXPECT_THAT(reachable_addresses({{"docker0", "172.17.0.1", InterfaceKind::kInnerBridge},
                                   {"eth0", "172.18.0.2", InterfaceKind::kVirtual}},
                                  {"eth0"}),
              ElementsAre("172.18.0.2"));
}

TEST(OwnAddresses, KindOfAnInterfaceIsWhatIsBelowIt) {
  const TemporaryFolder folder;
  const auto make = [&](const std::string& path) {
    std::filesystem::create_directories(folder.path() / path);
  };
  make("wlan0/device");
  make("br0/bridge");
  make("br0/lower_bond0");
  make("bond0/lower_eth0");
  make("eth0/device");
  make("docker0/bridge");
  make("docker0/lower_veth1");
  make("veth1/lower_docker0");
  const auto kind = [&](const std::string& name, bool is_point_to_point = false) {
    return interface_kind(folder.path(), name, is_point_to_point);
  };
  EXPECT_EQ(kind("wlan0"), InterfaceKind::kHardware);
  EXPECT_EQ(kind("br0"), InterfaceKind::kHardware) << "a bridge to the outside";
  EXPECT_EQ(kind("docker0"), InterfaceKind::kInnerBridge);
  EXPECT_EQ(kind("veth1"), InterfaceKind::kVirtual);
  EXPECT_EQ(kind("tailscale0", true), InterfaceKind::kPointToPoint);
}

}  // namespace
}  // namespace nao::gateway

#include "phone-gateway/server/core/gateway_core.h"

#include <gtest/gtest.h>

#include <limits>

#include "test/phone-gateway/server/core/gateway_fixture.h"

namespace nao::gateway {
namespace {

using naoremote::Notice;

// ---- Connecting ---------------------------------------------------------------------------------

using GatewayConnecting = GatewayFixture;

TEST_F(GatewayConnecting, DescribesTheRobot) {
  Client client = open();
  const auto response = ask(client, make_connect(""));
  EXPECT_EQ(response.error(), naoremote::OK);
  EXPECT_EQ(response.connected().protocol_version(), 1u);
  EXPECT_EQ(response.connected().server_version(), "0.1.0");
  EXPECT_EQ(response.connected().client_id(), client.id);
  EXPECT_EQ(response.connected().robot().joints_size(), 4);
  EXPECT_EQ(response.connected().control().driver_id(), 0u);
  EXPECT_EQ(core_->sessions().num_connected(), 1);
}

TEST_F(GatewayConnecting, ComesBeforeEverythingElse) {
  Client client = open();
  EXPECT_EQ(ping(client).error(), naoremote::NOT_CONNECTED);
  EXPECT_EQ(take_control(client).error(), naoremote::NOT_CONNECTED);
  EXPECT_EQ(stop(client).error(), naoremote::NOT_CONNECTED);
  EXPECT_EQ(ask(client, make_connect("")).error(), naoremote::OK);
  EXPECT_EQ(ask(client, make_connect("")).error(), naoremote::INVALID_ARGUMENT) << "twice";
}

TEST_F(GatewayConnecting, NeedsTheTokenFromOtherHosts) {
  Client without = open(false, "192.168.1.7");
  EXPECT_EQ(ask(without, make_connect("")).error(), naoremote::WRONG_TOKEN);
  EXPECT_TRUE(core_->is_closing(without.id));
  Client with = open(false, "192.168.1.7");
  EXPECT_EQ(ask(with, make_connect("secret")).error(), naoremote::OK);
  Client wrong_here = open(true);
  EXPECT_EQ(ask(wrong_here, make_connect("secrets")).error(), naoremote::WRONG_TOKEN);
  Client typed = open(false, "192.168.1.7");
  EXPECT_EQ(ask(typed, make_connect("Sec-RET ")).error(), naoremote::OK);
}

TEST_F(GatewayConnecting, PausesAnAddressAfterFiveWrongTokens) {
  for (int i = 0; i < 5; ++i) {
    Client guesser = open(false, "192.168.1.7");
    ask(guesser, make_connect("guess"));
  }
  Client guesser = open(false, "192.168.1.7");
  EXPECT_EQ(ask(guesser, make_connect("secret")).error(), naoremote::WRONG_TOKEN);
  Client other = open(false, "192.168.1.8");
  EXPECT_EQ(ask(other, make_connect("secret")).error(), naoremote::OK);
  pass(10.1);
  Client later = open(false, "192.168.1.7");
  EXPECT_EQ(ask(later, make_connect("secret")).error(), naoremote::OK);
}

TEST_F(GatewayConnecting, RefusesOtherVersionsWithAReason) {
  for (const unsigned version : {0u, 2u, 4294967295u}) {
    Client client = open();
    const auto response = ask(client, make_connect("", version));
    EXPECT_EQ(response.error(), naoremote::WRONG_VERSION);
    EXPECT_FALSE(response.message().empty());
    EXPECT_TRUE(core_->is_closing(client.id));
  }
}

TEST_F(GatewayConnecting, IsRefusedTo129thClient) {
  std::vector<Client> clients;
  for (int i = 0; i < 128; ++i) clients.push_back(connect("client"));
  Client one_more = open();
  EXPECT_EQ(ask(one_more, make_connect("")).error(), naoremote::TOO_MANY_CLIENTS);
  core_->closed(clients[3].id, "test", now_);
  connect("client");
}

TEST_F(GatewayConnecting, IsRefusedToThe33rdClientOfAnAddress) {
  for (int i = 0; i < 32; ++i) {
    Client client = open(false, "192.168.1.7");
    EXPECT_EQ(ask(client, make_connect("secret")).error(), naoremote::OK);
  }
  Client one_more = open(false, "192.168.1.7");
  EXPECT_EQ(ask(one_more, make_connect("secret")).error(), naoremote::TOO_MANY_CLIENTS);
  Client other = open(false, "192.168.1.8");
  EXPECT_EQ(ask(other, make_connect("secret")).error(), naoremote::OK);
}

TEST_F(GatewayConnecting, GivesEachClientAUniqueName) {
  connect("Ana");
  connect("Ana");
  connect("the operator");
  connect("");
  std::vector<std::string> names;
  for (const auto& [id, session] : core_->sessions().all()) names.push_back(session->name);
  EXPECT_EQ(names, (std::vector<std::string>{"Ana", "Ana 2", "the operator 2", "phone 4"}));
}

TEST_F(GatewayConnecting, TimesOutAfterFiveSeconds) {
  Client client = open();
  pass(4.9);
  EXPECT_FALSE(core_->is_closing(client.id));
  pass(0.2);
  EXPECT_TRUE(core_->is_closing(client.id));
  EXPECT_EQ(notices(client, Notice::CLOSING).size(), 1u);
}

TEST_F(GatewayConnecting, ReportsUnavailableComponents) {
  has_camera_ = false;
  has_motion_ = false;
  pass(4);
  Client client = connect("Ana");
  EXPECT_EQ(notices(client, Notice::COMPONENT_CHANGED).size(), 3u);
}

// ---- Requests -----------------------------------------------------------------------------------

using GatewayRequests = GatewayFixture;

TEST_F(GatewayRequests, AreAnsweredOnceWithTheirId) {
  Client client = connect("Ana");
  const size_t num_before = client.received.size();
  const auto response = ping(client);
  EXPECT_EQ(response.pong().client_utime(), 7u);
  EXPECT_EQ(response.pong().num_clients(), 1u);
  EXPECT_NEAR(static_cast<double>(response.pong().robot_utime()), now_ * 1e6, 1e3);
  EXPECT_EQ(client.received.size(), num_before + 1);
}

TEST_F(GatewayRequests, ThatAreMalformedAreRefusedAndFinallyCloseTheConnection) {
  Client client = connect("Ana");
  for (int i = 0; i < 11; ++i) (void)core_->receive(client.id, "\xff\xff\xff", now_);
  collect(client);
  EXPECT_EQ(client.received[1].response().error(), naoremote::INVALID_REQUEST);
  EXPECT_TRUE(core_->is_closing(client.id));
}

TEST_F(GatewayRequests, AreAnsweredBeforeTheNoticesThatTheyCause) {
  Client ana = connect("Ana");
  take_control(ana);
  ASSERT_GE(ana.received.size(), 2u);
  EXPECT_TRUE(ana.received[ana.received.size() - 2].has_response());
  EXPECT_EQ(ana.received.back().notice().kind(), Notice::CONTROL_CHANGED);
  Client refused = open();
  ask(refused, make_connect("", 2));
  ASSERT_EQ(refused.received.size(), 2u);
  EXPECT_EQ(refused.received[0].response().reason_code(), "protocol-version-unsupported");
  EXPECT_EQ(refused.received[1].notice().kind(), Notice::CLOSING);
}

TEST_F(GatewayRequests, WithoutAUseCaseAreInvalid) {
  Client client = connect("Ana");
  EXPECT_EQ(ask(client, naoremote::Request()).error(), naoremote::INVALID_REQUEST);
  EXPECT_FALSE(core_->is_closing(client.id));
}

TEST_F(GatewayRequests, OverAHundredASecondAreRefusedExceptStop) {
  Client client = connect("Ana");
  int num_refused = 0;
  for (int i = 0; i < 300; ++i) num_refused += ping(client).error() == naoremote::TOO_MANY_REQUESTS;
  EXPECT_GE(num_refused, 200);
  EXPECT_EQ(stop(client).error(), naoremote::OK);
  EXPECT_EQ(num_sent<StopCommand>(), 1);
  naoremote::Request request;
  request.mutable_ping();
  EXPECT_GT(core_->receive(client.id, request.SerializeAsString(), now_), 0) << "reading pauses";
  pass(1);
  EXPECT_EQ(ping(client).error(), naoremote::OK);
}

TEST_F(GatewayRequests, OfAClientThatDoesNotReadArePaused) {
  Client client = connect("Ana");
  naoremote::Request request;
  request.mutable_ping();
  double pause = 0;
  for (int i = 0; i < 60 && pause == 0; ++i) {
    pass(0.02);
    pause = core_->receive(client.id, request.SerializeAsString(), now_);
  }
  EXPECT_GT(pause, 0);
}

TEST_F(GatewayRequests, OutOfRangeSendNoCommand) {
  Client client = connect_driver("Ana");
  sent_.clear();
  EXPECT_EQ(walk(client, std::numeric_limits<double>::quiet_NaN()).error(),
            naoremote::INVALID_ARGUMENT);
  EXPECT_EQ(go_to(client, "Split").error(), naoremote::INVALID_ARGUMENT);
  EXPECT_EQ(turn_head(client, 1e9).error(), naoremote::INVALID_ARGUMENT);
  pass(1);
  EXPECT_TRUE(sent_.empty());
}

// ---- Ends ---------------------------------------------------------------------------------------

using GatewayCloses = GatewayFixture;

TEST_F(GatewayCloses, ASilentConnectionAfterFiveSeconds) {
  Client ana = connect_driver("Ana");
  pass(4.9);
  ping(ana);
  pass(4.9);
  EXPECT_FALSE(core_->is_closing(ana.id));
  pass(0.2);
  EXPECT_TRUE(core_->is_closing(ana.id));
  EXPECT_EQ(core_->robot().driving().driver(), 0u);
  EXPECT_EQ(notices(ana, Notice::CLOSING).size(), 1u);
}

TEST_F(GatewayCloses, AConnectionWhoseNoticesAreNotRead) {
  Client ana = connect("Ana");
  Client ben = connect("Ben");
  for (int i = 0; i < 200; ++i) {
    take_control(ben);
    release_control(ben);
    naoremote::Request request;
    request.mutable_stop();
    (void)core_->receive(ana.id, request.SerializeAsString(), now_);
    pass(0.04);
  }
  EXPECT_TRUE(core_->is_closing(ana.id));
  EXPECT_FALSE(core_->is_closing(ben.id));
}

TEST_F(GatewayCloses, EverythingWhenItShutsDown) {
  Client ana = connect_driver("Ana");
  walk(ana, 0.1);
  core_->shut_down(now_);
  EXPECT_EQ(last_walk().vx, 0);
  EXPECT_TRUE(core_->is_closing(ana.id));
}

TEST_F(GatewayCloses, WithAnAuditEvent) {
  Client ana = connect_driver("Ana");
  core_->closed(ana.id, "closed by the client", now_);
  Client far = open(false, "192.168.1.7");
  ask(far, make_connect("guess"));
  std::vector<std::string> events;
  for (const AuditEvent& event : audit_) events.push_back(event.event);
  EXPECT_EQ(events, (std::vector<std::string>{"connected", "drives", "disconnected", "refused"}));
  EXPECT_EQ(audit_.back().address, "192.168.1.7");
  EXPECT_EQ(audit_.back().detail, "token-wrong") << "the code, not what the client sent";
}

}  // namespace
}  // namespace nao::gateway

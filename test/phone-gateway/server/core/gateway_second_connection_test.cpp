// A client with two connections.
#include "test/phone-gateway/server/core/gateway_fixture.h"

namespace nao::gateway {
namespace {

class SecondConnection : public GatewayFixture {
 protected:
  /** A client that has offered a key, and drives. */
  Client connect_with_key(const std::string& key) {
    Client client = open();
    naoremote::Request request;
    request.mutable_connect()->set_protocol_version(kProtocolVersion);
    request.mutable_connect()->set_join_key(key);
    EXPECT_EQ(ask(client, request).error(), naoremote::OK);
    EXPECT_EQ(take_control(client).error(), naoremote::OK);
    EXPECT_EQ(subscribe(client, 60, 30).error(), naoremote::OK);
    return client;
  }

  /** Sends Join. The answer is a message of the new connection. */
  Client join(uint32_t client_id, const std::string& key) {
    Client second = open(false, "10.0.0.1");
    naoremote::Request request;
    request.set_request_id(kJoinId);
    request.mutable_join()->set_client_id(client_id);
    request.mutable_join()->set_key(key);
    (void)core_->receive(second.id, request.SerializeAsString(), now_);
    collect(second);
    return second;
  }

  naoremote::Response answer_to(const Client& client, uint32_t id) const {
    for (const auto& message : client.received) {
      if (message.has_response() && message.response().request_id() == id) {
        return message.response();
      }
    }
    ADD_FAILURE() << "no answer";
    return {};
  }

  naoremote::Request walk_request(uint32_t id, double vx) const {
    naoremote::Request request;
    request.set_request_id(id);
    request.mutable_walk_turn()->set_vx(vx);
    return request;
  }
  void receive(const Client& client, const naoremote::Request& request) {
    (void)core_->receive(client.id, request.SerializeAsString(), now_);
  }

  static constexpr uint32_t kJoinId = 1000000;
};

TEST_F(SecondConnection, CarriesTheImagesOfItsClient) {
  Client ana = connect_with_key("k");
  Client second = join(ana.id, "k");
  EXPECT_EQ(answer_to(second, kJoinId).error(), naoremote::OK);
  EXPECT_TRUE(core_->is_connected(second.id));
  pass(0.1);
  receive_image(1);
  EXPECT_EQ(images(second).size(), 1u);
  EXPECT_TRUE(images(ana).empty());
  EXPECT_GT(num_states(ana), 0);
  EXPECT_EQ(num_states(second), 0) << "without losses";
  EXPECT_EQ(core_->sessions().num_connected(), 1);
}

TEST_F(SecondConnection, CarriesEveryOtherStateAndCopiesOfAnswersWhilePacketsGetLost) {
  Client ana = connect_with_key("k");
  Client second = join(ana.id, "k");
  core_->set_repeated_packets(ana.id, 1, now_);
  for (int i = 0; i < 10; ++i) {
    pass(0.02);
    collect(ana);
    collect(second);
  }
  EXPECT_NEAR(num_states(ana), num_states(second), 1);
  EXPECT_GT(num_states(second), 3);
  const auto answer = walk(ana, 0.1);
  collect(second);
  EXPECT_EQ(answer_to(second, answer.request_id()).error(), naoremote::OK);
}

TEST_F(SecondConnection, NeedsTheKeyOfItsClient) {
  Client ana = connect_with_key("k");
  Client without_key = connect("Ben");
  for (const auto& [id, key] :
       {std::pair{ana.id, "wrong"}, {ana.id, ""}, {without_key.id, ""}, {999u, "k"}}) {
    Client second = join(id, key);
    EXPECT_EQ(answer_to(second, kJoinId).error(), naoremote::INVALID_ARGUMENT);
    EXPECT_TRUE(core_->is_closing(second.id));
  }
  receive_image(1);
  EXPECT_EQ(images(ana).size(), 1u);
}

TEST_F(SecondConnection, MayBringARequestFirstWhichIsThenTakenOnce) {
  Client ana = connect_with_key("k");
  Client second = join(ana.id, "k");
  receive(second, walk_request(100, 0.1));
  EXPECT_DOUBLE_EQ(last_walk().vx, 0.1);
  receive(second, walk_request(101, 0));
  EXPECT_EQ(last_walk().vx, 0);
  collect(ana);
  const size_t num_messages = ana.received.size();
  receive(ana, walk_request(100, 0.1));
  EXPECT_EQ(last_walk().vx, 0) << "a stick that was released does not walk later";
  collect(ana);
  EXPECT_EQ(ana.received.size(), num_messages) << "one answer";
}

TEST_F(SecondConnection, LetsNoOlderMotionFollowANewerOne) {
  Client ana = connect_with_key("k");
  Client second = join(ana.id, "k");
  receive(second, walk_request(101, 0));
  receive(ana, walk_request(100, 0.1));
  collect(ana);
  EXPECT_EQ(answer_to(ana, 100).error(), naoremote::TOO_LATE);
  EXPECT_EQ(num_sent<WalkCommand>(), 0);
}

TEST_F(SecondConnection, KeepsItsClientAliveAndEndsWithIt) {
  Client ana = connect_with_key("k");
  Client second = join(ana.id, "k");
  for (uint32_t i = 0; i < 10; ++i) {
    pass(1);
    receive(second, walk_request(200 + i, 0));
  }
  EXPECT_TRUE(core_->is_connected(ana.id));
  core_->closed(ana.id, "test", now_);
  EXPECT_TRUE(core_->is_closing(second.id));
  receive(second, walk_request(300, 0.1));
  EXPECT_EQ(num_sent<WalkCommand>(), 0);
}

TEST_F(SecondConnection, MayEndOrBeReplaced) {
  Client ana = connect_with_key("k");
  Client before = join(ana.id, "k");
  Client second = join(ana.id, "k");
  EXPECT_TRUE(core_->is_closing(before.id));
  core_->closed(before.id, "test", now_);
  receive_image(1);
  EXPECT_EQ(images(second).size(), 1u);
  core_->closed(second.id, "test", now_);
  pass(0.1);
  receive_image(2);
  EXPECT_EQ(images(ana).size(), 1u) << "images come over the first one again";
}

}  // namespace
}  // namespace nao::gateway

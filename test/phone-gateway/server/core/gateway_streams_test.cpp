#include "phone-gateway/server/core/gateway_core.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "test/phone-gateway/server/core/gateway_fixture.h"

namespace nao::gateway {
namespace {

// ---- States and images ------------------------------------------------------------------------

using GatewayStreams = GatewayFixture;

TEST_F(GatewayStreams, HaveTheRequestedRate) {
  Client ana = connect("Ana");
  subscribe(ana, 25, 0);
  for (int i = 0; i < 200; ++i) {
    pass(0.02);
    collect(ana);
  }
  EXPECT_NEAR(num_states(ana), 100, 3);
}

TEST_F(GatewayStreams, SpreadStatesOverClientsThatSubscribedTogether) {
  std::vector<Client> clients;
  for (int i = 0; i < 32; ++i) {
    clients.push_back(connect("client " + std::to_string(i)));
    EXPECT_EQ(subscribe(clients.back(), 30, 0).error(), naoremote::OK);
  }
  std::vector<int> num_served;
  for (int tick = 0; tick < 200; ++tick) {
    now_ += 0.01;
    RobotSnapshot robot;
    robot.utime = static_cast<int64_t>(now_ * 1e6);
    core_->robot().set_state(robot, now_);
    num_served.push_back(0);
    for (const Client& client : clients) {
      while (core_->next(client.id, true, now_).message) ++num_served.back();
    }
  }
  EXPECT_EQ(num_served.front(), 32) << "the first state is sent to all at once";
  EXPECT_LE(*std::max_element(num_served.begin() + 2, num_served.end()), 17) << "half of them";
  EXPECT_NEAR(std::accumulate(num_served.begin(), num_served.end(), 0), 32 * 60, 64);
}

TEST_F(GatewayStreams, AreEncodedOnceForAllClientsWithTheirAge) {
  Client one = connect("one");
  Client two = connect("two");
  subscribe(one, 60, 30);
  subscribe(two, 60, 30);
  const auto age_ms = [](const MessageBytes& bytes) {
    naoremote::ServerMessage message;
    EXPECT_TRUE(message.ParseFromString(*bytes));
    return message.has_state() ? message.state().age_ms() : message.image().age_ms();
  };
  pass(0.1);
  receive_image(1);
  collect(one);
  collect(two);
  pass(0.04);
  receive_image(2);
  const auto arrive = [&] {
    for (const Client* client : {&one, &two}) core_->set_unacknowledged(client->id, 0, now_);
  };
  arrive();
  // A state, then an image.
  for (int i = 0; i < 2; ++i) {
    const MessageBytes bytes = core_->next(one.id, true, now_).message;
    ASSERT_TRUE(bytes);
    EXPECT_EQ(core_->next(two.id, true, now_ + 0.0005).message, bytes);
  }
  pass(0.02);
  receive_image(3);
  arrive();
  for (int i = 0; i < 2; ++i) {
    const double age = age_ms(core_->next(one.id, true, now_).message);
    EXPECT_NEAR(age_ms(core_->next(two.id, true, now_ + 0.3).message), age + 300, 1)
        << "encoded again";
  }
}

TEST_F(GatewayStreams, NeedTheLinkMeasuredForImagesOnly) {
  Client ana = connect("Ana");
  subscribe(ana, 50, 10);
  pass(0.1);
  EXPECT_FALSE(core_->next(ana.id, true, now_).measures_image) << "states alone";
  receive_image(1);
  EXPECT_FALSE(core_->next(ana.id, false, now_).measures_image) << "it waits on a free link";
  EXPECT_TRUE(core_->next(ana.id, true, now_).measures_image) << "it is under way";
  core_->set_unacknowledged(ana.id, 0, now_);
  EXPECT_FALSE(core_->next(ana.id, true, now_).measures_image);
}

TEST_F(GatewayStreams, SkipStatesForASlowClientAndSendNoOldOnes) {
  Client ana = connect("Ana");
  subscribe(ana, 50, 0);
  pass(3);
  const int num_before = num_states(ana);
  EXPECT_EQ(num_before, 1) << "one state, the newest";
  EXPECT_LT(ana.received.back().state().age_ms(), 25);
  const auto& session = *core_->sessions().find(ana.id);
  EXPECT_NEAR(static_cast<double>(session.outbox.num_skipped()), 149, 3);
}

TEST_F(GatewayStreams, HaveTheNewestImageOfTheRequestedSize) {
  Client ana = connect("Ana");
  subscribe(ana, 0, 10);
  receive_image(1, 640);
  pass(0.1);
  EXPECT_TRUE(images(ana).empty()) << "another size";
  receive_image(2);
  pass(0.1);
  receive_image(3);
  ASSERT_EQ(images(ana).size(), 1u);
  EXPECT_EQ(images(ana)[0].jpeg(), "jpeg 3");
  pass(0.2);
  EXPECT_EQ(images(ana).size(), 1u) << "the same one is not sent twice";
}

TEST_F(GatewayStreams, HaveTheAgeOfAnImageSinceItsExposure) {
  Client ana = connect("Ana");
  subscribe(ana, 0, 10);
  receive_image(static_cast<int64_t>((now_ - 0.05) * 1e6));
  ASSERT_EQ(images(ana).size(), 1u);
  EXPECT_NEAR(images(ana)[0].age_ms(), 50, 5);
}

TEST_F(GatewayStreams, RequestTheHighestRateOfAllClientsFromTheCamera) {
  EXPECT_TRUE(core_->robot().streams().camera_requests(now_).empty());
  Client ana = connect("Ana");
  Client ben = connect("Ben");
  subscribe(ana, 0, 10);
  subscribe(ben, 0, 20);
  auto requests = core_->robot().streams().camera_requests(now_);
  ASSERT_EQ(requests.size(), 1u);
  EXPECT_EQ(requests[0].rate, 20);
  EXPECT_EQ(requests[0].image.width, 320u);
  core_->closed(ben.id, "test", now_);
  subscribe(ana, 10, 0);
  EXPECT_TRUE(core_->robot().streams().camera_requests(now_).empty());
}

TEST_F(GatewayStreams, RepeatTheLastStateOnceASecondWithoutARobot) {
  Client ana = connect("Ana");
  subscribe(ana, 10, 0);
  pass(0.5);
  collect(ana);
  has_robot_ = false;
  pass(0.1);
  ana.received.clear();
  for (int i = 0; i < 40; ++i) {
    pass(0.1);
    ping(ana);
  }
  EXPECT_NEAR(num_states(ana), 4, 1);
  for (const auto& message : ana.received) {
    if (!message.has_state()) continue;
    EXPECT_EQ(message.state().mode(), naoremote::MODE_NO_ROBOT);
  }
}

naoremote::Request get_state() {
  naoremote::Request request;
  request.mutable_get_state()->set_with_image(true);
  return request;
}

TEST_F(GatewayStreams, CanBePolled) {
  Client ana = connect("Ana");
  auto polled = ask(ana, get_state()).state_and_image();
  EXPECT_EQ(polled.state().joint_position_size(), 4);
  EXPECT_EQ(polled.state().mode(), naoremote::MODE_HOLDING);
  EXPECT_FALSE(polled.has_image());
  EXPECT_EQ(core_->robot().streams().camera_requests(now_).size(), 1u) << "polling requests images";
  receive_image(5);
  polled = ask(ana, get_state()).state_and_image();
  EXPECT_EQ(polled.image().jpeg(), "jpeg 5");
  EXPECT_FALSE(ask(ana, get_state()).state_and_image().has_image()) << "it has been sent already";
  pass(2.1);
  EXPECT_TRUE(core_->robot().streams().camera_requests(now_).empty());
}

TEST_F(GatewayStreams, HaveNoStateBeforeTheFirstOneIsReceived) {
  has_motion_ = false;
  restart(GatewayLimits{});
  Client ana = connect("Ana");
  EXPECT_EQ(ask(ana, get_state()).error(), naoremote::ROBOT_UNAVAILABLE);
}

}  // namespace
}  // namespace nao::gateway

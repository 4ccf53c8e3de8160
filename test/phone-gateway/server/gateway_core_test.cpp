#include "phone-gateway/server/gateway_core.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numeric>

#include "test/phone-gateway/server/gateway_fixture.h"

namespace nao {
namespace {

using naoremote::Notice;

// ---- Connecting ---------------------------------------------------------------------------------

using GatewayConnecting = GatewayFixture;

naoremote::Request hello(const std::string& token, unsigned version = kProtocolVersion) {
  naoremote::Request request;
  request.mutable_connect()->set_protocol_version(version);
  request.mutable_connect()->set_token(token);
  return request;
}

TEST_F(GatewayConnecting, DescribesTheRobot) {
  Phone phone = open();
  const auto response = ask(phone, hello(""));
  EXPECT_EQ(response.error(), naoremote::OK);
  EXPECT_EQ(response.connected().protocol_version(), 1u);
  EXPECT_EQ(response.connected().server_version(), "0.1.0");
  EXPECT_EQ(response.connected().client_id(), phone.id);
  EXPECT_EQ(response.connected().robot().joints_size(), 4);
  EXPECT_EQ(response.connected().control().driver_id(), 0u);
  EXPECT_EQ(core_->num_connected(), 1);
}

TEST_F(GatewayConnecting, ComesBeforeEverythingElse) {
  Phone phone = open();
  EXPECT_EQ(ping(phone).error(), naoremote::NOT_CONNECTED);
  EXPECT_EQ(take_control(phone).error(), naoremote::NOT_CONNECTED);
  EXPECT_EQ(stop(phone).error(), naoremote::NOT_CONNECTED);
  EXPECT_EQ(ask(phone, hello("")).error(), naoremote::OK);
  EXPECT_EQ(ask(phone, hello("")).error(), naoremote::INVALID_ARGUMENT) << "twice";
}

TEST_F(GatewayConnecting, NeedsTheTokenFromElsewhere) {
  Phone without = open(false, "192.168.1.7");
  EXPECT_EQ(ask(without, hello("")).error(), naoremote::WRONG_TOKEN);
  EXPECT_TRUE(core_->is_closing(without.id));
  Phone with = open(false, "192.168.1.7");
  EXPECT_EQ(ask(with, hello("secret")).error(), naoremote::OK);
  Phone wrong_here = open(true);
  EXPECT_EQ(ask(wrong_here, hello("Secret")).error(), naoremote::WRONG_TOKEN);
}

TEST_F(GatewayConnecting, MakesGuessersOfTokensWaitAndNobodyElse) {
  for (int i = 0; i < 5; ++i) {
    Phone guesser = open(false, "192.168.1.7");
    ask(guesser, hello("guess"));
  }
  Phone guesser = open(false, "192.168.1.7");
  EXPECT_EQ(ask(guesser, hello("secret")).error(), naoremote::WRONG_TOKEN);
  Phone other = open(false, "192.168.1.8");
  EXPECT_EQ(ask(other, hello("secret")).error(), naoremote::OK);
  pass(10.1);
  Phone later = open(false, "192.168.1.7");
  EXPECT_EQ(ask(later, hello("secret")).error(), naoremote::OK);
}

TEST_F(GatewayConnecting, RefusesOtherVersionsWithASentence) {
  for (const unsigned version : {0u, 2u, 4294967295u}) {
    Phone phone = open();
    const auto response = ask(phone, hello("", version));
    EXPECT_EQ(response.error(), naoremote::WRONG_VERSION);
    EXPECT_FALSE(response.message().empty());
    EXPECT_TRUE(core_->is_closing(phone.id));
  }
}

TEST_F(GatewayConnecting, EndsAfter32Clients) {
  std::vector<Phone> phones;
  for (int i = 0; i < 32; ++i) phones.push_back(connect("phone"));
  Phone one_more = open();
  EXPECT_EQ(ask(one_more, hello("")).error(), naoremote::TOO_MANY_CLIENTS);
  core_->closed(phones[3].id, "test", now_);
  connect("phone");
}

TEST_F(GatewayConnecting, LetsNoAddressTakeAllPlaces) {
  for (int i = 0; i < 8; ++i) {
    Phone phone = open(false, "192.168.1.7");
    EXPECT_EQ(ask(phone, hello("secret")).error(), naoremote::OK);
  }
  Phone one_more = open(false, "192.168.1.7");
  EXPECT_EQ(ask(one_more, hello("secret")).error(), naoremote::TOO_MANY_CLIENTS);
  Phone other = open(false, "192.168.1.8");
  EXPECT_EQ(ask(other, hello("secret")).error(), naoremote::OK);
}

TEST_F(GatewayConnecting, GivesEveryoneANameOfTheirOwn) {
  connect("Ana");
  connect("Ana");
  connect("the operator");
  connect("");
  std::vector<std::string> names;
  for (const auto& [id, session] : core_->sessions()) names.push_back(session->name);
  EXPECT_EQ(names, (std::vector<std::string>{"Ana", "Ana 2", "the operator 2", "phone 4"}));
}

TEST_F(GatewayConnecting, HasFiveSeconds) {
  Phone phone = open();
  pass(4.9);
  EXPECT_FALSE(core_->is_closing(phone.id));
  pass(0.2);
  EXPECT_TRUE(core_->is_closing(phone.id));
  EXPECT_EQ(notices(phone, Notice::CLOSING).size(), 1u);
}

TEST_F(GatewayConnecting, TellsWhatIsMissing) {
  camera_speaks_ = false;
  motion_speaks_ = false;
  pass(4);
  Phone phone = connect("Ana");
  EXPECT_EQ(notices(phone, Notice::COMPONENT_CHANGED).size(), 3u);
}

// ---- Requests -----------------------------------------------------------------------------------

using GatewayRequests = GatewayFixture;

TEST_F(GatewayRequests, AreAnsweredOnceEachWithTheirNumber) {
  Phone phone = connect("Ana");
  const size_t num_before = phone.received.size();
  const auto response = ping(phone);
  EXPECT_EQ(response.pong().client_utime(), 7u);
  EXPECT_EQ(response.pong().num_clients(), 1u);
  EXPECT_NEAR(static_cast<double>(response.pong().robot_utime()), now_ * 1e6, 1e3);
  EXPECT_EQ(phone.received.size(), num_before + 1);
}

TEST_F(GatewayRequests, ThatAreNoneAreRefusedAndInTheEndClosed) {
  Phone phone = connect("Ana");
  for (int i = 0; i < 11; ++i) (void)core_->receive(phone.id, "\xff\xff\xff", now_);
  collect(phone);
  EXPECT_EQ(phone.received[1].response().error(), naoremote::INVALID_REQUEST);
  EXPECT_TRUE(core_->is_closing(phone.id));
}

TEST_F(GatewayRequests, WithoutAUseCaseAreInvalid) {
  Phone phone = connect("Ana");
  EXPECT_EQ(ask(phone, naoremote::Request()).error(), naoremote::INVALID_REQUEST);
  EXPECT_FALSE(core_->is_closing(phone.id));
}

TEST_F(GatewayRequests, OverAHundredASecondAreRefusedButStopIsHeard) {
  Phone phone = connect("Ana");
  int num_refused = 0;
  for (int i = 0; i < 300; ++i) num_refused += ping(phone).error() == naoremote::TOO_MANY_REQUESTS;
  EXPECT_GE(num_refused, 200);
  EXPECT_EQ(stop(phone).error(), naoremote::OK);
  EXPECT_EQ(num_sent<StopMotion>(), 1);
  naoremote::Request request;
  request.mutable_ping();
  EXPECT_GT(core_->receive(phone.id, request.SerializeAsString(), now_), 0) << "reading pauses";
  pass(1);
  EXPECT_EQ(ping(phone).error(), naoremote::OK);
}

TEST_F(GatewayRequests, OfAPhoneThatReadsNothingPause) {
  Phone phone = connect("Ana");
  naoremote::Request request;
  request.mutable_ping();
  double pause = 0;
  for (int i = 0; i < 60 && pause == 0; ++i) {
    pass(0.02);
    pause = core_->receive(phone.id, request.SerializeAsString(), now_);
  }
  EXPECT_GT(pause, 0);
}

TEST_F(GatewayRequests, OutOfRangeMoveNothing) {
  Phone phone = connect_driver("Ana");
  sent_.clear();
  EXPECT_EQ(walk(phone, std::numeric_limits<double>::quiet_NaN()).error(),
            naoremote::INVALID_ARGUMENT);
  EXPECT_EQ(go_to(phone, "Split").error(), naoremote::INVALID_ARGUMENT);
  EXPECT_EQ(turn_head(phone, 1e9).error(), naoremote::INVALID_ARGUMENT);
  pass(1);
  EXPECT_TRUE(sent_.empty());
}

// ---- Who drives ---------------------------------------------------------------------------------

using GatewayDriving = GatewayFixture;

TEST_F(GatewayDriving, NeedsControl) {
  Phone ana = connect("Ana");
  EXPECT_EQ(go_to(ana, "Crouch").error(), naoremote::NO_CONTROL);
  Phone ben = connect_driver("Ben");
  const auto response = go_to(ana, "Crouch");
  EXPECT_EQ(response.error(), naoremote::CONTROL_TAKEN);
  EXPECT_EQ(response.control().driver_name(), "Ben");
  EXPECT_TRUE(sent_.empty());
  EXPECT_EQ(go_to(ben, "Crouch").error(), naoremote::OK);
}

TEST_F(GatewayDriving, IsRefusedWithTheHoldersNameUntilGivenBack) {
  Phone ana = connect_driver("Ana");
  Phone ben = connect("Ben");
  const auto refused = take_control(ben);
  EXPECT_EQ(refused.error(), naoremote::CONTROL_TAKEN);
  EXPECT_EQ(refused.control().driver_name(), "Ana");
  EXPECT_FALSE(refused.control().is_mine());
  EXPECT_EQ(release_control(ana).error(), naoremote::OK);
  EXPECT_TRUE(take_control(ben).control().is_mine());
  const auto changes = notices(ana, Notice::CONTROL_CHANGED);
  ASSERT_EQ(changes.size(), 3u) << "Ana took, Ana gave back, Ben took";
  EXPECT_EQ(changes.back().control().driver_name(), "Ben");
}

TEST_F(GatewayDriving, PassesOnAfterTenSecondsWithoutACommand) {
  Phone ana = connect_driver("Ana");
  Phone ben = connect("Ben");
  go_to(ana, "Crouch");
  for (int i = 0; i < 10; ++i) {
    pass(0.98);
    ping(ana);
    EXPECT_EQ(take_control(ben).error(), naoremote::CONTROL_TAKEN);
  }
  pass(0.3);
  EXPECT_EQ(take_control(ben).error(), naoremote::OK);
  EXPECT_EQ(go_to(ana, "Crouch").error(), naoremote::CONTROL_TAKEN);
}

TEST_F(GatewayDriving, IsFreedByDisconnecting) {
  Phone ana = connect_driver("Ana");
  Phone ben = connect("Ben");
  core_->closed(ana.id, "test", now_);
  EXPECT_EQ(core_->driver(), 0u);
  EXPECT_EQ(notices(ben, Notice::CONTROL_CHANGED).size(), 1u);
  EXPECT_EQ(take_control(ben).error(), naoremote::OK);
}

TEST_F(GatewayDriving, IsTakenByTheOperatorFromTheOwnHostOnly) {
  Phone ana = connect_driver("Ana");
  Phone far = open(false, "192.168.1.7");
  EXPECT_EQ(operate(far, naoremote::Operate::TAKE).error(), naoremote::NOT_CONNECTED);
  EXPECT_EQ(ask(far, hello("secret")).error(), naoremote::OK);
  EXPECT_EQ(operate(far, naoremote::Operate::TAKE).error(), naoremote::NOT_ALLOWED);
  Phone console = open();
  EXPECT_EQ(operate(console, naoremote::Operate::TAKE).error(), naoremote::OK);
  core_->closed(console.id, "test", now_);
  EXPECT_EQ(go_to(ana, "Crouch").error(), naoremote::CONTROL_TAKEN);
  pass(1);
  ping(ana);
  EXPECT_EQ(take_control(ana).error(), naoremote::CONTROL_TAKEN);
  Phone again = open();
  EXPECT_EQ(operate(again, naoremote::Operate::RELEASE).error(), naoremote::OK);
  EXPECT_EQ(take_control(ana).error(), naoremote::OK);
}

TEST_F(GatewayDriving, TheOperatorListsAndKicks) {
  Phone ana = connect_driver("Ana");
  Phone console = open();
  const auto clients = operate(console, naoremote::Operate::LIST).clients();
  ASSERT_EQ(clients.clients_size(), 1);
  EXPECT_EQ(clients.clients(0).name(), "Ana");
  EXPECT_TRUE(clients.clients(0).is_driver());
  EXPECT_EQ(operate(console, naoremote::Operate::KICK, ana.id).error(), naoremote::OK);
  EXPECT_TRUE(core_->is_closing(ana.id));
  EXPECT_EQ(core_->driver(), 0u);
  EXPECT_EQ(operate(console, naoremote::Operate::KICK, 99).error(), naoremote::INVALID_ARGUMENT);
}

// ---- Walking ------------------------------------------------------------------------------------

using GatewayWalking = GatewayFixture;

TEST_F(GatewayWalking, GoesOnUnderOneNumberWhileRepeated) {
  Phone ana = connect_driver("Ana");
  for (int i = 0; i < 10; ++i) {
    EXPECT_EQ(walk(ana, 0.1).error(), naoremote::OK);
    pass(0.2);
  }
  EXPECT_GE(num_sent<WalkVelocity>(), 20) << "repeated at 10 Hz";
  EXPECT_DOUBLE_EQ(last_walk().vx, 0.1);
  for (const NumberedCommand& sent : sent_) {
    EXPECT_EQ(sent.command_id, sent_.front().command_id);
    EXPECT_EQ(sent.source, "phone.1." + std::to_string(ana.id));
  }
}

TEST_F(GatewayWalking, EndsHalfASecondAfterTheLastCommand) {
  Phone ana = connect_driver("Ana");
  walk(ana, 0.1);
  pass(0.48);
  EXPECT_GT(last_walk().vx, 0);
  pass(0.04);
  EXPECT_EQ(last_walk().vx, 0);
  pass(1);
  const int num_walks = num_sent<WalkVelocity>();
  EXPECT_EQ(std::get<WalkVelocity>(sent_[sent_.size() - 3].command).vx, 0) << "zero, three times";
  pass(5);
  EXPECT_EQ(num_sent<WalkVelocity>(), num_walks) << "then silence";
}

TEST_F(GatewayWalking, EndsAtOnceOnZero) {
  Phone ana = connect_driver("Ana");
  walk(ana, 0.1);
  walk(ana, 0);
  EXPECT_EQ(last_walk().vx, 0);
  const int num_walks = num_sent<WalkVelocity>();
  pass(0.3);
  walk(ana, 0);
  EXPECT_EQ(num_sent<WalkVelocity>(), num_walks + 2) << "more zeros end no walk";
}

TEST_F(GatewayWalking, EndsAtOnceWhenTheDriverGoes) {
  Phone ana = connect_driver("Ana");
  walk(ana, 0.1);
  core_->closed(ana.id, "test", now_);
  EXPECT_EQ(last_walk().vx, 0);
}

TEST_F(GatewayWalking, EndsAtOnceWhenControlIsLost) {
  Phone ana = connect_driver("Ana");
  walk(ana, 0.1);
  release_control(ana);
  EXPECT_EQ(last_walk().vx, 0);
  take_control(ana);
  walk(ana, 0.1);
  Phone console = open();
  operate(console, naoremote::Operate::TAKE);
  EXPECT_EQ(last_walk().vx, 0);
}

TEST_F(GatewayWalking, ToAPlaceEndsWhenTheDriverGoes) {
  Phone ana = connect_driver("Ana");
  naoremote::Request request;
  request.mutable_move_to()->set_x(2);
  EXPECT_EQ(ask(ana, request).error(), naoremote::OK);
  answer_last(CommandStatus::kAccepted);
  core_->closed(ana.id, "test", now_);
  EXPECT_EQ(num_sent<StopMotion>(), 1);
}

TEST_F(GatewayWalking, StaysStoppedUntilTheDriverLetsGo) {
  Phone ana = connect_driver("Ana");
  Phone ben = connect("Ben");
  walk(ana, 0.1);
  pass(0.1);
  EXPECT_EQ(stop(ben).error(), naoremote::OK) << "everybody may stop";
  const int num_walks = num_sent<WalkVelocity>();
  for (int i = 0; i < 10; ++i) {
    EXPECT_EQ(walk(ana, 0.1).error(), naoremote::STOPPED);
    pass(0.1);
  }
  EXPECT_EQ(num_sent<WalkVelocity>(), num_walks);
  EXPECT_EQ(walk(ana, 0).error(), naoremote::OK);
  EXPECT_EQ(walk(ana, 0.1).error(), naoremote::OK);
  stop(ben);
  EXPECT_EQ(walk(ana, 0.1).error(), naoremote::STOPPED);
  pass(0.52);
  EXPECT_EQ(walk(ana, 0.1).error(), naoremote::OK) << "letting go is also silence";
}

TEST_F(GatewayWalking, BeginsAnewAfterItWasRefused) {
  Phone ana = connect_driver("Ana");
  walk(ana, 0.1);
  const int64_t first = sent_.back().command_id;
  answer_last(CommandStatus::kRefused, "The robot lies on its back.");
  const int num_walks = num_sent<WalkVelocity>();
  pass(0.4);
  EXPECT_EQ(num_sent<WalkVelocity>(), num_walks) << "a refused walk is not repeated";
  walk(ana, 0.1);
  EXPECT_GT(sent_.back().command_id, first);
  answer_last(CommandStatus::kRefused, "The robot lies on its back.");
  EXPECT_EQ(notices(ana, Notice::COMMAND_RESULT).size(), 1u) << "told once in two seconds";
}

TEST_F(GatewayWalking, GivesWayToAPosture) {
  Phone ana = connect_driver("Ana");
  walk(ana, 0.1);
  go_to(ana, "Crouch");
  answer_last(CommandStatus::kAccepted);
  sent_.clear();
  pass(2);
  EXPECT_TRUE(sent_.empty()) << "no zero velocity that would end the posture";
}

TEST_F(GatewayWalking, GoesOnWhileTheHeadTurns) {
  Phone ana = connect_driver("Ana");
  walk(ana, 0.1);
  turn_head(ana, 0.1);
  pass(0.3);
  EXPECT_GT(last_walk().vx, 0);
  EXPECT_GE(num_sent<WalkVelocity>(), 3);
}

// ---- Other commands -----------------------------------------------------------------------------

using GatewayCommands = GatewayFixture;

TEST_F(GatewayCommands, AreRepeatedUntilHeardAndTheirOutcomeTold) {
  Phone ana = connect_driver("Ana");
  const auto response = go_to(ana, "Crouch");
  pass(0.3);
  EXPECT_GE(num_sent<PostureGoal>(), 3);
  answer_last(CommandStatus::kAccepted);
  const int num_heard = num_sent<PostureGoal>();
  pass(2);
  EXPECT_EQ(num_sent<PostureGoal>(), num_heard);
  answer_last(CommandStatus::kDone);
  answer_last(CommandStatus::kDone);
  const auto outcomes = notices(ana, Notice::COMMAND_RESULT);
  ASSERT_EQ(outcomes.size(), 2u);
  EXPECT_EQ(outcomes[0].status(), Notice::ACCEPTED);
  EXPECT_EQ(outcomes[1].status(), Notice::DONE);
  EXPECT_EQ(outcomes[1].request_id(), response.request_id());
  EXPECT_FALSE(outcomes[1].message().empty());
}

TEST_F(GatewayCommands, ThatNobodyHearsFail) {
  Phone ana = connect_driver("Ana");
  go_to(ana, "Crouch");
  pass(1.6);
  const auto outcomes = notices(ana, Notice::COMMAND_RESULT);
  ASSERT_EQ(outcomes.size(), 1u);
  EXPECT_EQ(outcomes[0].status(), Notice::FAILED);
}

TEST_F(GatewayCommands, ThatAreUnheardDoNotOutliveANewerOne) {
  Phone ana = connect_driver("Ana");
  go_to(ana, "Crouch");
  stop(ana);
  sent_.clear();
  pass(1);
  EXPECT_EQ(num_sent<PostureGoal>(), 0);
  EXPECT_GE(num_sent<StopMotion>(), 5);
}

TEST_F(GatewayCommands, AreRefusedWhileMotionOrRobotIsGone) {
  Phone ana = connect_driver("Ana");
  motion_speaks_ = false;
  pass(1.2);
  EXPECT_EQ(go_to(ana, "Crouch").error(), naoremote::ROBOT_UNAVAILABLE);
  EXPECT_EQ(walk(ana, 1).error(), naoremote::ROBOT_UNAVAILABLE);
  EXPECT_TRUE(sent_.empty()) << "and not kept for later";
  motion_speaks_ = true;
  pass(0.1);
  EXPECT_TRUE(sent_.empty());
  EXPECT_EQ(go_to(ana, "Crouch").error(), naoremote::OK);
}

TEST_F(GatewayCommands, FailWhenMotionGoesAway) {
  Phone ana = connect_driver("Ana");
  go_to(ana, "Crouch");
  answer_last(CommandStatus::kAccepted);
  motion_speaks_ = false;
  pass(2);
  const auto outcomes = notices(ana, Notice::COMMAND_RESULT);
  ASSERT_EQ(outcomes.size(), 2u);
  EXPECT_EQ(outcomes[1].status(), Notice::FAILED);
  const auto parts = notices(ana, Notice::COMPONENT_CHANGED);
  ASSERT_EQ(parts.size(), 2u) << "motion, and with it the robot";
  EXPECT_FALSE(parts[0].is_available());
}

TEST_F(GatewayCommands, HaveNumbersThatAreNeverReused) {
  Phone ana = connect_driver("Ana");
  go_to(ana, "Crouch");
  const int64_t first = sent_.back().command_id;
  EXPECT_EQ(first, 1000) << "where the identity says";
  stop(ana);
  EXPECT_EQ(sent_.back().command_id, 1001);
}

// ---- States and images ------------------------------------------------------------------------

using GatewayStreams = GatewayFixture;

TEST_F(GatewayStreams, ComeAtTheWishedRate) {
  Phone ana = connect("Ana");
  subscribe(ana, 25, 0);
  for (int i = 0; i < 200; ++i) {
    pass(0.02);
    collect(ana);
  }
  EXPECT_NEAR(num_states(ana), 100, 3);
}

TEST_F(GatewayStreams, ShareOutTheStatesAmongPhonesThatBeganTogether) {
  std::vector<Phone> phones;
  for (int i = 0; i < 32; ++i) {
    phones.push_back(connect("phone " + std::to_string(i)));
    EXPECT_EQ(subscribe(phones.back(), 30, 0).error(), naoremote::OK);
  }
  std::vector<int> num_served;
  for (int tick = 0; tick < 200; ++tick) {
    now_ += 0.01;
    RobotSnapshot robot;
    robot.utime = static_cast<int64_t>(now_ * 1e6);
    core_->set_robot(robot, now_);
    num_served.push_back(0);
    for (const Phone& phone : phones) {
      while (core_->next_message(phone.id, now_)) ++num_served.back();
    }
  }
  EXPECT_EQ(num_served.front(), 32) << "nobody waits for the first state";
  EXPECT_LE(*std::max_element(num_served.begin() + 2, num_served.end()), 11) << "30 of 100 of 32";
  EXPECT_NEAR(std::accumulate(num_served.begin(), num_served.end(), 0), 32 * 60, 64);
}

TEST_F(GatewayStreams, AreEncodedOnceForAllPhonesAndTellTheirAge) {
  Phone one = connect("one");
  Phone two = connect("two");
  subscribe(one, 60, 30);
  subscribe(two, 60, 30);
  const auto age_ms = [](const MessageBytes& bytes) {
    naoremote::ServerMessage message;
    EXPECT_TRUE(message.ParseFromString(*bytes));
    return message.has_state() ? message.state().age_ms() : message.image().age_ms();
  };
  pass(0.1);
  put_image(1);
  collect(one);
  collect(two);
  pass(0.04);
  put_image(2);
  // A state, then an image.
  for (int i = 0; i < 2; ++i) {
    const MessageBytes bytes = core_->next_message(one.id, now_);
    ASSERT_TRUE(bytes);
    EXPECT_EQ(core_->next_message(two.id, now_ + 0.0005), bytes);
  }
  pass(0.02);
  put_image(3);
  for (int i = 0; i < 2; ++i) {
    const double age = age_ms(core_->next_message(one.id, now_));
    EXPECT_NEAR(age_ms(core_->next_message(two.id, now_ + 0.3)), age + 300, 1) << "a late one";
  }
}

TEST_F(GatewayStreams, SkipForASlowPhoneAndAreNeverOld) {
  Phone ana = connect("Ana");
  subscribe(ana, 50, 0);
  pass(3);
  const int num_before = num_states(ana);
  EXPECT_EQ(num_before, 1) << "one state for all that it did not take";
  EXPECT_LT(ana.received.back().state().age_ms(), 25);
  const auto& session = *core_->sessions().at(ana.id);
  EXPECT_NEAR(static_cast<double>(session.outbox.num_skipped()), 149, 3);
}

TEST_F(GatewayStreams, OfImagesCarryTheNewestOfTheWishedSize) {
  Phone ana = connect("Ana");
  subscribe(ana, 0, 10);
  put_image(1, 640);
  pass(0.1);
  EXPECT_TRUE(images(ana).empty()) << "another size";
  put_image(2);
  pass(0.1);
  put_image(3);
  ASSERT_EQ(images(ana).size(), 1u);
  EXPECT_EQ(images(ana)[0].jpeg(), "jpeg 3");
  pass(0.2);
  EXPECT_EQ(images(ana).size(), 1u) << "the same one is not sent twice";
}

TEST_F(GatewayStreams, OfImagesTellTheTimeSinceWhatTheyShow) {
  Phone ana = connect("Ana");
  subscribe(ana, 0, 10);
  put_image(static_cast<int64_t>((now_ - 0.05) * 1e6));
  ASSERT_EQ(images(ana).size(), 1u);
  EXPECT_NEAR(images(ana)[0].age_ms(), 50, 5);
}

TEST_F(GatewayStreams, AskTheCameraForTheMostThatSomebodyWants) {
  EXPECT_TRUE(core_->camera_requests(now_).empty());
  Phone ana = connect("Ana");
  Phone ben = connect("Ben");
  subscribe(ana, 0, 10);
  subscribe(ben, 0, 20);
  auto wishes = core_->camera_requests(now_);
  ASSERT_EQ(wishes.size(), 1u);
  EXPECT_EQ(wishes[0].rate, 20);
  EXPECT_EQ(wishes[0].image.width, 320u);
  core_->closed(ben.id, "test", now_);
  subscribe(ana, 10, 0);
  EXPECT_TRUE(core_->camera_requests(now_).empty());
}

TEST_F(GatewayStreams, GoOnOnceASecondWithTheLastStateWhileTheRobotIsGone) {
  Phone ana = connect("Ana");
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

TEST_F(GatewayStreams, CanBePolledInstead) {
  Phone ana = connect("Ana");
  auto polled = ask(ana, get_state()).state_and_image();
  EXPECT_EQ(polled.state().joint_position_size(), 4);
  EXPECT_EQ(polled.state().mode(), naoremote::MODE_HOLDING);
  EXPECT_FALSE(polled.has_image());
  EXPECT_EQ(core_->camera_requests(now_).size(), 1u) << "who polls images watches";
  put_image(5);
  polled = ask(ana, get_state()).state_and_image();
  EXPECT_EQ(polled.image().jpeg(), "jpeg 5");
  EXPECT_FALSE(ask(ana, get_state()).state_and_image().has_image()) << "it is not new";
  pass(2.1);
  EXPECT_TRUE(core_->camera_requests(now_).empty());
}

TEST_F(GatewayStreams, HaveNothingBeforeTheRobotSpoke) {
  motion_speaks_ = false;
  restart(GatewayLimits{});
  Phone ana = connect("Ana");
  EXPECT_EQ(ask(ana, get_state()).error(), naoremote::ROBOT_UNAVAILABLE);
}

// ---- Ends ---------------------------------------------------------------------------------------

using GatewayEnds = GatewayFixture;

TEST_F(GatewayEnds, ASilentConnectionAfterFiveSeconds) {
  Phone ana = connect_driver("Ana");
  pass(4.9);
  ping(ana);
  pass(4.9);
  EXPECT_FALSE(core_->is_closing(ana.id));
  pass(0.2);
  EXPECT_TRUE(core_->is_closing(ana.id));
  EXPECT_EQ(core_->driver(), 0u);
  EXPECT_EQ(notices(ana, Notice::CLOSING).size(), 1u);
}

TEST_F(GatewayEnds, AConnectionWhoseNoticesAreNotRead) {
  Phone ana = connect("Ana");
  Phone ben = connect("Ben");
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

TEST_F(GatewayEnds, EverythingWhenItShutsDown) {
  Phone ana = connect_driver("Ana");
  walk(ana, 0.1);
  core_->shut_down(now_);
  EXPECT_EQ(last_walk().vx, 0);
  EXPECT_TRUE(core_->is_closing(ana.id));
}

TEST_F(GatewayEnds, AreWrittenDown) {
  Phone ana = connect_driver("Ana");
  core_->closed(ana.id, "closed by the client", now_);
  Phone far = open(false, "192.168.1.7");
  ask(far, hello("wrong"));
  std::vector<std::string> events;
  for (const AuditEvent& event : audit_) events.push_back(event.event);
  EXPECT_EQ(events, (std::vector<std::string>{"connected", "drives", "disconnected", "refused"}));
  EXPECT_EQ(audit_.back().address, "192.168.1.7");
  EXPECT_EQ(audit_.back().detail.find("wrong-token"), std::string::npos) << "no secrets";
}

}  // namespace
}  // namespace nao

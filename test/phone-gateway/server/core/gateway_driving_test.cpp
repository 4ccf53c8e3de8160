#include "phone-gateway/server/core/gateway_core.h"

#include <gtest/gtest.h>

#include "test/phone-gateway/server/core/gateway_fixture.h"

namespace nao::gateway {
namespace {

using naoremote::Notice;

// ---- Who drives ---------------------------------------------------------------------------------

using GatewayDriving = GatewayFixture;

/** A velocity that moves no robot, but does not end its walk. */
bool is_in_place(const WalkCommand& walk) {
  return walk.vx > 0 && walk.vx < 1e-5 && walk.vy == 0 && walk.wz == 0;
}

TEST_F(GatewayDriving, NeedsControl) {
  Client ana = connect("Ana");
  EXPECT_EQ(go_to(ana, "Crouch").error(), naoremote::NO_CONTROL);
  Client ben = connect_driver("Ben");
  const auto response = go_to(ana, "Crouch");
  EXPECT_EQ(response.error(), naoremote::CONTROL_TAKEN);
  EXPECT_EQ(response.control().driver_name(), "Ben");
  EXPECT_TRUE(sent_.empty());
  EXPECT_EQ(go_to(ben, "Crouch").error(), naoremote::OK);
}

TEST_F(GatewayDriving, IsRefusedWithTheDriversNameUntilReleased) {
  Client ana = connect_driver("Ana");
  Client ben = connect("Ben");
  const auto refused = take_control(ben);
  EXPECT_EQ(refused.error(), naoremote::CONTROL_TAKEN);
  EXPECT_EQ(refused.control().driver_name(), "Ana");
  EXPECT_FALSE(refused.control().is_mine());
  EXPECT_EQ(release_control(ana).error(), naoremote::OK);
  EXPECT_TRUE(take_control(ben).control().is_mine());
  const auto changes = notices(ana, Notice::CONTROL_CHANGED);
  ASSERT_EQ(changes.size(), 3u) << "Ana took it, Ana released it, Ben took it";
  EXPECT_EQ(changes.back().control().driver_name(), "Ben");
}

TEST_F(GatewayDriving, CanBeTakenOverAfterTenSecondsWithoutACommand) {
  Client ana = connect_driver("Ana");
  Client ben = connect("Ben");
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

TEST_F(GatewayDriving, IsHandedOverToTheClientThatAsked) {
  Client ana = connect_driver("Ana");
  Client ben = connect("Ben");
  Client eva = connect("Eva");
  walk(ana, 0.1);
  EXPECT_EQ(wait_for_control(ben).control().next_name(), "Ben");
  EXPECT_EQ(wait_for_control(eva).control().next_name(), "Ben") << "Ben asked first";
  const auto asked = notices(ana, Notice::CONTROL_CHANGED).back();
  EXPECT_EQ(asked.reason_code(), "control-asked");
  EXPECT_EQ(asked.control().next_id(), ben.id);
  EXPECT_TRUE(asked.control().is_mine());
  EXPECT_EQ(release_control(ana, ben.id).control().driver_id(), ben.id);
  const auto seen = notices(eva, Notice::CONTROL_CHANGED).back().control();
  EXPECT_EQ(seen.driver_name(), "Ben");
  EXPECT_EQ(seen.next_id(), 0u);
  // A joystick that he holds already does not walk; the one of Ana neither.
  EXPECT_EQ(walk(ben, 0.1).error(), naoremote::STOPPED);
  EXPECT_EQ(walk(ana, 0.1).error(), naoremote::CONTROL_TAKEN);
  walk(ben, 0);
  EXPECT_EQ(walk(ben, 0.1).error(), naoremote::OK);
}

TEST_F(GatewayDriving, IsHandedOverToNobodyWhoDoesNotWait) {
  Client ana = connect_driver("Ana");
  Client ben = connect("Ben");
  take_control(ben);
  EXPECT_EQ(release_control(ana, ben.id).control().driver_id(), 0u) << "asked without waiting";
  take_control(ana);
  wait_for_control(ben);
  release_control(ben);
  EXPECT_EQ(notices(ana, Notice::CONTROL_CHANGED).back().reason_code(), "control-ask-withdrawn");
  EXPECT_EQ(release_control(ana, ben.id).control().driver_id(), 0u) << "withdrawn";
  take_control(ana);
  wait_for_control(ben);
  core_->closed(ben.id, "test", now_);
  EXPECT_EQ(release_control(ana, ben.id).control().driver_id(), 0u) << "disconnected";
}

TEST_F(GatewayDriving, IsReleasedByDisconnecting) {
  Client ana = connect_driver("Ana");
  Client ben = connect("Ben");
  core_->closed(ana.id, "test", now_);
  EXPECT_EQ(core_->robot().driving().driver(), 0u);
  EXPECT_EQ(notices(ben, Notice::CONTROL_CHANGED).size(), 1u);
  EXPECT_EQ(take_control(ben).error(), naoremote::OK);
}

TEST_F(GatewayDriving, IsTakenByTheOperatorFromTheOwnHostOnly) {
  Client ana = connect_driver("Ana");
  Client far = open(false, "192.168.1.7");
  EXPECT_EQ(operate(far, naoremote::Operate::TAKE).error(), naoremote::NOT_CONNECTED);
  EXPECT_EQ(ask(far, make_connect("secret")).error(), naoremote::OK);
  EXPECT_EQ(operate(far, naoremote::Operate::TAKE).error(), naoremote::NOT_ALLOWED);
  Client console = open();
  EXPECT_EQ(operate(console, naoremote::Operate::TAKE).error(), naoremote::OK);
  core_->closed(console.id, "test", now_);
  EXPECT_EQ(go_to(ana, "Crouch").error(), naoremote::CONTROL_TAKEN);
  pass(1);
  ping(ana);
  EXPECT_EQ(take_control(ana).error(), naoremote::CONTROL_TAKEN);
  Client again = open();
  EXPECT_EQ(operate(again, naoremote::Operate::RELEASE).error(), naoremote::OK);
  EXPECT_EQ(take_control(ana).error(), naoremote::OK);
}

TEST_F(GatewayDriving, LetsTheOperatorListAndDisconnectClients) {
  Client ana = connect_driver("Ana");
  Client console = open();
  const auto clients = operate(console, naoremote::Operate::LIST).clients();
  ASSERT_EQ(clients.clients_size(), 1);
  EXPECT_EQ(clients.clients(0).name(), "Ana");
  EXPECT_TRUE(clients.clients(0).is_driver());
  EXPECT_EQ(operate(console, naoremote::Operate::KICK, ana.id).error(), naoremote::OK);
  EXPECT_TRUE(core_->is_closing(ana.id));
  EXPECT_EQ(core_->robot().driving().driver(), 0u);
  EXPECT_EQ(operate(console, naoremote::Operate::KICK, 99).error(), naoremote::INVALID_ARGUMENT);
}

// ---- Walking ------------------------------------------------------------------------------------

using GatewayWalking = GatewayFixture;

TEST_F(GatewayWalking, ContinuesUnderOneIdWhileRepeated) {
  Client ana = connect_driver("Ana");
  for (int i = 0; i < 10; ++i) {
    EXPECT_EQ(walk(ana, 0.1).error(), naoremote::OK);
    pass(0.2);
  }
  EXPECT_GE(num_sent<WalkCommand>(), 20) << "repeated at 10 Hz";
  EXPECT_DOUBLE_EQ(last_walk().vx, 0.1);
  for (const Command& sent : sent_) {
    EXPECT_EQ(sent.id, sent_.front().id);
    EXPECT_EQ(sent.source, "phone.1." + std::to_string(ana.id));
  }
}

TEST_F(GatewayWalking, GoesOnAfterAPauseOfTheLinkAsTheSameWalk) {
  Client ana = connect_driver("Ana");
  walk(ana, 0.1);
  pass(0.9);
  EXPECT_TRUE(is_in_place(last_walk()));
  walk(ana, 0.1);
  pass(0.2);
  EXPECT_DOUBLE_EQ(last_walk().vx, 0.1);
  EXPECT_EQ(sent_.back().id, sent_.front().id);
}

TEST_F(GatewayWalking, StepsInPlaceWhileTheDriverDoesNotSeeTheRobotButNotForLong) {
  Client ana = connect_driver("Ana");
  walk(ana, 0.1);
  naoremote::Request held;
  held.mutable_walk_turn()->set_is_held(true);
  EXPECT_EQ(ask(ana, held).error(), naoremote::OK);
  EXPECT_TRUE(is_in_place(last_walk()));
  pass(0.9);
  EXPECT_EQ(ask(ana, held).error(), naoremote::OK);
  pass(0.12);
  EXPECT_EQ(last_walk().vx, 0) << "a held zero keeps no walk alive";
  EXPECT_EQ(ask(ana, held).error(), naoremote::OK);
  EXPECT_EQ(last_walk().vx, 0) << "nor begins one";
  walk(ana, 0.1);
  walk(ana, 0);
  EXPECT_EQ(last_walk().vx, 0) << "a released one ends it at once";
}

TEST_F(GatewayWalking, StepsInPlaceHalfASecondAfterTheLastCommandAndEndsASecondAfterIt) {
  Client ana = connect_driver("Ana");
  walk(ana, 0.1);
  pass(0.48);
  EXPECT_DOUBLE_EQ(last_walk().vx, 0.1);
  pass(0.04);
  EXPECT_TRUE(is_in_place(last_walk()));
  EXPECT_TRUE(notices(ana, naoremote::Notice::WALK_ENDED).empty());
  pass(0.46);
  EXPECT_TRUE(is_in_place(last_walk()));
  pass(0.04);
  EXPECT_EQ(last_walk().vx, 0);
  const auto ended = notices(ana, naoremote::Notice::WALK_ENDED);
  ASSERT_EQ(ended.size(), 1u);
  EXPECT_EQ(ended[0].reason_code(), "walk-link-lost");
  pass(1);
  const int num_walks = num_sent<WalkCommand>();
  EXPECT_EQ(std::get<WalkCommand>(sent_[sent_.size() - 3].request).vx, 0) << "zero, three times";
  pass(5);
  EXPECT_EQ(num_sent<WalkCommand>(), num_walks) << "then nothing";
}

TEST_F(GatewayWalking, EndsAtOnceOnZeroVelocity) {
  Client ana = connect_driver("Ana");
  walk(ana, 0.1);
  walk(ana, 0);
  EXPECT_EQ(last_walk().vx, 0);
  const int num_walks = num_sent<WalkCommand>();
  pass(0.3);
  walk(ana, 0);
  EXPECT_EQ(num_sent<WalkCommand>(), num_walks + 2) << "further zeros end no walk";
}

TEST_F(GatewayWalking, EndsAtOnceWhenTheDriverDisconnects) {
  Client ana = connect_driver("Ana");
  walk(ana, 0.1);
  core_->closed(ana.id, "test", now_);
  EXPECT_EQ(last_walk().vx, 0);
}

TEST_F(GatewayWalking, EndsAtOnceWhenControlIsLost) {
  Client ana = connect_driver("Ana");
  walk(ana, 0.1);
  release_control(ana);
  EXPECT_EQ(last_walk().vx, 0);
  take_control(ana);
  walk(ana, 0.1);
  Client console = open();
  operate(console, naoremote::Operate::TAKE);
  EXPECT_EQ(last_walk().vx, 0);
}

TEST_F(GatewayWalking, ToAGoalIsStoppedWhenTheDriverDisconnects) {
  Client ana = connect_driver("Ana");
  naoremote::Request request;
  request.mutable_move_to()->set_x(2);
  EXPECT_EQ(ask(ana, request).error(), naoremote::OK);
  answer_last(ResultStatus::kAccepted);
  core_->closed(ana.id, "test", now_);
  EXPECT_EQ(num_sent<StopCommand>(), 1);
}

TEST_F(GatewayWalking, StaysStoppedUntilTheDriverReleasesTheJoystick) {
  Client ana = connect_driver("Ana");
  Client ben = connect("Ben");
  walk(ana, 0.1);
  pass(0.1);
  EXPECT_EQ(stop(ben).error(), naoremote::OK) << "every client may stop";
  const int num_walks = num_sent<WalkCommand>();
  for (int i = 0; i < 10; ++i) {
    EXPECT_EQ(walk(ana, 0.1).error(), naoremote::STOPPED);
    pass(0.1);
  }
  EXPECT_EQ(num_sent<WalkCommand>(), num_walks);
  EXPECT_EQ(walk(ana, 0).error(), naoremote::OK);
  EXPECT_EQ(walk(ana, 0.1).error(), naoremote::OK);
  stop(ben);
  EXPECT_EQ(walk(ana, 0.1).error(), naoremote::STOPPED);
  pass(0.52);
  EXPECT_EQ(walk(ana, 0.1).error(), naoremote::OK) << "a pause counts as released";
}

TEST_F(GatewayWalking, GetsANewIdAfterARefusal) {
  Client ana = connect_driver("Ana");
  walk(ana, 0.1);
  const int64_t first = sent_.back().id;
  answer_last(ResultStatus::kRefused, "The robot lies on its back.");
  const int num_walks = num_sent<WalkCommand>();
  pass(0.4);
  EXPECT_EQ(num_sent<WalkCommand>(), num_walks) << "a refused walk is not repeated";
  walk(ana, 0.1);
  EXPECT_GT(sent_.back().id, first);
  answer_last(ResultStatus::kRefused, "The robot lies on its back.");
  EXPECT_EQ(notices(ana, Notice::COMMAND_RESULT).size(), 1u) << "reported once in two seconds";
}

TEST_F(GatewayWalking, IsReplacedByAPosture) {
  Client ana = connect_driver("Ana");
  walk(ana, 0.1);
  go_to(ana, "Crouch");
  answer_last(ResultStatus::kAccepted);
  sent_.clear();
  pass(2);
  EXPECT_TRUE(sent_.empty()) << "a zero velocity would end the posture";
}

TEST_F(GatewayWalking, ContinuesDuringAJointChange) {
  Client ana = connect_driver("Ana");
  walk(ana, 0.1);
  turn_head(ana, 0.1);
  pass(0.3);
  EXPECT_GT(last_walk().vx, 0);
  EXPECT_GE(num_sent<WalkCommand>(), 3);
}

// ---- Other commands -----------------------------------------------------------------------------

using GatewayCommands = GatewayFixture;

TEST_F(GatewayCommands, AreRepeatedUntilAnsweredAndTheirResultsReported) {
  Client ana = connect_driver("Ana");
  const auto response = go_to(ana, "Crouch");
  pass(0.3);
  EXPECT_GE(num_sent<PostureCommand>(), 3);
  answer_last(ResultStatus::kAccepted);
  const int num_heard = num_sent<PostureCommand>();
  pass(2);
  EXPECT_EQ(num_sent<PostureCommand>(), num_heard);
  answer_last(ResultStatus::kDone);
  answer_last(ResultStatus::kDone);
  const auto results = notices(ana, Notice::COMMAND_RESULT);
  ASSERT_EQ(results.size(), 2u);
  EXPECT_EQ(results[0].status(), Notice::ACCEPTED);
  EXPECT_EQ(results[1].status(), Notice::DONE);
  EXPECT_EQ(results[1].request_id(), response.request_id());
  EXPECT_FALSE(results[1].message().empty());
}

TEST_F(GatewayCommands, HaveTheReasonsOfNaoMotionInTheirResults) {
  Client ana = connect_driver("Ana");
  go_to(ana, "Crouch");
  CommandResult result;
  result.source = sent_.back().source;
  result.id = sent_.back().id;
  result.status = ResultStatus::kRefused;
  result.reason = Reason("no-path", {"Sit", "Crouch"});
  core_->robot().handle_result(result, now_);
  const auto results = notices(ana, Notice::COMMAND_RESULT);
  ASSERT_EQ(results.size(), 1u);
  EXPECT_EQ(results[0].reason_code(), "no-path");
  ASSERT_EQ(results[0].reason_arguments_size(), 2);
  EXPECT_EQ(results[0].reason_arguments(0), "Sit");
  EXPECT_EQ(results[0].message(), to_sentence(result.reason));
}

TEST_F(GatewayCommands, ThatAreNotAnsweredFail) {
  Client ana = connect_driver("Ana");
  go_to(ana, "Crouch");
  pass(1.6);
  const auto results = notices(ana, Notice::COMMAND_RESULT);
  ASSERT_EQ(results.size(), 1u);
  EXPECT_EQ(results[0].status(), Notice::FAILED);
}

TEST_F(GatewayCommands, ThatAreNotAnsweredAreReplacedByANewerOne) {
  Client ana = connect_driver("Ana");
  go_to(ana, "Crouch");
  stop(ana);
  sent_.clear();
  pass(1);
  EXPECT_EQ(num_sent<PostureCommand>(), 0);
  EXPECT_GE(num_sent<StopCommand>(), 5);
}

TEST_F(GatewayCommands, AreRefusedWhileMotionIsUnavailable) {
  Client ana = connect_driver("Ana");
  has_motion_ = false;
  pass(1.2);
  EXPECT_EQ(go_to(ana, "Crouch").error(), naoremote::ROBOT_UNAVAILABLE);
  EXPECT_EQ(walk(ana, 1).error(), naoremote::ROBOT_UNAVAILABLE);
  EXPECT_TRUE(sent_.empty()) << "and not queued";
  has_motion_ = true;
  pass(0.1);
  EXPECT_TRUE(sent_.empty());
  EXPECT_EQ(go_to(ana, "Crouch").error(), naoremote::OK);
}

TEST_F(GatewayCommands, FailWhenMotionBecomesUnavailable) {
  Client ana = connect_driver("Ana");
  go_to(ana, "Crouch");
  answer_last(ResultStatus::kAccepted);
  has_motion_ = false;
  pass(2);
  const auto results = notices(ana, Notice::COMMAND_RESULT);
  ASSERT_EQ(results.size(), 2u);
  EXPECT_EQ(results[1].status(), Notice::FAILED);
  const auto components = notices(ana, Notice::COMPONENT_CHANGED);
  ASSERT_EQ(components.size(), 2u) << "motion and robot";
  EXPECT_FALSE(components[0].is_available());
}

TEST_F(GatewayCommands, HaveIdsThatAreNeverReused) {
  Client ana = connect_driver("Ana");
  go_to(ana, "Crouch");
  const int64_t first = sent_.back().id;
  EXPECT_EQ(first, 1000) << "first_command_id of the identity";
  stop(ana);
  EXPECT_EQ(sent_.back().id, 1001);
}

// ---- Late commands ------------------------------------------------------------------------------

class LateCommands : public GatewayFixture {
 protected:
  /** A request that was under way for `delay` s, of a client whose clock shows other times. */
  naoremote::Response ask_late(Client& client, naoremote::Request request, double delay) {
    request.set_sent_at(now_ - delay + 12345.6);
    return ask(client, std::move(request));
  }
  naoremote::Response walk_late(Client& client, double vx, double delay) {
    naoremote::Request request;
    request.mutable_walk_turn()->set_vx(vx);
    return ask_late(client, request, delay);
  }
};

TEST_F(LateCommands, AreRefusedWhenTheyCameMuchLaterThanOthers) {
  Client ana = connect_driver("Ana");
  EXPECT_EQ(walk_late(ana, 0.1, 0.05).error(), naoremote::OK);
  pass(0.4);
  EXPECT_EQ(walk_late(ana, 0.1, 0.4).error(), naoremote::OK) << "0.35 s later";
  pass(0.4);
  const auto refused = walk_late(ana, 0.1, 0.5);
  EXPECT_EQ(refused.error(), naoremote::TOO_LATE);
  EXPECT_EQ(refused.reason_code(), "command-too-late");
  naoremote::Request posture;
  posture.mutable_go_to_posture()->set_posture("Crouch");
  EXPECT_EQ(ask_late(ana, posture, 2).error(), naoremote::TOO_LATE);
  pass(0.2);
  EXPECT_LT(last_walk().vx, 1e-3) << "late commands do not keep a walk alive";
}

TEST_F(LateCommands, AreNeverTheEndOfAMotion) {
  Client ana = connect_driver("Ana");
  EXPECT_EQ(walk_late(ana, 0.1, 0).error(), naoremote::OK);
  EXPECT_EQ(walk_late(ana, 0, 3).error(), naoremote::OK);
  EXPECT_EQ(last_walk().vx, 0);
  naoremote::Request stop;
  stop.mutable_stop();
  EXPECT_EQ(ask_late(ana, stop, 3).error(), naoremote::OK);
}

TEST_F(LateCommands, AreMeasuredByThirtySecondsAgainAfterAClockWasSetBack) {
  Client ana = connect_driver("Ana");
  EXPECT_EQ(walk_late(ana, 0.1, 0).error(), naoremote::OK);
  for (int i = 0; i < 33; ++i) {
    pass(1);
    (void)walk_late(ana, 0.1, 5);
  }
  EXPECT_EQ(walk_late(ana, 0.1, 5).error(), naoremote::OK);
}

TEST_F(LateCommands, AreNotLookedForWithoutTheClientsTime) {
  Client ana = connect_driver("Ana");
  EXPECT_EQ(walk_late(ana, 0.1, 0).error(), naoremote::OK);
  EXPECT_EQ(walk(ana, 0.1).error(), naoremote::OK);
}

TEST_F(LateCommands, OverASlowLinkOneWalksSlowly) {
  Client ana = connect_driver("Ana");
  core_->set_round_trip_time(ana.id, 0.15);
  EXPECT_EQ(walk(ana, 0.2).error(), naoremote::OK);
  EXPECT_NEAR(last_walk().vx, 0.2, 1e-9);
  core_->set_round_trip_time(ana.id, 0.575);
  EXPECT_EQ(walk(ana, 0.2).error(), naoremote::OK);
  EXPECT_NEAR(last_walk().vx, 0.1, 1e-9);
  core_->set_round_trip_time(ana.id, 1.2);
  const auto refused = walk(ana, 0.2);
  EXPECT_EQ(refused.error(), naoremote::TOO_LATE);
  EXPECT_EQ(refused.reason_code(), "link-too-slow");
  EXPECT_EQ(last_walk().vx, 0);
}

}  // namespace
}  // namespace nao::gateway

#include "phone-gateway/server/core/exhibition_desk.h"

#include <gtest/gtest.h>

#include <set>

#include "phone-gateway/server/exhibition/queue_file.h"
#include "test/phone-gateway/server/core/gateway_fixture.h"

namespace nao::gateway {
namespace {

using naoremote::Exhibition;

class ExhibitionDeskTest : public GatewayFixture {
 protected:
  ExhibitionDeskTest() { open_exhibition("{speed: 1}"); }

  void open_exhibition(const std::string& settings, QueueState state = {}) {
    exhibition_ = ExhibitionSetup{parse_exhibition(settings, "fair.yaml", {"Vega", "Rigel"}),
                                  "operators", std::move(state)};
    naoremote::RobotDescription robot = make_test_robot();
    robot.set_ready_posture("Stand");
    robot.set_rest_posture("Crouch");
    naoremote::ActionRole* kick = robot.add_action_roles();
    kick->set_name("kick-left");
    kick->set_kind("kick");
    start({{robot,
            {.send = [this](const Command& command) { sent_.push_back(command); },
             .send_service =
                 [this](const ServiceCommand& command) { services_.push_back(command); }}}},
          GatewayLimits{});
  }

  static std::string key(const std::string& name) { return "key-of-a-phone-of-" + name; }

  naoremote::Response attend(Client& client, const std::string& name, bool again = false) {
    naoremote::Request request;
    request.mutable_attend()->set_visitor_key(key(name));
    request.mutable_attend()->set_again(again);
    return ask(client, request);
  }
  Client visit(const std::string& name) {
    Client client = connect("");
    EXPECT_EQ(attend(client, name).error(), naoremote::OK);
    return client;
  }
  naoremote::Response leave(Client& client, const std::string& name) {
    naoremote::Request request;
    request.mutable_attend()->set_visitor_key(key(name));
    request.mutable_attend()->set_leaves(true);
    return ask(client, request);
  }
  naoremote::Response run(Client& client, naoremote::RunExhibition operation) {
    naoremote::Request request;
    *request.mutable_run_exhibition() = std::move(operation);
    if (request.run_exhibition().secret().empty()) {
      request.mutable_run_exhibition()->set_secret("operators");
    }
    return ask(client, request);
  }
  /** What the client was told last. */
  Exhibition told(Client& client) {
    const auto all = notices(client, naoremote::Notice::EXHIBITION_CHANGED);
    return all.empty() ? Exhibition{} : all.back().exhibition();
  }
  naoremote::Response do_action(Client& client, const std::string& action) {
    naoremote::Request request;
    request.mutable_do_action()->set_action(action);
    return ask(client, request);
  }
  /** Commands of one kind, each counted once. */
  template <class Request>
  size_t num_commands() const {
    std::set<int64_t> ids;
    for (const Command& command : sent_) {
      if (std::holds_alternative<Request>(command.request)) ids.insert(command.id);
    }
    return ids.size();
  }
  /** A walk of a driver that has held no joystick for a while. */
  naoremote::Response begin_walk(Client& client, double vx) {
    walk(client, 0);
    return walk(client, vx);
  }
  /** All clients ping, as phones do. */
  void wait(double time, const std::vector<Client*>& clients) {
    for (double t = 0; t < time; t += 1) {
      pass(1);
      for (Client* client : clients) ping(*client);
    }
  }
  PostureCommand last_posture() const {
    for (auto it = sent_.rbegin(); it != sent_.rend(); ++it) {
      if (const auto* posture = std::get_if<PostureCommand>(&it->request)) return *posture;
    }
    return {};
  }
};

TEST_F(ExhibitionDeskTest, GivesControlInTurn) {
  Client ana = visit("Ana");
  Client rui = visit("Rui");
  pass(0.5);
  EXPECT_EQ(told(ana).phase(), Exhibition::DRIVING);
  EXPECT_EQ(told(ana).nickname(), "Vega");
  EXPECT_EQ(told(rui).phase(), Exhibition::WAITING);
  EXPECT_EQ(told(rui).place(), 1u);
  EXPECT_EQ(begin_walk(ana, 0.1).error(), naoremote::OK);
  EXPECT_EQ(walk(rui, 0.1).error(), naoremote::CONTROL_TAKEN);
  EXPECT_EQ(take_control(rui).error(), naoremote::NOT_ALLOWED);
  EXPECT_EQ(take_control(ana).error(), naoremote::NOT_ALLOWED);
  EXPECT_EQ(release_control(ana).error(), naoremote::OK) << "the turn ends";
  wait(6, {&ana, &rui});
  EXPECT_EQ(told(ana).phase(), Exhibition::SERVED);
  EXPECT_EQ(told(rui).phase(), Exhibition::DRIVING);
  EXPECT_EQ(begin_walk(rui, 0.1).error(), naoremote::OK);
  EXPECT_NE(walk(ana, 0.1).error(), naoremote::OK);
  EXPECT_EQ(attend(ana, "Ana", true).error(), naoremote::OK);
  pass(0.5);
  EXPECT_EQ(told(ana).place(), 1u);
}

TEST_F(ExhibitionDeskTest, TakesTheTurnFromADriverThatDoesNothing) {
  Client ana = visit("Ana");
  Client rui = visit("Rui");
  wait(22, {&ana, &rui});
  EXPECT_EQ(told(ana).phase(), Exhibition::SERVED);
  EXPECT_EQ(told(rui).phase(), Exhibition::DRIVING);
}

TEST_F(ExhibitionDeskTest, LetsTheNewestConnectionOfAPhoneDrive) {
  Client ana = visit("Ana");
  Client other = visit("Ana");
  pass(0.5);
  EXPECT_EQ(told(other).num_waiting(), 0u) << "one place";
  EXPECT_EQ(begin_walk(other, 0.1).error(), naoremote::OK);
  EXPECT_NE(walk(ana, 0.1).error(), naoremote::OK);
  core_->closed(ana.id, "", now_);
  pass(0.1);
  EXPECT_EQ(begin_walk(other, 0.1).error(), naoremote::OK);
  core_->closed(other.id, "", now_);
  pass(1);
  Client again = visit("Ana");
  pass(0.1);
  EXPECT_EQ(begin_walk(again, 0.1).error(), naoremote::OK) << "the turn goes on";
}

TEST_F(ExhibitionDeskTest, RefusesBadKeysAndAFullQueue) {
  open_exhibition("{max_waiting: 1}");
  Client ana = connect("");
  naoremote::Request request;
  request.mutable_attend()->set_visitor_key("short");
  EXPECT_EQ(ask(ana, request).reason_code(), "exhibition-key-invalid");
  visit("Rui");
  EXPECT_EQ(attend(ana, "Ana").error(), naoremote::TOO_MANY_CLIENTS);
  exhibition_.reset();
  restart(GatewayLimits{});
  Client eva = connect("Eva");
  EXPECT_EQ(attend(eva, "Eva").reason_code(), "exhibition-none");
}

TEST_F(ExhibitionDeskTest, ObeysTheOperatorAndNobodyElse) {
  Client ana = visit("Ana");
  Client rui = visit("Rui");
  Client tablet = connect("operator");
  pass(0.2);
  naoremote::RunExhibition pause;
  pause.set_is_paused(true);
  EXPECT_EQ(run(tablet, pause).error(), naoremote::OK);
  pass(0.2);
  EXPECT_NE(walk(ana, 0.1).error(), naoremote::OK);
  EXPECT_TRUE(told(rui).is_paused());
  pause.set_is_paused(false);
  EXPECT_EQ(run(tablet, pause).error(), naoremote::OK);
  pass(0.2);
  EXPECT_EQ(begin_walk(ana, 0.1).error(), naoremote::OK);

  EXPECT_EQ(do_action(ana, "kick-left").error(), naoremote::OK);
  naoremote::RunExhibition gentle;
  gentle.set_forbids_kicks(true);
  gentle.set_speed(0.5);
  EXPECT_EQ(run(tablet, gentle).error(), naoremote::OK);
  EXPECT_EQ(do_action(ana, "kick-left").reason_code(), "exhibition-forbidden");
  EXPECT_EQ(do_action(ana, "wave").error(), naoremote::OK);
  begin_walk(ana, 0.1);
  EXPECT_DOUBLE_EQ(last_walk().vx, 0.05);

  naoremote::RunExhibition more;
  more.set_more_time(30);
  EXPECT_EQ(run(tablet, more).error(), naoremote::OK);
  pass(0.3);
  EXPECT_GT(told(ana).turn_left(), 90u);
  naoremote::RunExhibition lights;
  lights.set_light_rgb(0xFF0000);
  EXPECT_EQ(run(tablet, lights).error(), naoremote::OK);
  ASSERT_FALSE(services_.empty());
  EXPECT_EQ(std::get<LightCommand>(services_.back().request).light_names.size(), 2u);

  naoremote::RunExhibition skip;
  skip.set_skips(true);
  EXPECT_EQ(run(tablet, skip).error(), naoremote::OK);
  pass(0.3);
  EXPECT_EQ(told(ana).phase(), Exhibition::SERVED);
  EXPECT_EQ(last_posture().posture, "Stand") << "ready for the next visitor";
  naoremote::RunExhibition rest;
  rest.set_is_resting(true);
  EXPECT_EQ(run(tablet, rest).error(), naoremote::OK);
  wait(6, {&ana, &rui, &tablet});
  EXPECT_EQ(last_posture().posture, "Crouch");
  EXPECT_EQ(told(rui).phase(), Exhibition::WAITING);

  naoremote::RunExhibition fast;
  fast.set_speed(7);
  EXPECT_EQ(run(tablet, fast).error(), naoremote::INVALID_ARGUMENT);
  fast.set_secret("guess");
  EXPECT_EQ(run(ana, fast).error(), naoremote::NOT_ALLOWED);
  EXPECT_TRUE(core_->is_closing(ana.id)) << "a wrong secret closes the connection";
}

TEST_F(ExhibitionDeskTest, KeepsAWalkInsideTheFence) {
  open_exhibition(
      "{speed: 1, fence: {frame: start, corners: [[-1, -1], [1, -1], [1, 1], [-1, 1]]}}");
  Client ana = visit("Ana");
  pass(0.2);
  begin_walk(ana, 0.2);
  EXPECT_DOUBLE_EQ(last_walk().vx, 0.2);
  torso_x_ = 0.2;
  pass(0.1);
  for (torso_x_ = 0.2; torso_x_ < 0.89; torso_x_ += 0.1) pass(0.1);
  torso_x_ = 0.9;
  pass(0.1);
  EXPECT_NEAR(last_walk().vx, 0, 1e-3) << "also without another command of the driver";
  walk(ana, 0.2);
  EXPECT_NEAR(last_walk().vx, 0, 1e-3);
  walk(ana, -0.1);
  EXPECT_DOUBLE_EQ(last_walk().vx, -0.1);
  naoremote::Request request;
  request.mutable_move_to()->set_x(0.5);
  EXPECT_EQ(ask(ana, request).reason_code(), "exhibition-fence");
  request.mutable_move_to()->set_x(-0.5);
  EXPECT_EQ(ask(ana, request).error(), naoremote::OK);
  // nao-motion begins again, and its odometry with it: the place stays.
  torso_x_ = 0;
  pass(0.1);
  begin_walk(ana, 0.2);
  EXPECT_NEAR(last_walk().vx, 0, 1e-3);
}

TEST_F(ExhibitionDeskTest, TimesTheWayThroughTheGate) {
  open_exhibition("{challenge: {gate: [[0.5, -0.4], [0.5, 0.4]]}}");
  Client ana = visit("Ana");
  for (int i = 0; i < 10; ++i) {
    walk(ana, 0.1);
    pass(1);
  }
  torso_x_ = 0.25;
  pass(0.1);
  torso_x_ = 0.5001;
  pass(0.5);
  EXPECT_NEAR(told(ana).best_time(), 10, 0.3);
  EXPECT_EQ(told(ana).best_nickname(), "Vega");
}

TEST_F(ExhibitionDeskTest, TimesTheBallsWayIntoTheGoal) {
  open_exhibition("{challenge: {goal: [[4.5, -0.8], [4.5, 0.8]]}}");
  Client ana = visit("Ana");
  const auto see_ball = [&](double x, double age = 0) {
    naoremote::Vision vision;
    vision.mutable_ball()->set_x(static_cast<float>(x));
    vision.mutable_ball()->set_age(static_cast<float>(age));
    core_->robot().perception().set(vision);
    walk(ana, 0.1);
    pass(0.1);
  };
  see_ball(4.4, 3);
  see_ball(4.6, 3);
  EXPECT_EQ(told(ana).challenge_time(), 0) << "not seen for 3 s";
  see_ball(4.7);
  see_ball(4.4);
  EXPECT_EQ(told(ana).challenge_time(), 0) << "taken back";
  see_ball(4.9);
  EXPECT_EQ(told(ana).challenge_time(), 0) << "carried";
  see_ball(4.3);
  see_ball(4.6);
  pass(0.3);
  EXPECT_GT(told(ana).challenge_time(), 0.5);
  EXPECT_TRUE(told(ana).challenge_is_goal());
}

TEST_F(ExhibitionDeskTest, DoesNotWalkOnAFieldWhereItIsNotLocalised) {
  open_exhibition(
      "{speed: 1, fence: {frame: field, corners: [[-1, -1], [1, -1], [1, 1], [-1, 1]]}}");
  Client ana = visit("Ana");
  pass(0.2);
  begin_walk(ana, 0.2);
  EXPECT_EQ(num_commands<WalkCommand>(), 0u);
  naoremote::Vision vision;
  vision.set_utime(1);
  vision.mutable_field_pose()->set_x(-0.5);
  core_->robot().perception().set(vision);
  pass(0.2);
  begin_walk(ana, 0.2);
  EXPECT_DOUBLE_EQ(last_walk().vx, 0.2);
  vision.set_utime(2);
  vision.mutable_field_pose()->set_x(0.9F);
  core_->robot().perception().set(vision);
  pass(0.2);
  EXPECT_NEAR(last_walk().vx, 0, 1e-3) << "what it sees counts, not its odometry";
}

TEST_F(ExhibitionDeskTest, StopsTheClockWhileTheRobotIsAway) {
  Client ana = visit("Ana");
  walk(ana, 0.1);
  pass(1);
  const double left = told(ana).turn_left();
  has_robot_ = false;
  wait(30, {&ana});
  EXPECT_TRUE(told(ana).is_robot_away());
  EXPECT_NEAR(told(ana).turn_left(), left, 2);
  has_robot_ = true;
  pass(1);
  EXPECT_FALSE(told(ana).is_robot_away());
  EXPECT_EQ(told(ana).phase(), Exhibition::DRIVING);
}

TEST_F(ExhibitionDeskTest, RestsARobotWhoseMotorsAreHot) {
  Client ana = visit("Ana");
  pass(0.2);
  naoremote::Body body;
  body.add_warnings("joint-hot");
  core_->robot().streams().set_body(body);
  pass(0.3);
  EXPECT_EQ(told(ana).phase(), Exhibition::WAITING);
  EXPECT_TRUE(told(ana).is_resting());
  EXPECT_EQ(last_posture().posture, "Crouch");
  core_->robot().streams().set_body(naoremote::Body{});
  wait(6, {&ana});
  EXPECT_EQ(told(ana).phase(), Exhibition::DRIVING);
}

TEST_F(ExhibitionDeskTest, CountsARobotThatFailsButNotItsStart) {
  pass(1);
  EXPECT_EQ(core_->exhibition()->state().counts.faults, 0);
  has_robot_ = false;
  pass(3);
  EXPECT_EQ(core_->exhibition()->state().counts.faults, 1);
}

TEST_F(ExhibitionDeskTest, AttractsWhileNobodyIsThere) {
  open_exhibition("attract: {period: 10, actions: [wave], greetings: {en: Hello, de: Hallo}}");
  pass(10.2);
  ASSERT_EQ(num_commands<ActionCommand>(), 1u);
  pass(20);
  ASSERT_GE(services_.size(), 2u);
  EXPECT_EQ(num_commands<StopCommand>(), 0u);
  Client ana = visit("Ana");
  pass(0.1);
  EXPECT_EQ(num_commands<StopCommand>(), 1u) << "ended at once";
  EXPECT_EQ(begin_walk(ana, 0.1).error(), naoremote::OK);
}

TEST_F(ExhibitionDeskTest, GoesOnAfterARestart) {
  Client ana = visit("Ana");
  Client rui = visit("Rui");
  Client eva = visit("Eva");
  for (int i = 0; i < 20; ++i) {
    walk(ana, 0.1);
    wait(1, {&ana, &rui, &eva});
  }
  const std::string file = write_queue_state(core_->exhibition()->state());
  open_exhibition("{}", read_queue_state(file));
  eva = visit("Eva");
  rui = visit("Rui");
  ana = visit("Ana");
  pass(0.3);
  EXPECT_EQ(told(ana).phase(), Exhibition::DRIVING);
  EXPECT_NEAR(told(ana).turn_left(), 70, 2);
  EXPECT_EQ(told(rui).place(), 1u);
  EXPECT_EQ(told(eva).place(), 2u);
  EXPECT_EQ(leave(rui, "Rui").error(), naoremote::OK);
  pass(0.3);
  EXPECT_EQ(told(eva).place(), 1u);
}

}  // namespace
}  // namespace nao::gateway

// Random bytes and random requests, from fixed seeds, as input of everything that clients can
// reach.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <random>
#include <utility>
#include <vector>

#include "test/phone-gateway/server/core/gateway_fixture.h"

namespace nao::gateway {
namespace {

class GatewayFuzz : public GatewayFixture {
 protected:
  GatewayFuzz() {
    const RobotOutputs outputs{
        .send = [this](const Command& command) { sent_.push_back(command); },
        .send_service = [this](const ServiceCommand& command) { services_.push_back(command); },
    };
    std::vector<RobotSetup> robots{{make_test_robot(), outputs}, {make_test_robot(), outputs}};
    robots[1].description.set_name("NAO2");
    start(std::move(robots), GatewayLimits{});
  }

  /** A double that is likely to reveal an error. */
  double odd_double() {
    static constexpr double kOdd[] = {0,    -0.0, 1,  -1,  0.5,      1e-310,   1e308,
                                      3.15, 10,   60, NAN, INFINITY, -INFINITY};
    return kOdd[random_() % std::size(kOdd)];
  }

  std::string odd_name() {
    static const std::vector<std::string> kNames = {
        "head", "left hand", "Crouch",  "Stand", "wave",      "NAO2",
        "",     "tail",      "\x1b[2J", "%n%s",  "../../etc", std::string(5000, 'x')};
    return kNames[random_() % kNames.size()];
  }

  naoremote::Request odd_request() {
    naoremote::Request request;
    request.set_request_id(random_());
    switch (random_() % 19) {
      case 0:
        request.mutable_connect()->set_protocol_version(random_() % 3);
        request.mutable_connect()->set_client_name(random_() % 2 ? odd_name() : "");
        if (random_() % 4 == 0) request.mutable_connect()->set_robot(odd_name());
        break;
      case 1:
        request.mutable_get_state()->set_with_image(random_() % 2);
        request.mutable_get_state()->mutable_image()->set_width(random_() % 2 ? 320 : random_());
        break;
      case 2:
        request.mutable_subscribe()->set_state_rate(odd_double());
        request.mutable_subscribe()->set_image_rate(odd_double());
        break;
      case 3:
        request.mutable_walk_turn()->set_vx(odd_double());
        request.mutable_walk_turn()->set_vy(odd_double());
        request.mutable_walk_turn()->set_wz(odd_double());
        break;
      case 4:
        request.mutable_move_to()->set_x(odd_double());
        request.mutable_move_to()->set_theta(odd_double());
        break;
      case 5:
        request.mutable_go_to_posture()->set_posture(odd_name());
        request.mutable_go_to_posture()->set_speed(odd_double());
        break;
      case 6:
        request.mutable_change_joints()->set_group(odd_name());
        request.mutable_change_joints()->set_yaw(odd_double());
        request.mutable_change_joints()->set_pitch(odd_double());
        request.mutable_change_joints()->set_roll(odd_double());
        break;
      case 7:
        request.mutable_do_action()->set_action(odd_name());
        if (random_() % 2) request.mutable_do_action()->set_ball_x(odd_double());
        if (random_() % 2) request.mutable_do_action()->set_ball_y(odd_double());
        if (random_() % 2) request.mutable_do_action()->set_strength(odd_double());
        break;
      case 8:
        request.mutable_stop();
        break;
      case 9:
        request.mutable_take_control();
        if (random_() % 4 == 0) request.mutable_take_control()->set_robot(odd_name());
        break;
      case 10:
        request.mutable_release_control();
        break;
      case 11:
        request.mutable_ping()->set_client_utime(random_());
        break;
      case 12:
        request.mutable_operate()->set_operation(
            static_cast<naoremote::Operate::Operation>(random_() % 9));
        request.mutable_operate()->set_client_id(random_() % 20);
        if (random_() % 4 == 0) request.mutable_operate()->set_robot(odd_name());
        break;
      case 13:
        request.mutable_say()->set_operation(static_cast<naoremote::Say::Operation>(random_() % 5));
        request.mutable_say()->set_text(odd_name());
        request.mutable_say()->set_language(random_() % 2 ? "de" : odd_name());
        if (random_() % 2) request.mutable_say()->set_volume(odd_double());
        request.mutable_say()->set_rate(odd_double());
        break;
      case 14:
        for (unsigned i = 0; i < random_() % 3; ++i) {
          request.mutable_set_lights()->add_light_names(random_() % 2 ? "chest" : odd_name());
        }
        for (unsigned i = 0; i < random_() % 3; ++i) {
          request.mutable_set_lights()->add_light_rgb(random_() >> random_() % 32);
        }
        request.mutable_set_lights()->set_duration(odd_double());
        break;
      case 15:
        request.mutable_watch_robot()->set_robot(random_() % 2 ? "NAO" : odd_name());
        break;
      case 16:
        request.mutable_attend()->set_visitor_key(
            random_() % 4 ? "key-of-visitor-" + std::to_string(random_() % 9) : odd_name());
        request.mutable_attend()->set_leaves(random_() % 4 == 0);
        request.mutable_attend()->set_again(random_() % 2);
        break;
      case 17: {
        naoremote::RunExhibition& run = *request.mutable_run_exhibition();
        run.set_secret(random_() % 4 ? "operators" : odd_name());
        if (random_() % 4 == 0) run.set_is_paused(random_() % 2);
        if (random_() % 4 == 0) run.set_is_resting(random_() % 2);
        if (random_() % 4 == 0) run.set_speed(odd_double());
        if (random_() % 4 == 0) run.set_volume(odd_double());
        if (random_() % 4 == 0) run.set_light_rgb(random_());
        run.set_skips(random_() % 4 == 0);
        run.set_more_time(odd_double());
        break;
      }
      default:
        break;
    }
    return request;
  }

  void expect_valid_commands_of_random_requests();

  /** Every command that was sent must be valid, whatever was received. */
  void expect_valid_commands() {
    for (const Command& sent : sent_) {
      EXPECT_NE(sent.id, 0);
      if (const auto* walk = std::get_if<WalkCommand>(&sent.request)) {
        EXPECT_LE(std::abs(walk->vx), 0.2);
        EXPECT_LE(std::abs(walk->vy), 0.15);
        EXPECT_LE(std::abs(walk->wz), 1.0);
      } else if (const auto* posture = std::get_if<PostureCommand>(&sent.request)) {
        EXPECT_TRUE(posture->posture == "Stand" || posture->posture == "Crouch");
        EXPECT_TRUE(posture->speed > 0 && posture->speed <= 1);
      } else if (const auto* change = std::get_if<JointChangeCommand>(&sent.request)) {
        EXPECT_EQ(change->joint_names.size(), change->joint_position.size());
        for (const double value : change->joint_position) EXPECT_TRUE(std::isfinite(value));
      }
    }
    sent_.clear();
    for (const ServiceCommand& sent : services_) {
      EXPECT_NE(sent.id, 0);
      if (const auto* speech = std::get_if<SpeechCommand>(&sent.request)) {
        EXPECT_EQ(nao::check(*speech), std::nullopt);
      } else {
        EXPECT_EQ(nao::check(std::get<LightCommand>(sent.request), {"left-eye", "chest"}),
                  std::nullopt);
      }
    }
    services_.clear();
  }

  std::mt19937 random_{20240607};
};

TEST_F(GatewayFuzz, RandomBytesAreRefusedAndAffectNoOtherClient) {
  Client good = connect_driver("good");
  for (int round = 0; round < 2000; ++round) {
    Client bad = open();
    for (int i = 0; i < 12; ++i) {
      std::string bytes(random_() % 100, '\0');
      for (char& byte : bytes) byte = static_cast<char>(random_());
      (void)core_->receive(bad.id, bytes, now_);
    }
    collect(bad);
    core_->closed(bad.id, "test", now_);
    if (round % 50 == 0) {
      pass(0.02);
      EXPECT_EQ(ping(good).error(), naoremote::OK);
    }
  }
  EXPECT_EQ(core_->sessions().all().size(), 1u);
  EXPECT_TRUE(sent_.empty());
}

TEST_F(GatewayFuzz, DamagedFramesNeverYieldOversizedMessages) {
  for (int round = 0; round < 3000; ++round) {
    std::string stream;
    for (int i = 0; i < 5; ++i) stream += frame(odd_request().SerializeAsString());
    for (unsigned i = 0; i < random_() % 4; ++i) {
      stream[random_() % stream.size()] = static_cast<char>(random_());
    }
    FrameReader reader(kMaxRequestBytes);
    size_t start = 0;
    while (start < stream.size()) {
      const size_t size = 1 + random_() % 200;
      reader.add(std::string_view(stream).substr(start, size));
      start += size;
      while (const auto message = reader.next()) EXPECT_LE(message->size(), kMaxRequestBytes);
      EXPECT_LE(reader.num_waiting_bytes(), stream.size());
    }
  }
}

// At an exhibition, too.
TEST_F(GatewayFuzz, RandomRequestsYieldValidCommandsOnly) {
  expect_valid_commands_of_random_requests();
  exhibition_ = ExhibitionSetup{
      parse_exhibition("{may_speak: true, fence: {frame: start, corners: [[-1, -1], [1, -1], [0, "
                       "1]]}, attract: {period: 3, actions: [wave]}}",
                       "fair.yaml", {"Vega"}),
      "operators",
      {}};
  restart(GatewayLimits{});
  expect_valid_commands_of_random_requests();
  EXPECT_GT(core_->exhibition()->state().counts.turns, 0);
}

void GatewayFuzz::expect_valid_commands_of_random_requests() {
  std::vector<Client> clients;
  for (int i = 0; i < 5; ++i) clients.push_back(open());
  for (int round = 0; round < 20000; ++round) {
    Client& client = clients[random_() % clients.size()];
    std::string bytes = odd_request().SerializeAsString();
    if (random_() % 10 == 0 && !bytes.empty()) {
      bytes[random_() % bytes.size()] = static_cast<char>(random_());
    }
    (void)core_->receive(client.id, bytes, now_);
    if (random_() % 3 == 0) collect(client);
    client.received.clear();
    if (random_() % 5 == 0 && !sent_.empty()) {
      answer_last(static_cast<ResultStatus>(random_() % 5), "because");
    }
    has_motion_ = random_() % 50 != 0;
    pass(0.02);
    if (core_->is_closing(client.id) || random_() % 100 == 0) {
      core_->closed(client.id, "test", now_);
      client = open();
    }
    expect_valid_commands();
  }
}

}  // namespace
}  // namespace nao::gateway

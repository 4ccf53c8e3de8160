#include <cmath>

#include "test/phone-gateway/server/core/gateway_fixture.h"

namespace nao::gateway {
namespace {

using naoremote::ErrorCode;
using naoremote::Notice;
using naoremote::Request;
using naoremote::Response;

/** A gateway with a program that keeps motions; a test answers for it. */
class GatewayMotionsTest : public GatewayFixture {
 protected:
  GatewayMotionsTest() {
    start({{make_test_robot(),
            {.send = [this](const Command& command) { sent_.push_back(command); },
             .send_motion_file =
                 [this](const MotionFileCommand& command) { files_.push_back(command); },
             .drag = [this](const DragCommand& drag) { drags_.push_back(drag); }}}},
          GatewayLimits{});
    list({"bow", "_try"});
  }

  void list(const std::vector<std::string>& names) {
    MotionFileResult result;
    result.names = names;
    core_->robot().motions().handle_result(result, now_);
  }
  /** Passes time in which the program lists its motions. */
  void pass_listing(double time) {
    for (double t = 0; t < time; t += 1) {
      list({"bow", "_try"});
      pass(1);
    }
  }

  /** Sends a request whose answer comes later. */
  void send(Client& client, Request request) {
    request.set_request_id(++client.last_request_id);
    (void)core_->receive(client.id, request.SerializeAsString(), now_);
  }
  std::optional<Response> answer_to_last(Client& client) {
    collect(client);
    for (const auto& message : client.received) {
      if (message.has_response() && message.response().request_id() == client.last_request_id) {
        return message.response();
      }
    }
    return std::nullopt;
  }
  MotionFileResult result_of_last() {
    MotionFileResult result;
    result.source = files_.back().source;
    result.id = files_.back().id;
    result.names = {"bow", "_try"};
    return result;
  }

  Request save(const std::string& name, double yaw = 0.3) {
    Request request;
    naoremote::Motion& motion = *request.mutable_save_motion()->mutable_motion()->mutable_motion();
    motion.set_name(name);
    naoremote::Keyframe& keyframe = *motion.add_keyframes();
    keyframe.set_duration(1);
    keyframe.add_joint_names("HeadYaw");
    keyframe.add_joint_position(yaw);
    return request;
  }

  std::vector<MotionFileCommand> files_;
  std::vector<DragCommand> drags_;
};

TEST_F(GatewayMotionsTest, TellsEveryClientWhichMotionsThereAre) {
  Client client = open();
  Request request = make_connect("");
  EXPECT_THAT(ask(client, request).connected().robot().saved_motions(),
              testing::ElementsAre("bow"));
  list({"bow", "wave2"});
  const auto changes = notices(client, Notice::MOTIONS_CHANGED);
  ASSERT_EQ(changes.size(), 1u);
  EXPECT_THAT(changes[0].motions().names(), testing::ElementsAre("bow", "wave2"));
  list({"bow", "wave2", "_try"});
  EXPECT_EQ(notices(client, Notice::MOTIONS_CHANGED).size(), 1u);
  Request listing;
  listing.mutable_list_motions();
  EXPECT_THAT(ask(client, listing).motions().names(), testing::ElementsAre("bow", "wave2"));
}

TEST_F(GatewayMotionsTest, PlaysSavedAndTemporaryMotionsAsActions) {
  Client driver = connect_driver("Ana");
  for (const auto& [name, error] : std::map<std::string, ErrorCode>{
           {"bow", naoremote::OK}, {"_try", naoremote::OK}, {"x", naoremote::INVALID_ARGUMENT}}) {
    Request request;
    request.mutable_do_action()->set_action(name);
    EXPECT_EQ(ask(driver, request).error(), error) << name;
  }
  EXPECT_EQ(num_sent<ActionCommand>(), 2);
}

TEST_F(GatewayMotionsTest, AnswersOtherRequestsWhileAMotionIsChecked) {
  Client driver = connect_driver("Ana");
  send(driver, save("wave2"));
  ASSERT_EQ(files_.size(), 1u);
  EXPECT_EQ(files_[0].operation, MotionFileOperation::kSave);
  EXPECT_EQ(files_[0].motion.joint_names, std::vector<std::string>{"HeadYaw"});
  EXPECT_FALSE(answer_to_last(driver));
  const uint32_t id = driver.last_request_id;
  EXPECT_EQ(ping(driver).error(), naoremote::OK);
  core_->robot().motions().handle_result(result_of_last(), now_);
  driver.last_request_id = id;
  const auto answer = answer_to_last(driver);
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->error(), naoremote::OK);
  EXPECT_TRUE(answer->motion_report().is_safe());
}

TEST_F(GatewayMotionsTest, PassesOnKeyframeReasonAndRepairOfAFault) {
  Client driver = connect_driver("Ana");
  send(driver, save("wave2"));
  MotionFileResult result = result_of_last();
  result.is_ok = false;
  result.keyframe = 0;
  result.reason = Reason("motion-too-fast", {"HeadYaw", "1.2"});
  result.motion.name = "wave2";
  result.motion.joint_names = {"HeadYaw", "HeadPitch"};
  result.motion.keyframes = {{1.3, 0, {0.3, std::nan("")}, {}}};
  result.repair = "slowed-down";
  core_->robot().motions().handle_result(result, now_);
  const auto answer = answer_to_last(driver);
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->error(), naoremote::INVALID_ARGUMENT);
  EXPECT_EQ(answer->reason_code(), "motion-too-fast");
  EXPECT_EQ(answer->message(), "HeadYaw needs at least 1.2 s to this keyframe.");
  EXPECT_EQ(answer->motion_report().keyframe(), 0);
  EXPECT_EQ(answer->motion_report().repair(), "slowed-down");
  ASSERT_EQ(answer->motion_report().repaired().keyframes_size(), 1);
  EXPECT_EQ(answer->motion_report().repaired().keyframes(0).joint_names_size(), 1);
  // The program repeats a result that was asked for again: it is answered once.
  core_->robot().motions().handle_result(result, now_);
  collect(driver);
}

TEST_F(GatewayMotionsTest, SaysThatANameIsInUse) {
  Client driver = connect_driver("Ana");
  send(driver, save("bow"));
  MotionFileResult result = result_of_last();
  result.is_ok = false;
  result.reason = Reason("motion-name-in-use", {"bow"});
  core_->robot().motions().handle_result(result, now_);
  EXPECT_EQ(answer_to_last(driver)->error(), naoremote::NAME_IN_USE);
}

TEST_F(GatewayMotionsTest, RefusesToChangeFilesWithoutControl) {
  Client client = connect("Ana");
  EXPECT_EQ(ask(client, save("wave2")).error(), naoremote::NO_CONTROL);
  Request request;
  request.mutable_delete_motion()->set_name("bow");
  EXPECT_EQ(ask(client, request).error(), naoremote::NO_CONTROL);
  EXPECT_TRUE(files_.empty());
  // Reading and checking need none.
  Request reading;
  reading.mutable_get_motion()->set_name("bow");
  send(client, reading);
  ASSERT_EQ(files_.size(), 1u);
  MotionFileResult result = result_of_last();
  result.motion.name = "bow";
  result.motion.keyframes = {{1, 0, {}, {}}};
  result.yaml = "actions: ...";
  core_->robot().motions().handle_result(result, now_);
  EXPECT_EQ(answer_to_last(client)->motion_file().yaml(), "actions: ...");
  EXPECT_EQ(answer_to_last(client)->motion_file().motion().name(), "bow");
}

TEST_F(GatewayMotionsTest, RefusesWhatIsNoMotionWithoutPassingItOn) {
  Client driver = connect_driver("Ana");
  const auto expect_refused = [&](const Request& request, const std::string& code) {
    const Response response = ask(driver, request);
    EXPECT_EQ(response.error(), naoremote::INVALID_ARGUMENT);
    EXPECT_EQ(response.reason_code(), code);
  };
  Request request = save("wave2");
  request.mutable_save_motion()->mutable_motion()->mutable_motion()->clear_keyframes();
  expect_refused(request, "motion-keyframe-count");
  expect_refused(save("wave2", std::nan("")), "joint-value-not-finite");
  request = save("wave2");
  auto* keyframe =
      request.mutable_save_motion()->mutable_motion()->mutable_motion()->mutable_keyframes(0);
  keyframe->add_joint_names("HeadYaw");
  expect_refused(request, "joint-lists-unequal");
  keyframe->add_joint_position(0);
  expect_refused(request, "joint-repeated");
  keyframe->set_joint_names(1, "Tail");
  expect_refused(request, "joint-unknown");
  Request deleting;
  deleting.mutable_delete_motion()->set_name("../bow");
  expect_refused(deleting, "motion-name-invalid");
  EXPECT_TRUE(files_.empty());
}

TEST_F(GatewayMotionsTest, RepeatsARequestAndGivesUpWhenTheProgramIsSilent) {
  Client driver = connect_driver("Ana");
  send(driver, save("wave2"));
  pass_listing(3);
  EXPECT_GE(files_.size(), 3u);
  EXPECT_EQ(files_.front().id, files_.back().id);
  EXPECT_FALSE(answer_to_last(driver));
  const uint32_t id = driver.last_request_id;
  for (int i = 0; i < 4; ++i) {
    pass(1);
    ping(driver);
  }
  driver.last_request_id = id;
  ASSERT_TRUE(answer_to_last(driver));
  EXPECT_EQ(answer_to_last(driver)->error(), naoremote::ROBOT_UNAVAILABLE);
  EXPECT_EQ(ask(driver, save("wave3")).reason_code(), "motion-files-unavailable");
}

TEST_F(GatewayMotionsTest, ForgetsAClientThatLeft) {
  Client driver = connect_driver("Ana");
  send(driver, save("wave2"));
  core_->closed(driver.id, "test", now_);
  core_->robot().motions().handle_result(result_of_last(), now_);
  pass(0.1);
}

TEST_F(GatewayMotionsTest, DragsOnlyASimulatedRobot) {
  Client driver = connect_driver("Ana");
  Request request;
  request.mutable_drag()->set_link("l_wrist");
  request.mutable_drag()->set_target_x(0.2);
  EXPECT_EQ(ask(driver, request).reason_code(), "not-simulated");
  core_->robot().components().handle_simulator_status(now_);
  EXPECT_EQ(ask(driver, request).error(), naoremote::OK);
  ASSERT_EQ(drags_.size(), 1u);
  EXPECT_EQ(drags_[0].link, "l_wrist");
  EXPECT_EQ(drags_[0].target[0], 0.2);
  request.mutable_drag()->set_target_x(std::nan(""));
  EXPECT_EQ(ask(driver, request).reason_code(), "drag-out-of-range");
  Client other = connect("Bea");
  EXPECT_EQ(ask(other, request).error(), naoremote::CONTROL_TAKEN);
  Client third = open();
  EXPECT_TRUE(ask(third, make_connect("")).connected().robot().is_simulated());
}

TEST_F(GatewayMotionsTest, RelaxesAllJointsOfAGroup) {
  Client driver = connect_driver("Ana");
  Request request;
  request.mutable_change_joints()->set_group("head");
  request.mutable_change_joints()->set_stiffness(0);
  EXPECT_EQ(ask(driver, request).error(), naoremote::OK);
  const auto& change = std::get<JointChangeCommand>(sent_.back().request);
  EXPECT_EQ(change.joint_names, (std::vector<std::string>{"HeadYaw", "HeadPitch"}));
  EXPECT_EQ(change.joint_stiffness, (std::vector<double>{0, 0}));
  EXPECT_EQ(change.joint_position, (std::vector<double>{0, 0}));
  request.mutable_change_joints()->set_stiffness(1.5);
  EXPECT_EQ(ask(driver, request).reason_code(), "stiffness-out-of-range");
}

}  // namespace
}  // namespace nao::gateway

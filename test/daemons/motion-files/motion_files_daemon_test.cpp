#include "daemons/motion-files/motion_files_daemon.h"

#include <gmock/gmock.h>

#include <filesystem>
#include <naolcm/daemon_status_t.hpp>
#include <naolcm/keyframe_motion_t.hpp>

#include "common/wall_clock.h"
#include "test/daemons/motion-files/motions.h"
#include "test/support/temporary_folder.h"

namespace nao::motion_files {
namespace {

class MotionFilesDaemonTest : public testing::Test {
 protected:
  MotionFilesDaemonTest() {
    bus_.subscribe<naolcm::motion_file_result_t>("NAO_MOTION_FILE_RESULT", Bus::Queue::kAll,
                                                 [this](const auto& m) {
                                                   if (m.command_id == 1)
                                                     motions_before_result_ = motions_.size();
                                                   results_.push_back(m);
                                                 });
    bus_.subscribe<naolcm::keyframe_motion_t>("NAO_KEYFRAME_MOTION", Bus::Queue::kAll,
                                              [this](const auto& m) { motions_.push_back(m); });
  }

  /** Runs the loop until a condition holds; fails after a minute. */
  void run_until(const std::function<bool()>& condition) {
    const double start = monotonic_seconds();
    condition_ = condition;
    deadline_ = start + 60;
    loop_.run();
    EXPECT_TRUE(condition());
  }

  TemporaryFolder temporary_;
  std::filesystem::path folder_ = temporary_.path() / "motions";
  Bus bus_{"memq://"};
  EventLoop loop_;
  std::function<bool()> condition_;
  double deadline_ = 0;
  std::vector<naolcm::motion_file_result_t> results_;
  std::vector<naolcm::keyframe_motion_t> motions_;
  /** When the first command was answered. */
  size_t motions_before_result_ = 0;
};

TEST_F(MotionFilesDaemonTest, ChecksSavesAndAnnouncesAMotion) {
  const MotionFilesDaemon daemon(bus_, loop_, *test_model(), test_options(), folder_, "NAO");
  loop_.every(0.01, [this] {
    if (condition_() || monotonic_seconds() > deadline_) loop_.stop("done");
  });
  MotionFileCommand command;
  command.source = "test";
  command.id = 1;
  command.operation = MotionFileOperation::kSave;
  command.yaml = to_yaml(*test_model(), make_motion(kWave));
  bus_.publish("NAO_MOTION_FILE_COMMAND", to_message(command));
  const auto has_result = [this] {
    return std::any_of(results_.begin(), results_.end(),
                       [](const auto& result) { return result.source == "test"; });
  };
  run_until([&] { return has_result() && motions_.size() >= 3; });
  // Who reads the result may play the motion at once.
  EXPECT_EQ(motions_before_result_, 1);
  EXPECT_TRUE(results_.back().is_ok) << results_.back().reason;
  EXPECT_EQ(motions_.front().name, "test");
  EXPECT_EQ(motions_.front().num_keyframes, 3);
  // A new nao-motion receives all of them.
  motions_.clear();
  naolcm::daemon_status_t status{};
  status.program = "nao-motion";
  status.robot = "NAO";
  status.process_id = 4711;
  bus_.publish("DAEMON_STATUS", status);
  run_until([this] { return !motions_.empty(); });
  command.id = 2;
  command.operation = MotionFileOperation::kDelete;
  command.name = "test";
  motions_.clear();
  bus_.publish("NAO_MOTION_FILE_COMMAND", to_message(command));
  run_until([this] { return !motions_.empty() && motions_.back().num_keyframes == 0; });
}

}  // namespace
}  // namespace nao::motion_files

#include "daemons/motion-files/motion_file_core.h"

#include <gmock/gmock.h>

#include <filesystem>

#include "test/daemons/motion-files/motions.h"
#include "test/support/temporary_folder.h"

namespace nao::motion_files {
namespace {

using testing::ElementsAre;

class MotionFileCoreTest : public testing::Test {
 protected:
  MotionFileCommand command(MotionFileOperation operation, const std::string& name = "") {
    MotionFileCommand result;
    result.source = "test";
    result.id = ++last_id_;
    result.operation = operation;
    result.name = name;
    return result;
  }
  MotionFileCommand save(const std::string& name, bool may_replace = false) {
    MotionFileCommand result = command(MotionFileOperation::kSave, name);
    result.yaml = to_yaml(*test_model(), make_motion(kWave));
    result.may_replace = may_replace;
    return result;
  }
  /** The answer to a command that is answered at once. */
  MotionFileResult ask(const MotionFileCommand& command) {
    core_.receive(command);
    const auto results = core_.take_results();
    EXPECT_EQ(results.size(), 1u);
    return results.empty() ? MotionFileResult{} : results[0];
  }
  /** The answer to a command whose motion is checked. */
  MotionFileResult ask_and_check(const MotionFileCommand& command, bool is_safe = true) {
    core_.receive(command);
    const auto job = core_.next_job();
    EXPECT_TRUE(job);
    if (!job) return {};
    MotionReport report;
    report.script = job->script;
    if (!is_safe) report.fault = motion::MotionFault{2, Reason("motion-fall")};
    core_.finish(report);
    const auto results = core_.take_results();
    EXPECT_EQ(results.size(), 1u);
    return results.empty() ? MotionFileResult{} : results[0];
  }

  TemporaryFolder temporary_;
  std::filesystem::path folder_ = temporary_.path() / "motions";
  MotionFileCore core_{*test_model(), folder_};
  int64_t last_id_ = 0;
};

TEST_F(MotionFileCoreTest, SavesWhatWasCheckedAndAnnouncesIt) {
  const MotionFileResult saved = ask_and_check(save("wave2"));
  EXPECT_TRUE(saved.is_ok);
  EXPECT_THAT(saved.names, ElementsAre("wave2"));
  EXPECT_THAT(core_.take_changes(), ElementsAre("wave2"));
  EXPECT_EQ(core_.find("wave2").keyframes.size(), 3u);
  EXPECT_TRUE(std::filesystem::exists(folder_ / "wave2.yaml"));
  const MotionFileResult got = ask(command(MotionFileOperation::kGet, "wave2"));
  EXPECT_EQ(got.motion.name, "wave2");
  EXPECT_NE(got.yaml.find("name: wave2"), std::string::npos);
}

TEST_F(MotionFileCoreTest, SavesNothingThatIsNotSafe) {
  const MotionFileResult refused = ask_and_check(save("wave2"), false);
  EXPECT_FALSE(refused.is_ok);
  EXPECT_EQ(refused.keyframe, 2);
  EXPECT_EQ(refused.reason.code, "motion-fall");
  EXPECT_TRUE(core_.take_changes().empty());
  EXPECT_FALSE(std::filesystem::exists(folder_ / "wave2.yaml"));
}

TEST_F(MotionFileCoreTest, ChecksWithoutSaving) {
  MotionFileCommand check = save("");
  check.operation = MotionFileOperation::kCheck;
  EXPECT_TRUE(ask_and_check(check).is_ok);
  EXPECT_TRUE(core_.store().names().empty());
}

TEST_F(MotionFileCoreTest, RefusesNamesThatAreInUse) {
  EXPECT_EQ(ask(save("wave")).reason.code, "action-name-in-use");
  EXPECT_EQ(ask(save("../wave")).reason.code, "motion-name-invalid");
  ask_and_check(save("wave2"));
  EXPECT_EQ(ask(save("wave2")).reason.code, "motion-name-in-use");
  EXPECT_TRUE(ask_and_check(save("wave2", true)).is_ok);
}

TEST_F(MotionFileCoreTest, DeletesAndForgets) {
  ask_and_check(save("wave2"));
  core_.take_changes();
  EXPECT_TRUE(ask(command(MotionFileOperation::kDelete, "wave2")).is_ok);
  EXPECT_THAT(core_.take_changes(), ElementsAre("wave2"));
  EXPECT_TRUE(core_.find("wave2").keyframes.empty());
  EXPECT_EQ(ask(command(MotionFileOperation::kDelete, "wave2")).reason.code, "motion-unknown");
  EXPECT_EQ(ask(command(MotionFileOperation::kGet, "wave2")).reason.code, "motion-unknown");
}

TEST_F(MotionFileCoreTest, ExecutesARepeatedCommandOnce) {
  const MotionFileCommand saving = save("wave2");
  core_.receive(saving);
  core_.receive(saving);
  const auto job = core_.next_job();
  ASSERT_TRUE(job);
  core_.receive(saving);
  EXPECT_FALSE(core_.next_job());
  MotionReport report;
  report.script = job->script;
  core_.finish(report);
  EXPECT_FALSE(core_.next_job());
  EXPECT_EQ(core_.take_results().size(), 1u);
  EXPECT_TRUE(ask(saving).is_ok);
}

TEST_F(MotionFileCoreTest, SaysWhatIsWrongWithAText) {
  MotionFileCommand saving = save("wave2");
  saving.yaml = "actions: [{name: a, keyframes: [{duration: 1, joints: {Tail: 0}}]}]";
  const MotionFileResult refused = ask(saving);
  EXPECT_EQ(refused.reason.code, "motion-malformed");
  EXPECT_NE(refused.reason.arguments.at(0).find("Tail"), std::string::npos);
}

TEST_F(MotionFileCoreTest, IgnoresACommandWithoutASender) {
  MotionFileCommand listing = command(MotionFileOperation::kList);
  listing.source = "";
  core_.receive(listing);
  EXPECT_TRUE(core_.take_results().empty());
}

}  // namespace
}  // namespace nao::motion_files

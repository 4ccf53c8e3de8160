#include "tools/nao-tools/self_test.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <naolcm/body_state_t.hpp>

#include "common/constants.h"
#include "common/data_path.h"

namespace nao {
namespace {

using testing::HasSubstr;

/** A robot that stands, executes joint changes at once, and may be faulty. */
class SelfTestTest : public testing::Test {
 protected:
  static const RobotModel& model() {
    static const RobotModel model = RobotModel::load(data_path() / "robots" / "nao");
    return model;
  }

  SelfTestTest() {
    sample_.position = model().ready_posture().position;
    sample_.target_position = sample_.position;
    const size_t num_sensors = model().foot_sensors().size();
    sample_.foot_force.assign(num_sensors,
                              model().total_mass() * kGravity / static_cast<double>(num_sensors));
    motors_.current.assign(sample_.position.size(), 0.3);
    motors_.temperature.assign(sample_.position.size(), 40);
    motors_.status.assign(sample_.position.size(), 0);
  }

  size_t motor(const std::string& name) const {
    return static_cast<size_t>(model().find_motor(name));
  }

  /** Executes the whole test. */
  std::vector<SelfTestFinding> run() {
    SelfTest test(model());
    for (int frame = 0; frame < 100000 && !test.is_done(); ++frame) {
      if (has_body) test.measure(motors_);
      if (frame % 16 == 0) {
        for (const CameraModel& camera : model().cameras()) {
          if (camera.name != dead_camera) test.add_image(camera.name, image_bytes);
        }
      }
      test.measure(sample_, 0.012);
      if (const auto command = test.next_command()) {
        ++num_commands;
        test.end_command(execute(*command));
      }
    }
    EXPECT_TRUE(test.is_done());
    return test.findings();
  }

  std::string execute(const JointChangeCommand& command) {
    EXPECT_EQ(command.joint_names.size(), 1u);
    EXPECT_TRUE(command.is_relative);
    if (command.joint_names[0] == refused) return "refused: the robot would tip over";
    const size_t index = motor(command.joint_names[0]);
    const double change = command.joint_position[0];
    sample_.target_position[index] += change;
    move(index, change);
    EXPECT_LE(sample_.target_position[index], model().motor_joint(static_cast<int>(index)).upper);
    EXPECT_GE(sample_.target_position[index], model().motor_joint(static_cast<int>(index)).lower);
    return "";
  }

  static const SelfTestFinding& find(const std::vector<SelfTestFinding>& findings,
                                     const std::string& item) {
    for (const SelfTestFinding& finding : findings) {
      if (finding.item == item) return finding;
    }
    ADD_FAILURE() << "no " << item;
    return findings.front();
  }

  /** Expects this fault and no other. */
  void expect_fault(const std::string& item, const std::string& text) {
    const std::vector<SelfTestFinding> findings = run();
    EXPECT_EQ(find(findings, item).verdict, SelfTestFinding::Verdict::kFault)
        << find(findings, item).text;
    EXPECT_THAT(find(findings, item).text, HasSubstr(text));
    for (const SelfTestFinding& finding : findings) {
      if (finding.item != item) {
        EXPECT_NE(finding.verdict, SelfTestFinding::Verdict::kFault)
            << finding.item << finding.text;
      }
    }
  }

  SelfTestSample sample_;
  SelfTestMotors motors_;
  std::function<void(size_t, double)> move = [this](size_t index, double change) {
    sample_.position[index] += change;
  };
  bool has_body = true;
  std::string refused;
  std::string dead_camera;
  int image_bytes = 9000;
  int num_commands = 0;
};

TEST_F(SelfTestTest, FindsNothingOnAGoodRobotAndLeavesItAsItWas) {
  const std::vector<double> before = sample_.target_position;
  const std::vector<SelfTestFinding> findings = run();
  for (const SelfTestFinding& finding : findings) {
    EXPECT_EQ(finding.verdict, SelfTestFinding::Verdict::kOk)
        << finding.item << ": " << finding.text;
  }
  for (size_t i = 0; i < before.size(); ++i) {
    EXPECT_NEAR(sample_.target_position[i], before[i], 1e-12);
  }
  EXPECT_EQ(num_commands, 2 * model().num_motors());
  EXPECT_EQ(findings.size(), model().num_motors() + 2 + model().foot_sensors().size() + 1 +
                                 model().cameras().size());
  EXPECT_THAT(to_table(findings), HasSubstr("0 faults, 0 not tested"));
}

TEST_F(SelfTestTest, WorksWithoutABodyState) {
  has_body = false;
  EXPECT_THAT(to_table(run()), HasSubstr("0 faults"));
}

TEST_F(SelfTestTest, FindsADeadMotor) {
  const size_t dead = motor("LKneePitch");
  motors_.current[dead] = 0;
  move = [this, dead](size_t index, double change) {
    if (index != dead) sample_.position[index] += change;
  };
  expect_fault("joint LKneePitch", "does not move");
  EXPECT_THAT(find(run(), "joint LKneePitch").text, HasSubstr("draws no current"));
}

TEST_F(SelfTestTest, FindsAMotorThatTheRobotReports) {
  motors_.status[motor("HeadYaw")] = naolcm::body_state_t::JOINT_STATUS_DEAD;
  expect_fault("joint HeadYaw", "does not answer");
}

TEST_F(SelfTestTest, FindsAReversedJoint) {
  move = [this](size_t index, double change) {
    sample_.position[index] += index == motor("RHipRoll") ? -change : change;
  };
  expect_fault("joint RHipRoll", "the wrong way");
}

TEST_F(SelfTestTest, FindsAnEncoderOfWrongScale) {
  move = [this](size_t index, double change) {
    sample_.position[index] += index == motor("HeadPitch") ? 0.3 * change : change;
  };
  expect_fault("joint HeadPitch", "moved by");
}

TEST_F(SelfTestTest, AllowsALegOnTheGroundToTurnLess) {
  move = [this](size_t index, double change) {
    sample_.position[index] += index == motor("RHipRoll") ? 0.3 * change : change;
  };
  EXPECT_THAT(to_table(run()), HasSubstr("0 faults"));
  for (double& force : sample_.foot_force) force = 0;
  EXPECT_EQ(find(run(), "joint RHipRoll").verdict, SelfTestFinding::Verdict::kFault);
}

TEST_F(SelfTestTest, FindsExchangedJoints) {
  move = [this](size_t index, double change) {
    const size_t left = motor("LElbowYaw");
    const size_t right = motor("RElbowYaw");
    sample_.position[index == left ? right : index == right ? left : index] += change;
  };
  const std::vector<SelfTestFinding> findings = run();
  EXPECT_THAT(find(findings, "joint LElbowYaw").text, HasSubstr("RElbowYaw moves instead"));
  EXPECT_THAT(find(findings, "joint RElbowYaw").text, HasSubstr("LElbowYaw moves instead"));
}

TEST_F(SelfTestTest, FindsAnEncoderWithoutNumbers) {
  sample_.position[motor("LHand")] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(find(run(), "joint LHand").text, HasSubstr("no number"));
}

TEST_F(SelfTestTest, TriesTheOtherDirectionAndReportsWhatCannotBeTested) {
  refused = "LAnkleRoll";
  const std::vector<SelfTestFinding> findings = run();
  EXPECT_EQ(find(findings, "joint LAnkleRoll").verdict, SelfTestFinding::Verdict::kNotTested);
  EXPECT_THAT(find(findings, "joint LAnkleRoll").text, HasSubstr("would tip over"));
  EXPECT_EQ(num_commands, 2 * model().num_motors());
}

TEST_F(SelfTestTest, FindsABadAccelerometer) {
  sample_.accelerometer = {0, 0, -9.81};
  expect_fault("accelerometer", "disagrees");
  sample_.accelerometer = {0, 0, 8};
  expect_fault("accelerometer", "does not measure gravity");
  sample_.accelerometer.setZero();
  expect_fault("accelerometer", "no numbers");
}

TEST_F(SelfTestTest, FindsAGyroscopeThatIsOff) {
  sample_.gyroscope = {0, 0.06, 0};
  expect_fault("gyroscope", "restart");
}

TEST_F(SelfTestTest, FindsADeadFootSensor) {
  sample_.foot_force[2] = 0;
  const int link = model().foot_sensors()[2];
  expect_fault("foot sensor " + model().links()[static_cast<size_t>(link)].name, "reads nothing");
}

TEST_F(SelfTestTest, DoesNotTestTheFeetOfARobotThatHangs) {
  for (double& force : sample_.foot_force) force = 0;
  const std::vector<SelfTestFinding> findings = run();
  EXPECT_THAT(to_table(findings), HasSubstr("0 faults, 8 not tested"));
}

TEST_F(SelfTestTest, FindsACameraThatIsSilentOrShowsNothing) {
  dead_camera = "bottom";
  expect_fault("camera bottom", "no images");
  dead_camera.clear();
  image_bytes = 1500;
  EXPECT_THAT(find(run(), "camera top").text, HasSubstr("shows nothing"));
}

}  // namespace
}  // namespace nao

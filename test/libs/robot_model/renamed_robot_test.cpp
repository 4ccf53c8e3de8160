// A copy of the NAO with random names, and with its links and joints in random order, moves as the
// NAO does, bit for bit: no program knows a name, or depends on the files' order.

#include <gtest/gtest.h>

#include <cstring>
#include <fstream>
#include <map>

#include "common/data_path.h"
#include "sim/closed_loop/closed_loop.h"

namespace nao {
namespace {

/** The renamed copy, and its names for the NAO's. */
struct RenamedRobot {
  std::shared_ptr<const RobotModel> model;
  std::map<std::pair<std::string, std::string>, std::string> names;

  std::string name_of(const std::string& kind, const std::string& name) const {
    return names.at({kind, name});
  }
};

const RenamedRobot& renamed() {
  static const RenamedRobot robot = [] {
    RenamedRobot result;
    const std::filesystem::path folder(NAO_RENAMED_ROBOT);
    result.model = std::make_shared<const RobotModel>(RobotModel::load(folder));
    std::ifstream file(folder / "names.txt");
    for (std::string kind, old_name, new_name; file >> kind >> old_name >> new_name;) {
      result.names[{kind, old_name}] = new_name;
    }
    return result;
  }();
  return robot;
}

const std::shared_ptr<const RobotModel>& original() {
  static const auto model =
      std::make_shared<const RobotModel>(RobotModel::load(data_path() / "robots" / "nao"));
  return model;
}

TEST(RenamedRobot, HasTheSameOrderOfJointsAndBodies) {
  const RobotModel& copy = *renamed().model;
  ASSERT_EQ(copy.num_motors(), original()->num_motors());
  for (int motor = 0; motor < copy.num_motors(); ++motor) {
    EXPECT_EQ(copy.motor_names()[motor],
              renamed().name_of("joint", original()->motor_names()[motor]));
  }
  ASSERT_EQ(copy.links().size(), original()->links().size());
  for (size_t i = 0; i < copy.links().size(); ++i) {
    if (original()->links()[i].mass == 0) continue;
    EXPECT_EQ(copy.links()[i].name, renamed().name_of("link", original()->links()[i].name));
  }
}

/** The same trial with the NAO and with its copy, in turns. */
class RenamedRobotTrial : public testing::Test {
 protected:
  static ClosedLoopOptions options(const std::shared_ptr<const RobotModel>& model) {
    ClosedLoopOptions options;
    options.model = model;
    return options;
  }

  void run(double duration) {
    for (double end = nao_.time() + duration; nao_.time() < end && !HasFailure();) {
      nao_.step();
      copy_.step();
      expect_same_bits();
    }
  }
  void go_to_posture(const std::string& posture) {
    nao_.send_posture(posture, 0.8);
    copy_.send_posture(renamed().name_of("posture", posture), 0.8);
  }
  void act(const std::string& action) {
    nao_.send_action(action);
    copy_.send_action(renamed().name_of("action", action));
  }
  void turn(const std::string& joint, double angle) {
    JointChangeCommand change;
    change.joint_position = {angle};
    change.speed = 0.5;
    change.joint_names = {joint};
    nao_.send({"", 0, change});
    change.joint_names = {renamed().name_of("joint", joint)};
    copy_.send({"", 0, change});
  }
  void hold_walk(const Eigen::Vector3d& velocity) {
    nao_.hold_walk(velocity);
    copy_.hold_walk(velocity);
  }
  void release_walk() {
    nao_.release_walk();
    copy_.release_walk();
  }
  void push(const Eigen::Vector3d& impulse) {
    nao_.world().push(0, 0, impulse);
    copy_.world().push(0, 0, impulse);
  }
  ClosedLoop& nao() { return nao_; }

 private:
  void expect_same_bits() {
    const Eigen::Matrix4d pose = nao_.torso_in_world().matrix();
    const Eigen::Matrix4d copied = copy_.torso_in_world().matrix();
    ASSERT_TRUE((pose.array() == copied.array()).all()) << "torso at " << nao_.time() << " s";
    const std::vector<double>& targets = nao_.targets();
    ASSERT_EQ(targets.size(), copy_.targets().size());
    ASSERT_EQ(std::memcmp(targets.data(), copy_.targets().data(), sizeof(double) * targets.size()),
              0)
        << "targets at " << nao_.time() << " s";
    ASSERT_EQ(nao_.results().size(), copy_.results().size());
    ASSERT_EQ(nao_.core().motion_state().mode, copy_.core().motion_state().mode);
  }

  ClosedLoop nao_{options(original()), 7};
  ClosedLoop copy_{options(renamed().model), 7};
};

TEST_F(RenamedRobotTrial, WalksTheSame) {
  run(0.5);
  hold_walk({0.2, 0.03, 0.3});
  run(5);
  turn("HeadYaw", 0.4);
  hold_walk({-0.1, 0, -0.5});
  run(2);
  release_walk();
  run(2);
}

TEST_F(RenamedRobotTrial, KicksTheSame) {
  run(0.5);
  act("kick-left");
  run(5);
  act("kick-right");
  run(5);
}

TEST_F(RenamedRobotTrial, FallsAndGetsUpTheSame) {
  run(0.5);
  push({-5, 1, 0});
  run(15);
  EXPECT_LT(nao().torso_tilt(), 0.3);
}

TEST_F(RenamedRobotTrial, GoesToPosturesAndActsTheSame) {
  run(0.5);
  go_to_posture("Sit");
  run(15);
  go_to_posture("StandZero");
  run(12);
  act("wave");
  run(5);
  act("dive-right");
  run(12);
  act("rest");
  run(4);
}

}  // namespace
}  // namespace nao

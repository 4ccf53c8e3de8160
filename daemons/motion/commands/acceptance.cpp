#include "daemons/motion/commands/acceptance.h"

namespace nao::motion {
namespace {

constexpr Acceptance kNo = Acceptance::kRefuse;
constexpr Acceptance kYes = Acceptance::kReplace;

// clang-format off
constexpr Acceptance kTable[kNumCommandKinds][kNumModes] = {
    //              relaxed holding moving walking acting falling fallen getting-up no-robot
    /* walk         */ {kYes, kYes, kYes, kYes, kYes, kNo, kNo,  kNo,  kNo},
    /* move-to      */ {kYes, kYes, kYes, kYes, kYes, kNo, kNo,  kNo,  kNo},
    /* posture      */ {kYes, kYes, kYes, kYes, kYes, kNo, kYes, kNo,  kNo},
    /* joint-change */ {kNo,  kYes, kYes, kYes, kYes, kNo, kYes, kNo,  kNo},
    /* action       */ {kYes, kYes, kYes, kYes, kYes, kNo, kYes, kNo,  kNo},
    /* stop         */ {kYes, kYes, kYes, kYes, kYes, kNo, kYes, kYes, kNo},
};
// clang-format on

}  // namespace

Acceptance acceptance_of(CommandKind kind, Mode mode) {
  return kTable[static_cast<int>(kind)][static_cast<int>(mode)];
}

const char* refusal_in(Mode mode) {
  switch (mode) {
    case Mode::kRelaxed:
      return "The motors are relaxed; wake the robot up first.";
    case Mode::kFalling:
      return "The robot is falling.";
    case Mode::kFallen:
      return "The robot lies on the ground; let it get up first.";
    case Mode::kGettingUp:
      return "The robot is getting up; wait until it stands.";
    case Mode::kNoRobot:
      return "There is no robot: its sensors are silent.";
    default:
      return "The robot is busy.";
  }
}

}  // namespace nao::motion

#include "daemons/motion/commands/acceptance.h"

namespace nao::motion {
namespace {

constexpr bool kNo = false;
constexpr bool kYes = true;

// Whether a kind of command is accepted in a mode. Falls and get-up motions come before commands;
// single joints do not turn while the motors are relaxed.
// clang-format off
constexpr bool kIsAccepted[kNumCommandKinds][kNumModes] = {
    //                relaxed holding moving walking acting falling fallen getting-up no-robot
    /* walk         */ {kYes, kYes,   kYes,  kYes,   kYes,  kNo,    kNo,   kNo,       kNo},
    /* move-to      */ {kYes, kYes,   kYes,  kYes,   kYes,  kNo,    kNo,   kNo,       kNo},
    /* posture      */ {kYes, kYes,   kYes,  kYes,   kYes,  kNo,    kYes,  kNo,       kNo},
    /* joint-change */ {kNo,  kYes,   kYes,  kYes,   kYes,  kNo,    kYes,  kNo,       kNo},
    /* action       */ {kYes, kYes,   kYes,  kYes,   kYes,  kNo,    kYes,  kNo,       kNo},
    /* stop         */ {kYes, kYes,   kYes,  kYes,   kYes,  kNo,    kYes,  kYes,      kNo},
};
// clang-format on

/** Reason with which a mode refuses commands. */
Reason reason_of(Mode mode) {
  switch (mode) {
    case Mode::kRelaxed:
      return {"robot-relaxed"};
    case Mode::kFalling:
      return {"robot-falling"};
    case Mode::kFallen:
      return {"robot-fallen"};
    case Mode::kGettingUp:
      return {"robot-getting-up"};
    case Mode::kNoRobot:
      return {"no-robot"};
    case Mode::kHolding:
    case Mode::kMoving:
    case Mode::kWalking:
    case Mode::kActing:
      break;  // These modes refuse nothing.
  }
  return {};
}

}  // namespace

std::optional<Reason> find_mode_obstacle(CommandKind kind, Mode mode) {
  if (kIsAccepted[static_cast<int>(kind)][static_cast<int>(mode)]) return std::nullopt;
  return reason_of(mode);
}

}  // namespace nao::motion

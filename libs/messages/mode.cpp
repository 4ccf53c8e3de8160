#include "messages/mode.h"

namespace nao {

const char* to_string(Mode mode) {
  switch (mode) {
    case Mode::kRelaxed:
      return "relaxed";
    case Mode::kHolding:
      return "holding";
    case Mode::kMoving:
      return "moving";
    case Mode::kWalking:
      return "walking";
    case Mode::kActing:
      return "acting";
    case Mode::kFalling:
      return "falling";
    case Mode::kFallen:
      return "fallen";
    case Mode::kGettingUp:
      return "getting-up";
    case Mode::kNoRobot:
      return "no-robot";
  }
  return "unknown";
}

}  // namespace nao

// Fuzzes the messages of the GameController, and the referee that follows them.
#include <algorithm>
#include <cstdlib>
#include <iterator>
#include <vector>

#include "common/error.h"
#include "daemons/referee/game_controller_referee.h"

using namespace nao;
using namespace nao::referee;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  // The field is made here, without files.
  SceneFile scene;
  scene.field.emplace();
  scene.goals.emplace();
  scene.ball.emplace();
  GameControllerReferee referee({{"A", 0, 1}, {"B", 1, 200}}, scene, std::nullopt, 1);
  RefereeInput input;
  input.robots = {{"A"}, {"B"}};
  // Several messages, one after the other: every second one with the right beginning and size,
  // which the fuzzer would seldom find by itself.
  constexpr size_t kSize = 118;
  constexpr uint8_t kBeginning[] = {'R', 'G', 'm', 'e', 18};
  for (size_t i = 0; i < size; i += kSize) {
    std::vector<uint8_t> message(data + i, data + std::min(size, i + kSize));
    if (i / kSize % 2 == 0) {
      message.resize(kSize);
      std::copy(std::begin(kBeginning), std::end(kBeginning), message.begin());
    }
    try {
      referee.receive(decode_game_controller(message));
    } catch (const Error&) {
      continue;
    }
    input.time += 0.05;
    const RefereeOutput output = referee.step(input);
    if (output.placements.size() > 8) std::abort();
    for (const int score : referee.state().score) {
      if (score < 0 || score > 255) std::abort();
    }
    if (referee.state().time_left < 0) std::abort();
  }
  return 0;
}

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
  // Several messages, one after the other: every second one with the right beginning and size of a
  // version, which the fuzzer would seldom find by itself.
  constexpr size_t kSize = 198;
  constexpr uint8_t kBeginning[] = {'R', 'G', 'm', 'e'};
  struct Version {
    uint8_t number;
    size_t size;
  };
  constexpr Version kVersions[] = {{15, 118}, {18, 118}, {19, 198}, {20, 158}};
  for (size_t i = 0; i < size; i += kSize) {
    std::vector<uint8_t> message(data + i, data + std::min(size, i + kSize));
    if (i / kSize % 2 == 0) {
      // The place of the version chooses one.
      const Version& version =
          kVersions[message.size() > 4 ? message[4] % std::size(kVersions) : 0];
      message.resize(version.size);
      std::copy(std::begin(kBeginning), std::end(kBeginning), message.begin());
      message[4] = version.number;
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

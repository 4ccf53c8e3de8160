#include "tools/tuning/checkpoint.h"

#include <gtest/gtest.h>

#include "common/error.h"
#include "common/random.h"

namespace nao {
namespace {

Checkpoint example() {
  return {.settings = {{"--seed", "7"}, {"--engine", "fast,\"mujoco\""}},
          .costs = {{0.1, 1.0 / 3, 1e300, -0.0}, {2, 3.5e-17, 4, 5}},
          .mean = {0.7071067811865476, -12}};
}

TEST(Checkpoint, KeepsEveryBit) {
  EXPECT_EQ(Checkpoint::parse(example().to_text(), "file"), example());
  EXPECT_EQ(Checkpoint::parse(Checkpoint().to_text(), "file"), Checkpoint());
}

TEST(Checkpoint, NamesTheSettingsThatDiffer) {
  EXPECT_NO_THROW(example().require_settings(example().settings, "file"));
  try {
    example().require_settings({{"--seed", "8"}, {"--engine", "fast,\"mujoco\""}}, "a.checkpoint");
    FAIL();
  } catch (const ConfigError& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("a.checkpoint"), std::string::npos) << text;
    EXPECT_NE(text.find("--seed is 8, in the checkpoint 7"), std::string::npos) << text;
    EXPECT_EQ(text.find("--engine"), std::string::npos) << text;
  }
  EXPECT_THROW(example().require_settings({}, "file"), ConfigError);
}

TEST(Checkpoint, RefusesEveryTruncatedText) {
  const std::string text = example().to_text();
  // All but the final newline.
  for (size_t size = 0; size + 1 < text.size(); ++size) {
    EXPECT_THROW(Checkpoint::parse(text.substr(0, size), "file"), ConfigError) << size;
  }
}

TEST(Checkpoint, SurvivesDamagedTexts) {
  const std::string text = example().to_text();
  Random random(1);
  int num_refused = 0;
  for (int i = 0; i < 3000; ++i) {
    std::string damaged = text;
    for (uint64_t k = random.next() % 4 + 1; k > 0; --k) {
      const size_t at = random.next() % damaged.size();
      switch (random.next() % 3) {
        case 0:
          damaged[at] = static_cast<char>(random.next());
          break;
        case 1:
          damaged.erase(at, random.next() % 20);
          break;
        default:
          damaged.insert(at, damaged.substr(random.next() % damaged.size(), 10));
      }
      if (damaged.empty()) break;
    }
    try {
      (void)Checkpoint::parse(damaged, "file");
    } catch (const ConfigError& error) {
      ++num_refused;
      EXPECT_EQ(std::string(error.what()).substr(0, 4), "file") << error.what();
    }
  }
  EXPECT_GT(num_refused, 1000);
}

}  // namespace
}  // namespace nao

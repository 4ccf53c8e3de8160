#include "daemons/motion/transitions/transition_graph.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "common/error.h"
#include "test/daemons/motion/nao_model.h"

namespace nao::motion {
namespace {

constexpr const char* kTransitions = R"(
transitions:
  - {name: up, from: back, to: on-feet, keyframes: [{duration: 2}]}
  - {name: roll, from: back, to: belly, keyframes: [{duration: 1}]}
  - {name: push, from: belly, to: on-feet, keyframes: [{duration: 4}]}
)";

std::vector<std::string> names(const std::vector<const KeyframeSequence*>& path) {
  std::vector<std::string> result;
  for (const KeyframeSequence* sequence : path) result.push_back(sequence->name);
  return result;
}

TEST(TransitionGraph, FindsThePathOfLeastDuration) {
  const auto graph = TransitionGraph::parse(nao_model(), kTransitions);
  EXPECT_EQ(names(graph.find_path("back", "on-feet")), std::vector<std::string>{"up"});
}

TEST(TransitionGraph, AvoidsExcludedTransitions) {
  const auto graph = TransitionGraph::parse(nao_model(), kTransitions);
  EXPECT_EQ(names(graph.find_path("back", "on-feet", {graph.find("up")})),
            (std::vector<std::string>{"roll", "push"}));
  EXPECT_TRUE(graph.find_path("back", "on-feet", {graph.find("up"), graph.find("push")}).empty());
}

TEST(TransitionGraph, ReadsTheAnklesDampingAlsoOfAMirrorImage) {
  const auto graph = TransitionGraph::parse(nao_model(), R"(
transitions:
  - name: a
    from: left
    to: on-feet
    keyframes: [{duration: 1, ankle_damping: 0.1}, {duration: 1}]
  - {name: b, from: right, to: on-feet, mirrors: a}
)");
  for (const char* name : {"a", "b"}) {
    EXPECT_EQ(graph.find(name)->keyframes[0].ankle_damping, 0.1) << name;
    EXPECT_EQ(graph.find(name)->keyframes[1].ankle_damping, 0) << name;
  }
}

TEST(TransitionGraph, RefusesTimesBelowZero) {
  for (const char* keyframe :
       {"{duration: -1}", "{duration: 1, pause: -0.5}", "{duration: 1, ankle_damping: -0.1}"}) {
    const std::string text = "transitions:\n  - {name: up, from: back, to: on-feet, keyframes: [" +
                             std::string(keyframe) + "]}\n";
    EXPECT_THROW(TransitionGraph::parse(nao_model(), text), Error) << keyframe;
  }
}

}  // namespace
}  // namespace nao::motion

#include "tools/nao-trial/scenarios.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace nao::trial {
namespace {

constexpr double kAsked = 1.0;            // s until stance or ground
constexpr double kBlockTimeout = 60;      // s, getting up included
constexpr double kLow = 0.875;            // of the standing height, of the torso in the stance
constexpr double kWide = 1.7;             // of the distance of the soles when it stands
constexpr double kStandsAgain = 0.90625;  // of the standing height, when it stands again
constexpr double kLyingTilt = 1.2;        // rad

/** Time at which a condition first held, s since the start. */
class FirstTime {
 public:
  void look(bool holds, double time) {
    if (holds && std::isnan(time_)) time_ = time;
  }
  double time() const { return time_; }
  bool is_within(double limit) const { return time_ <= limit; }

 private:
  double time_ = std::numeric_limits<double>::quiet_NaN();
};

// Horizontal distance of the soles in the truth of the simulator, m.
double stance_width(ClosedLoop& trial) {
  const auto sole = [&](int link) {
    return Eigen::Vector3d(trial.world().robot(0).link_pose(link).translation());
  };
  return (sole(trial.model().left_sole()) - sole(trial.model().right_sole())).head<2>().norm();
}

RunResult act(const ScenarioOptions& options, uint64_t seed, const Action& action) {
  ClosedLoop trial(options.trial, seed);
  trial.run(1);
  const bool dives = action.kind == Action::Kind::kDive;
  const double standing = trial.model().references().heights.standing;
  const double stance = stance_width(trial);
  const double start = trial.time();
  const Eigen::Isometry3d start_torso = trial.torso_in_world();
  FirstTime reached;
  double width = 0;
  double reach = 0;
  bool fell = false;
  trial.on_tick([&] {
    const double tilt = trial.torso_tilt();
    const bool is_low_and_wide =
        trial.torso_height() < kLow * standing && stance_width(trial) > kWide * stance;
    reached.look(dives ? tilt > kLyingTilt : is_low_and_wide, trial.time() - start);
    // The dive itself ends within 3 s; getting up afterwards must not count.
    if (trial.time() - start < 3) {
      width = std::max(width, stance_width(trial));
      const Eigen::Vector3d hand = trial.torso_in_world().translation();
      reach = std::max(reach, std::abs((start_torso.inverse() * hand).y()));
    }
    // A block must keep the robot on its feet.
    fell = fell || (!dives && tilt > 0.8);
  });
  const int64_t id = trial.send_action(action.name);
  const auto end = trial.await_end(id, kBlockTimeout);
  trial.run(0.5);
  RunResult result;
  result.label = action.name;
  const bool stands = trial.torso_tilt() < 0.3 && trial.torso_height() > kStandsAgain * standing;
  if (fell) {
    result.failure = "fell";
  } else if (!end || end->status != ResultStatus::kDone) {
    result.failure = end ? to_sentence(end->reason) : "did not end";
  } else if (!stands) {
    result.failure = "does not stand";
  } else if (!reached.is_within(kAsked)) {
    result.failure = "too slow";
  } else {
    result.is_success = true;
  }
  result.metrics.emplace_back(dives ? "dive_s" : "block_s",
                              std::isnan(reached.time()) ? kBlockTimeout : reached.time());
  result.metrics.emplace_back(dives ? "dive_reach_m" : "block_width_m", dives ? reach : width);
  if (dives && stands) result.metrics.emplace_back("stand_again_s", trial.time() - start - 0.5);
  return result;
}

std::vector<RunResult> run_block(const ScenarioOptions& options, uint64_t seed) {
  std::vector<RunResult> results;
  for (const Action& action : options.trial.model->actions()) {
    const bool guards = action.kind == Action::Kind::kBlock || action.kind == Action::Kind::kDive;
    if (guards) results.push_back(act(options, seed, action));
  }
  return results;
}

}  // namespace

Scenario block_scenario() {
  return {"block",
          "Block, dive left and dive right; stand again afterwards",
          {{"block_s", "s"},
           {"block_width_m", "m"},
           {"dive_s", "s"},
           {"dive_reach_m", "m"},
           {"stand_again_s", "s"}},
          run_block};
}

}  // namespace nao::trial

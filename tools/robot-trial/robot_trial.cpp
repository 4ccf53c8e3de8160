#include "tools/robot-trial/robot_trial.h"

#include <fmt/core.h>

#include <algorithm>
#include <ctime>
#include <future>
#include <map>
#include <memory>
#include <regex>
#include <vector>

#include "common/error.h"
#include "common/output_file.h"
#include "common/text_file.h"
#include "robot_import/description_text.h"
#include "robot_import/gait_text.h"
#include "robot_import/robot_import.h"
#include "robot_model/scene_file.h"
#include "tools/nao-trial/scenarios.h"
#include "tools/robot-trial/posture_images.h"
#include "tools/walk-tuner/tune_gait.h"

namespace nao {
namespace {

using trial::RunResult;
using trial::ScenarioOptions;

constexpr double kStandDuration = 20;  // s
constexpr double kWalkDuration = 10;   // s
// Seeds of the search, and those of the card, which the search does not use. Chosen: beyond the
// usual ones of nao-trial, and below those of the tuners.
constexpr uint64_t kSearchSeed = 500'001;
constexpr uint64_t kCardSeed = 600'001;
constexpr int kNumCardRuns = 5;
// Seeds that run at a time, and rounds of them: after a round without success the rest is given up.
constexpr int kSeedsPerRound = 2;
constexpr int kNumStandRounds = 2;
constexpr int kNumWalkRounds = 5;
// Greatest tried push, as a change of the whole robot's velocity, m/s, and its bisection.
constexpr double kGreatestPush = 1;
constexpr int kNumHalvings = 5;

double metric(const RunResult& run, const std::string& name, double otherwise) {
  for (const auto& [key, value] : run.metrics) {
    if (key == name) return value;
  }
  return otherwise;
}

/** How near a walk came to success, 0 to 1. */
double quality_of(const RunResult& walk) {
  if (walk.is_success) return 1;
  return 0.9 * std::min(1.0, metric(walk, "upright_s", kWalkDuration) / kWalkDuration);
}

/** Processor time of all threads, s: a search finds the same on a machine that does other work,
 * only later. */
double processor_time() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

/** Height above the soles at the angles 0, m. */
double measure_height(const RobotModel& model) {
  const auto poses = model.link_poses(std::vector<double>(model.num_motors(), 0.0));
  double top = 0;
  for (size_t i = 0; i < poses.size(); ++i) {
    top = std::max(top, poses[i].translation().z());
    for (const Shape& shape : model.links()[i].collisions) {
      const Eigen::Isometry3d pose = poses[i] * shape.pose_in_link;
      const Eigen::RowVector3d up = pose.linear().row(2).cwiseAbs();
      top = std::max(top, pose.translation().z() + 0.5 * up.dot(shape.size) + shape.radius +
                              0.5 * up.z() * shape.length);
    }
  }
  return top - poses[model.left_sole()].translation().z();
}

class RobotTrial {
 public:
  RobotTrial(const std::filesystem::path& folder, double minutes)
      : folder_(folder),
        end_(processor_time() + kSeedsPerRound * 60 * minutes),
        robot_text_(read_file(folder / "robot.yaml")),
        postures_text_(read_file(folder / "postures.yaml")),
        limits_(RobotModel::load(folder).walk_limits()),
        has_gait_(std::filesystem::exists(folder / "gait.yaml")) {
    options_.trial.scene = SceneFile::find("empty");
  }

  bool is_time_over() const { return processor_time() >= end_; }
  bool has_gait() const { return has_gait_; }
  const RobotModel& model() const { return *options_.trial.model; }

  /** Writes the settings into the robot's files, and loads it. */
  void write(const RobotSettings& settings) {
    std::string text =
        std::regex_replace(robot_text_, std::regex("motor_defaults: \\{"),
                           fmt::format("motor_defaults: {{peak_error: {}, ", settings.peak_error));
    text = std::regex_replace(
        text, std::regex("walk_limits: \\{[^}]*\\}"),
        fmt::format(
            "walk_limits: {{forward: {:.4g}, backward: {:.4g}, sideways: {:.4g}, turning: {:.4g}}}",
            settings.speed * limits_.forward, settings.speed * limits_.backward,
            settings.speed * limits_.sideways, settings.speed * limits_.turning));
    replace_file(folder_ / "robot.yaml", text);
    load();
    if (!has_gait_) return;
    if (settings.foot_distance != foot_distance_) {
      foot_distance_ = settings.foot_distance;
      Findings findings;
      replace_file(folder_ / "postures.yaml",
                   foot_distance_ == 1 ? postures_text_
                                       : make_postures_text(model(), findings, foot_distance_));
      load();
    }
    replace_file(folder_ / "gait.yaml",
                 make_gait_text(model(), {settings.swing_height, settings.hip_height,
                                          settings.step_duration, settings.foot_distance}));
  }

  void load() {
    options_.trial.model = std::make_shared<const RobotModel>(RobotModel::load(folder_));
    options_.velocity.x() = model().walk_limits().forward;
  }

  /** Stands and walks with other seeds than the card, until the time is over. */
  SettingsResult evaluate(const RobotSettings& settings) {
    SettingsResult result;
    // What a robot stands with are its servos and its posture.
    const auto [known, is_new] =
        stands_.try_emplace({settings.peak_error, settings.foot_distance}, result);
    if (is_new) {
      const std::vector<RunResult> stands =
          run_rounds(trial::stand_scenario(), kStandDuration, kNumStandRounds);
      count(stands, known->second.stands, known->second.failure);
    }
    result = known->second;
    // A gait is of no use to a robot that does not stand; one without a gait can do no better.
    if (result.stands == 0 || !has_gait_) {
      result.walks = has_gait_ ? 0 : 1;
      return result;
    }
    std::vector<RunResult> walks =
        run_rounds(trial::walk_scenario(), kWalkDuration, kNumWalkRounds);
    count(walks, result.walks, result.failure);
    if (result.holds()) {
      // Some settings hold by luck: as many seeds again.
      const auto more = run(trial::walk_scenario(), kWalkDuration, kSearchSeed + walks.size(),
                            static_cast<int>(walks.size()));
      walks.insert(walks.end(), more.begin(), more.end());
      result.walks = 0;
      count(walks, result.walks, result.failure);
    }
    for (const RunResult& walk : walks) {
      result.quality += quality_of(walk) / static_cast<double>(walks.size());
    }
    return result;
  }

  /** Fills in what the robot does with the seeds of the card. */
  void measure(RobotCard& card) const {
    card.runs = kNumCardRuns;
    const auto stands = run(trial::stand_scenario(), kStandDuration, kCardSeed, kNumCardRuns);
    const auto walks = has_gait_ && card.failure.empty()
                           ? run(trial::walk_scenario(), kWalkDuration, kCardSeed, kNumCardRuns)
                           : std::vector<RunResult>();
    for (const RunResult& stand : stands) {
      card.stands += stand.is_success ? 1 : 0;
      if (!stand.is_success) card.failure = "stand: " + stand.failure;
    }
    for (const RunResult& walk : walks) {
      if (!walk.is_success) card.failure = "walk: " + walk.failure;
      if (!walk.is_success) continue;
      ++card.walks;
      card.speed += metric(walk, "speed_mps", 0);
    }
    card.speed /= std::max(1, card.walks);
    if (card.stands > 0) card.push = find_push();
  }

 private:
  std::vector<RunResult> run(const trial::Scenario& scenario, double duration, uint64_t first,
                             int count) const {
    ScenarioOptions options = options_;
    options.duration = duration;
    std::vector<RunResult> results(count);
    std::vector<std::future<void>> threads;
    for (int thread = 0; thread < kSeedsPerRound; ++thread) {
      threads.push_back(std::async(std::launch::async, [&, thread] {
        for (int i = thread; i < count; i += kSeedsPerRound) {
          results[i] = scenario.run(options, first + static_cast<uint64_t>(i)).front();
        }
      }));
    }
    for (std::future<void>& thread : threads) thread.get();
    return results;
  }

  std::vector<RunResult> run_rounds(const trial::Scenario& scenario, double duration,
                                    int num_rounds) const {
    std::vector<RunResult> results;
    for (int round = 0; round < num_rounds; ++round) {
      const bool fails = std::none_of(results.begin(), results.end(),
                                      [](const RunResult& result) { return result.is_success; });
      if (round > 0 && (fails || is_time_over())) break;
      const auto found = run(scenario, duration,
                             kSearchSeed + static_cast<uint64_t>(results.size()), kSeedsPerRound);
      results.insert(results.end(), found.begin(), found.end());
    }
    return results;
  }

  static void count(const std::vector<RunResult>& runs, double& fraction, std::string& failure) {
    for (const RunResult& run : runs) {
      fraction += (run.is_success ? 1.0 : 0.0) / static_cast<double>(runs.size());
      if (!run.is_success) failure = run.failure;
    }
  }

  /** Greatest impulse on the standing robot's root that it withstands from all sides, N s. */
  double find_push() const {
    const auto withstands = [&](double impulse) {
      for (const auto& [x, y] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
        ClosedLoop loop(options_.trial, kCardSeed);
        loop.run(1);
        loop.world().push(0, 0, impulse * Eigen::Vector3d(x, y, 0));
        loop.run(3);
        if (loop.torso_tilt() > 0.3) return false;
      }
      return true;
    };
    double low = 0;
    double high = kGreatestPush * model().total_mass();
    for (int i = 0; i < kNumHalvings; ++i) {
      const double middle = 0.5 * (low + high);
      (withstands(middle) ? low : high) = middle;
    }
    return low;
  }

  std::filesystem::path folder_;
  /** s of processor_time(). */
  double end_;
  std::string robot_text_;
  std::string postures_text_;
  /** Of the postures that are written. */
  double foot_distance_ = 1;
  WalkLimits limits_;
  bool has_gait_;
  /** Results of standing, by peak error and distance of the feet. */
  std::map<std::pair<double, double>, SettingsResult> stands_;
  ScenarioOptions options_;
};

/** Searches a better gait, and keeps it if it walks at least as often. */
void tune(const std::filesystem::path& folder, double minutes, const RobotSettings& settings,
          RobotTrial& trial, SettingsResult& result) {
  const std::string before = read_file(folder / "gait.yaml");
  tool::TunerOptions options;
  options.folder = folder;
  options.search.model = folder.filename().string();
  options.search.output = (folder / "gait.yaml").string();
  options.search.checkpoint = (folder / "gait.checkpoint").string();
  options.search.disturbances = {"moderate"};
  options.search.generations = std::numeric_limits<int>::max();
  options.search.minutes = minutes;
  options.search.screen = 5;
  tool::tune_gait(options);
  std::filesystem::remove(folder / "gait.checkpoint");
  const SettingsResult tuned = trial.evaluate(settings);
  if (tuned.score() < result.score()) {
    replace_file(folder / "gait.yaml", before);
  } else {
    result = tuned;
  }
}

}  // namespace

RobotCard try_robot(const std::filesystem::path& folder, double minutes, double tune_minutes,
                    const std::function<void(const std::string&)>& progress) {
  RobotTrial trial(folder, minutes);
  SettingsResult result;
  RobotCard card;
  card.settings = climb_ladder(
      [&](const RobotSettings& settings) {
        trial.write(settings);
        SettingsResult found = trial.evaluate(settings);
        progress(fmt::format(
            "peak error {}, speed {}, swing {}, hips {}, step {}, feet {}: stands {:.0f} %, "
            "walks {:.0f} %{}",
            settings.peak_error, settings.speed, settings.swing_height, settings.hip_height,
            settings.step_duration, settings.foot_distance, 100 * found.stands,
            trial.has_gait() ? 100 * found.walks : 0,
            found.failure.empty() ? "" : " (" + found.failure + ")"));
        return found;
      },
      [&] { return trial.is_time_over(); }, result);
  trial.write(card.settings);
  if (tune_minutes > 0 && trial.has_gait() && result.stands > 0) {
    tune(folder, tune_minutes, card.settings, trial, result);
  }
  const RobotModel& model = trial.model();
  card.name = folder.filename().string();
  // Without the plates that hold a robot without legs.
  card.mass = model.total_mass() - model.links()[model.left_sole()].mass -
              model.links()[model.right_sole()].mass;
  card.height = measure_height(model);
  card.motors = model.num_motors();
  Eigen::AlignedBox2d sole;
  for (const Eigen::Vector2d& corner : model.left_sole_outline()) sole.extend(corner);
  card.sole_length = sole.sizes().x();
  card.sole_width = sole.sizes().y();
  card.commanded_speed = model.walk_limits().forward;
  card.missing = check_robot(folder);
  if (!trial.has_gait()) card.failure = "walk: it has no gait, see what is missing";
  trial.measure(card);
  try {
    for (const std::string& name : draw_postures(model, folder / "images")) {
      card.images.push_back("images/" + name);
    }
  } catch (const Error& error) {
    card.no_images = error.what();
  }
  replace_file(folder / "card.json", to_json(card));
  return card;
}

}  // namespace nao

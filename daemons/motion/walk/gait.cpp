#include "daemons/motion/walk/gait.h"

#include <utility>

#include "common/parameter_table.h"

namespace nao::motion {
namespace {

NAO_PARAMETER_TABLE(Gait, timing, stance, swing, step_limits, velocity, zmp, feedback, orientation,
                    standing, servo, kick, arms)

}  // namespace

std::optional<Gait::Contradiction> Gait::find_contradiction() const {
  if (timing.min_step_duration > timing.step_duration ||
      timing.step_duration > timing.max_step_duration) {
    return Contradiction{"timing.step_duration",
                         "must lie between min_step_duration and max_step_duration"};
  }
  if (step_limits.min_foot_separation > stance.foot_separation) {
    // The feet would never stand side by side, and the walk would not end.
    return Contradiction{"step_limits.min_foot_separation",
                         "must not be above stance.foot_separation"};
  }
  if (velocity.full_speed_lag >= velocity.slow_speed_lag) {
    return Contradiction{"velocity.slow_speed_lag", "must be above full_speed_lag"};
  }
  return std::nullopt;
}

// The file must hold all parameters and no others; each with its value inside its range.
Gait Gait::load(const std::filesystem::path& file, std::vector<Parameter>* parameters) {
  const YamlEntry root = YamlEntry::load(file);
  Gait gait;
  std::vector<Parameter> read;
  read_parameters(root, all_parameters(),
                  [&](const NamedParameter<Gait>& known, const YamlEntry& entry) {
                    entry.allow_only({"value", "range"});
                    const double value = entry.at("value").number();
                    const std::vector<double> range = entry.at("range").numbers(2);
                    // Written so that NaN fails, too.
                    if (!(range[0] <= value && value <= range[1]))
                      entry.fail("has a value outside its range");
                    known.in(gait) = value;
                    read.push_back({known.name, known.in, range[0], range[1]});
                  });
  for (const NamedParameter<Gait>& parameter : all_parameters()) {
    (void)parameter_entry(root, parameter.name);
  }
  if (const auto found = gait.find_contradiction()) {
    parameter_entry(root, found->parameter).fail(found->requirement);
  }
  if (parameters != nullptr) *parameters = std::move(read);
  return gait;
}

}  // namespace nao::motion

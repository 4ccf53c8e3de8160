#include "daemons/motion/actions/kick.h"

#include "common/yaml_entry.h"

namespace nao::motion {
namespace {

Eigen::Vector2d pair_of(const YamlEntry& entry) {
  const std::vector<double> values = entry.numbers(2);
  return {values[0], values[1]};
}

}  // namespace

Kick Kick::load(const std::filesystem::path& file) {
  const YamlEntry root = YamlEntry::load(file);
  root.allow_only({"ball", "ball_reach", "foot_reach", "ball_contact", "strike_duration",
                   "strength", "balance_gain", "zmp_reach", "phases", "impact"});
  Kick kick;
  kick.ball = pair_of(root.at("ball"));
  kick.ball_reach = pair_of(root.at("ball_reach"));
  kick.foot_reach = pair_of(root.at("foot_reach"));
  kick.ball_contact = root.at("ball_contact").number();
  const std::vector<double> strike = root.at("strike_duration").numbers(2);
  if (strike[0] <= 0 || strike[1] <= 0) root.at("strike_duration").fail("must be above 0");
  kick.strike_duration = {strike[0], strike[1]};
  kick.strength = root.at("strength").number();
  kick.balance_gain = root.at("balance_gain").number();
  kick.zmp_reach = pair_of(root.at("zmp_reach"));
  // Phases in time order: positions of CoM and foot at the end of each, m, relative to the support
  // foot; and pitch of the foot, rad.
  for (const YamlEntry& item : root.at("phases").items()) {
    item.allow_only({"name", "duration", "com", "foot", "pitch"});
    Phase phase;
    phase.name = item.at("name").text();
    phase.duration = item.at("duration").number();
    if (phase.duration <= 0) item.at("duration").fail("must be above 0");
    phase.com = pair_of(item.at("com"));
    const std::vector<double> foot = item.at("foot").numbers(3);
    phase.foot = {foot[0], foot[1], foot[2]};
    phase.pitch = item.at("pitch").number();
    kick.phases.push_back(phase);
  }
  if (root.has("impact")) kick.impact = KickImpact::read(root.at("impact"));
  if (kick.phases.empty()) root.at("phases").fail("must not be empty");
  return kick;
}

}  // namespace nao::motion

#include "robot_import/touching_bodies.h"

#include <map>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include "robot_import/yaml_name.h"
#include "robot_model/collision_shape.h"

namespace nao {
namespace {

// Distance at which two shapes touch, m. Chosen: joints give way by as much under load.
constexpr double kTouching = 2e-3;
// Random poses, and the fraction of them in which a pair touches "nearly always". Pairs that touch
// less often than in half of the first poses are not looked at again.
constexpr int kNumPoses = 1000;
constexpr double kNearlyAlways = 0.95;
constexpr int kNumFirstPoses = 100;

struct Part {
  int link = -1;
  int body = -1;
  RoundedBox box;
};

std::vector<Part> find_parts(const RobotModel& model) {
  std::vector<Part> parts;
  for (int link = 0; link < static_cast<int>(model.links().size()); ++link) {
    for (const Shape& shape : model.links()[link].collisions) {
      // The surface is that of the shape itself: the radius of its edges only rounds them.
      parts.push_back(
          {link, model.find_body(link), rounded_box_in_link(model.links()[link], shape, 1e-3)});
    }
  }
  return parts;
}

bool touch(const Part& a, const Part& b, const std::vector<Eigen::Isometry3d>& poses) {
  RoundedBox box_a = a.box;
  RoundedBox box_b = b.box;
  box_a.center = poses[a.link] * a.box.center;
  box_b.center = poses[b.link] * b.box.center;
  const double reach = a.box.half.norm() + a.box.radius + b.box.half.norm() + b.box.radius;
  if ((box_a.center - box_b.center).norm() > reach + kTouching) return false;
  box_a.rotation = poses[a.link].linear() * a.box.rotation;
  box_b.rotation = poses[b.link].linear() * b.box.rotation;
  return closest_points(box_a, box_b).distance < kTouching;
}

using BodyPair = std::pair<int, int>;
/** Parts of two bodies, as indices. */
using PartPairs = std::map<BodyPair, std::vector<std::pair<int, int>>>;

bool touch(const std::vector<Part>& parts, const std::vector<std::pair<int, int>>& pairs,
           const std::vector<Eigen::Isometry3d>& poses) {
  for (const auto& [a, b] : pairs) {
    if (touch(parts[a], parts[b], poses)) return true;
  }
  return false;
}

}  // namespace

std::string make_allowed_contacts_text(const RobotModel& model) {
  const std::vector<Part> parts = find_parts(model);
  std::set<BodyPair> allowed;
  for (const auto& [a, b] : model.allowed_contacts()) {
    allowed.insert(std::minmax(model.find_body(a), model.find_body(b)));
  }
  PartPairs pairs;
  for (int i = 0; i < static_cast<int>(parts.size()); ++i) {
    for (int k = i + 1; k < static_cast<int>(parts.size()); ++k) {
      const BodyPair bodies = std::minmax(parts[i].body, parts[k].body);
      if (bodies.first != bodies.second && !allowed.contains(bodies)) {
        pairs[bodies].emplace_back(i, k);
      }
    }
  }
  std::vector<BodyPair> found;
  const auto find_in = [&](const std::vector<double>& position) {
    const auto poses = model.link_poses(position);
    for (auto pair = pairs.begin(); pair != pairs.end();) {
      const bool touches = touch(parts, pair->second, poses);
      if (touches) found.push_back(pair->first);
      pair = touches ? pairs.erase(pair) : std::next(pair);
    }
  };
  for (const Posture& posture : model.postures()) find_in(posture.position);

  std::map<BodyPair, int> counts;
  std::mt19937 random(1);
  for (int pose = 0; pose < kNumPoses; ++pose) {
    std::vector<double> position;
    for (int motor = 0; motor < model.num_motors(); ++motor) {
      const Joint& joint = model.motor_joint(motor);
      position.push_back(std::uniform_real_distribution<double>(joint.lower, joint.upper)(random));
    }
    const auto poses = model.link_poses(position);
    for (const auto& [bodies, part_pairs] : pairs) {
      if (touch(parts, part_pairs, poses)) ++counts[bodies];
    }
    if (pose + 1 == kNumFirstPoses) {
      std::erase_if(pairs,
                    [&](const auto& pair) { return counts[pair.first] < kNumFirstPoses / 2; });
    }
  }
  for (const auto& [bodies, count] : counts) {
    if (count >= kNearlyAlways * kNumPoses) found.push_back(bodies);
  }

  std::string text;
  for (const auto& [a, b] : found) {
    text +=
        "  - [" + in_yaml(model.links()[a].name) + ", " + in_yaml(model.links()[b].name) + "]\n";
  }
  if (text.empty()) return text;
  return "\n# Bodies whose collision shapes overlap by construction: their contact does not "
         "count.\n"
         "allowed_contacts:\n" +
         text;
}

}  // namespace nao

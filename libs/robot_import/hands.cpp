#include "robot_import/hands.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "robot_import/repair_log.h"
#include "robot_import/urdf_values.h"
#include "robot_model/child_elements.h"

namespace nao {
namespace {

// Fingers of a hand whose joints get one motor. Chosen: two branches may be a gear of the wrist.
constexpr int kLeastFingers = 3;

/** How a joint follows a motor: angle = ratio * motor's angle + offset. */
struct Follower {
  int motor = -1;
  double ratio = 1;
  double offset = 0;
};

class Hands {
 public:
  explicit Hands(const RobotModel& model) : model_(model) {}

  /** @param end, other  Last links of the two arms. @return The link that carries the fingers; -1:
   * the arm does not branch. */
  int find_palm(int end, int other) const {
    const std::vector<int> chain = model_.find_chain(end);
    const std::vector<int> mirrored = model_.find_chain(other);
    for (size_t i = chain.size(); i-- > 1;) {
      const int joint = chain[i - 1];
      if (std::find(mirrored.begin(), mirrored.end(), joint) != mirrored.end()) break;
      const int count = count_fingers(joint);
      if (count < 2) continue;
      const bool is_hand = count >= kLeastFingers || motors_below(joint).size() == 1;
      return is_hand ? model_.joints()[joint].child_link : -1;
    }
    return -1;
  }

  /** The motors of the fingers on a palm. */
  std::vector<int> motors_on(int palm) const {
    const std::vector<int> chain = model_.find_chain(palm);
    return chain.empty() ? std::vector<int>() : motors_below(chain.back());
  }

  /** The first motor with a range of at least half of the widest: small ratios. @param motors  Not
   * empty. */
  int find_leader(const std::vector<int>& motors) const {
    const auto range = [&](int motor) {
      const Joint& joint = model_.motor_joint(motor);
      return std::abs(bent(joint) - straight(joint));
    };
    double widest = 0;
    for (const int motor : motors) widest = std::max(widest, range(motor));
    return *std::find_if(motors.begin(), motors.end(),
                         [&](int motor) { return range(motor) >= 0.5 * widest; });
  }

  /** Fingers bend from the angle next to 0 to their farther limits, all in the same time. */
  Follower follow(int motor, int leader) const {
    const Joint& joint = model_.motor_joint(motor);
    const Joint& first = model_.motor_joint(leader);
    const double ratio = (bent(joint) - straight(joint)) / (bent(first) - straight(first));
    return {leader, ratio, straight(joint) - ratio * straight(first)};
  }

 private:
  static double straight(const Joint& joint) { return std::clamp(0.0, joint.lower, joint.upper); }
  static double bent(const Joint& joint) {
    return std::abs(joint.lower) > std::abs(joint.upper) ? joint.lower : joint.upper;
  }

  /** Joints below this one. */
  std::vector<int> joints_below(int joint) const {
    std::vector<int> below;
    for (int i = 0; i < static_cast<int>(model_.joints().size()); ++i) {
      const Joint& other = model_.joints()[i];
      const bool is_revolute = other.kind == Joint::Kind::kRevolute;
      if (is_revolute && i != joint && model_.moves(joint, other.child_link)) below.push_back(i);
    }
    return below;
  }

  int count_fingers(int joint) const {
    const std::vector<int> below = joints_below(joint);
    return static_cast<int>(std::count_if(below.begin(), below.end(), [&](int tip) {
      return std::none_of(below.begin(), below.end(), [&](int other) {
        return other != tip && model_.moves(tip, model_.joints()[other].child_link);
      });
    }));
  }

  std::vector<int> motors_below(int joint) const {
    std::vector<int> motors;
    for (const int below : joints_below(joint)) {
      const int motor = model_.motor_of(below);
      if (motor >= 0 && model_.motors()[motor] == below) motors.push_back(motor);
    }
    return motors;
  }

  const RobotModel& model_;
};

void write_mimic(TiXmlElement& joint, const std::string& leader, double ratio, double offset) {
  if (TiXmlElement* mimic = joint.FirstChildElement("mimic")) joint.RemoveChild(mimic);
  TiXmlElement mimic("mimic");
  mimic.SetAttribute("joint", leader.c_str());
  mimic.SetAttribute("multiplier", to_text(ratio).c_str());
  mimic.SetAttribute("offset", to_text(offset).c_str());
  joint.InsertEndChild(mimic);
}

}  // namespace

std::string with_hands_of_one_motor(const std::string& text, const RobotModel& model,
                                    const std::string& file, RobotStructure& structure,
                                    Findings& findings) {
  if (structure.hands.size() != 2) return text;
  const Hands hands(model);
  const std::vector<int> palms = {hands.find_palm(structure.hands[0], structure.hands[1]),
                                  hands.find_palm(structure.hands[1], structure.hands[0])};
  if (palms[0] < 0 || palms[1] < 0) return text;
  structure.hands = palms;
  std::map<int, Follower> followers;
  for (const int palm : palms) {
    const std::vector<int> motors = hands.motors_on(palm);
    if (motors.empty()) continue;
    const int leader = hands.find_leader(motors);
    for (const int motor : motors) {
      if (motor != leader) followers[motor] = hands.follow(motor, leader);
    }
  }
  if (followers.empty()) return text;
  TiXmlDocument document;
  document.Parse(text.c_str());
  RepairLog log{file, {}};
  TiXmlElement* robot = document.FirstChildElement("robot");
  for (TiXmlElement* element : child_elements(*robot, "joint")) {
    const int joint = model.find_joint(element->Attribute("name"));
    const int motor = joint < 0 ? -1 : model.motor_of(joint);
    const auto follower = followers.find(motor);
    if (follower == followers.end()) continue;
    // What mimics a follower follows the leader itself.
    const Joint& own = model.joints()[joint];
    const auto& [leader, ratio, offset] = follower->second;
    const std::string& name = model.motor_joint(leader).name;
    write_mimic(*element, name, own.mimic_multiplier * ratio,
                own.mimic_multiplier * offset + own.mimic_offset);
    log.note(Finding::Severity::kRepaired, *element, "joint " + own.name,
             "is one of a hand's fingers",
             "it follows " + name + ", which opens and closes the hand");
  }
  findings.insert(findings.end(), log.findings.begin(), log.findings.end());
  return to_text(document);
}

}  // namespace nao

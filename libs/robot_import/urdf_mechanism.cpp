#include "robot_import/urdf_mechanism.h"

#include <algorithm>
#include <map>
#include <set>
#include <vector>

#include "robot_import/urdf_values.h"
#include "robot_model/child_elements.h"

namespace nao {
namespace {

using Severity = Finding::Severity;

// Mass of a link that stands between others and has none, fraction of the robot's. Chosen: small
// against every real part, and no trouble for an integrator.
constexpr double kLeastMassFraction = 2e-4;

class MechanismRepair {
 public:
  MechanismRepair(TiXmlElement& robot, RepairLog& log) : log_(log) {
    for (TiXmlElement* link : child_elements(robot, "link")) {
      links_[link->Attribute("name")] = link;
    }
    for (TiXmlElement* joint : child_elements(robot, "joint")) {
      joints_.push_back(joint);
      by_name_[joint->Attribute("name")] = joint;
    }
  }

  void run() {
    follow_mimics();
    hold_virtual_joints();
    for (const auto& [name, link] : links_) total_mass_ += mass_of(*link);
    for (TiXmlElement* joint : joints_) {
      if (is_fixed(*joint) || body_mass(child_of(*joint)) > 0) continue;
      if (branch_mass(child_of(*joint), 0) <= 0) {
        hold_joint(*joint, 0, "moves nothing that has a mass", log_);
      } else {
        add_mass(*links_.at(child_of(*joint)));
      }
    }
  }

 private:
  static bool is_fixed(const TiXmlElement& joint) {
    return std::string(joint.Attribute("type")) == "fixed";
  }
  static std::string child_of(const TiXmlElement& joint) { return link_of(joint, "child"); }

  /** First link of the body that a link belongs to. */
  std::string body_of(std::string link) const {
    for (size_t step = 0; step < joints_.size(); ++step) {
      const auto above = std::find_if(
          joints_.begin(), joints_.end(),
          [&](const TiXmlElement* joint) { return is_fixed(*joint) && child_of(*joint) == link; });
      if (above == joints_.end()) break;
      link = link_of(**above, "parent");
    }
    return link;
  }
  double body_mass(const std::string& link) const {
    double mass = 0;
    const std::string body = body_of(link);
    for (const auto& [name, element] : links_) {
      if (mass_of(*element) > 0 && body_of(name) == body) mass += mass_of(*element);
    }
    return mass;
  }
  // The depth ends a walk along a cycle, which the reader of the file refuses later.
  double branch_mass(const std::string& link, size_t depth) const {
    const auto found = links_.find(link);
    if (found == links_.end() || depth > joints_.size()) return 0;
    double mass = mass_of(*found->second);
    for (const TiXmlElement* joint : joints_) {
      if (link_of(*joint, "parent") == link) mass += branch_mass(child_of(*joint), depth + 1);
    }
    return mass;
  }

  void follow_mimics() {
    // The leaders as the file states them: a follower may come before its leader.
    for (TiXmlElement* joint : joints_) {
      TiXmlElement* mimic = joint->FirstChildElement("mimic");
      if (mimic == nullptr) continue;
      if (is_fixed(*joint)) {
        joint->RemoveChild(mimic);
        continue;
      }
      const std::string first = leader_of(*joint);
      double ratio = 1;
      double offset = 0;
      const TiXmlElement* leader = joint;
      std::set<const TiXmlElement*> seen;
      // angle = ratio * leader's angle + offset, through all joints that mimic others.
      while (leader != nullptr && seen.insert(leader).second) {
        const TiXmlElement* next = leader->FirstChildElement("mimic");
        if (next == nullptr) break;
        offset += ratio * read_number(*next, "offset", 0);
        ratio *= read_number(*next, "multiplier", 1);
        const auto found = by_name_.find(leader_of(*leader));
        leader = found == by_name_.end() ? nullptr : found->second;
      }
      if (leader == nullptr || leader->FirstChildElement("mimic") != nullptr) {
        followers_.push_back(
            {joint, nullptr, 0, 0, "mimics \"" + first + "\", which is not a joint with a motor"});
      } else if (is_fixed(*leader)) {
        followers_.push_back({joint, nullptr, 0, offset, "mimics " + first + ", which is fixed"});
      } else {
        followers_.push_back({joint, leader, ratio, offset, ""});
      }
    }
    for (const Follower& follower : followers_) {
      if (follower.leader == nullptr) {
        hold_joint(*follower.joint, follower.offset, follower.problem, log_);
        continue;
      }
      TiXmlElement& mimic = *follower.joint->FirstChildElement("mimic");
      if (follower.leader->Attribute("name") != leader_of(*follower.joint)) {
        log_.note(Severity::kRepaired, mimic, title_of(*follower.joint),
                  "mimics a joint that mimics another one",
                  std::string("it follows ") + follower.leader->Attribute("name") + " itself");
        mimic.SetAttribute("joint", follower.leader->Attribute("name"));
        mimic.SetAttribute("multiplier", to_text(follower.ratio).c_str());
        mimic.SetAttribute("offset", to_text(follower.offset).c_str());
      }
    }
  }

  // Joints that only place a free robot in the world: the root moves freely without them.
  void hold_virtual_joints() {
    for (size_t step = 0; step < joints_.size(); ++step) {
      std::vector<TiXmlElement*> moving;
      std::string root;
      for (const auto& [name, link] : links_) {
        const std::string& link_name = name;
        const bool is_child = std::any_of(joints_.begin(), joints_.end(), [&](TiXmlElement* joint) {
          return child_of(*joint) == link_name;
        });
        if (!is_child) root = name;
      }
      if (root.empty() || body_mass(root) > 0) return;
      for (TiXmlElement* joint : joints_) {
        if (!is_fixed(*joint) && body_of(link_of(*joint, "parent")) == root) {
          moving.push_back(joint);
        }
      }
      if (moving.size() != 1) return;
      hold_joint(*moving.front(), 0, "moves the whole robot, which is free to move", log_);
    }
  }

  void add_mass(TiXmlElement& link) {
    const double mass = kLeastMassFraction * total_mass_;
    link.InsertEndChild(make_inertial(mass));
    log_.note(Severity::kRepaired, link, title_of(link), "is moved by a joint, but has no mass",
              to_text(mass) + " kg are assumed: write <inertial>");
  }

  static std::string leader_of(const TiXmlElement& joint) {
    return text_of(*joint.FirstChildElement("mimic"), "joint");
  }
  struct Follower {
    TiXmlElement* joint;
    /** nullptr: it is held at `offset`. */
    const TiXmlElement* leader;
    double ratio;
    double offset;
    std::string problem;
  };

  RepairLog& log_;
  std::map<std::string, TiXmlElement*> links_;
  std::vector<TiXmlElement*> joints_;
  std::map<std::string, TiXmlElement*> by_name_;
  std::vector<Follower> followers_;
  double total_mass_ = 0;
};

}  // namespace

void hold_joint(TiXmlElement& joint, double angle, const std::string& problem, RepairLog& log) {
  log.note(Severity::kRepaired, joint, title_of(joint), problem,
           "it is held at " + to_text(angle) + " (fixed)");
  if (angle != 0) {
    const TiXmlElement* axis = joint.FirstChildElement("axis");
    const auto xyz = axis == nullptr ? std::nullopt : read_numbers(*axis, "xyz", 3);
    const Eigen::Vector3d direction = xyz ? Eigen::Vector3d(xyz->data()) : Eigen::Vector3d::UnitX();
    if (direction.norm() > 0) {
      write_origin(joint, read_origin(joint) * Eigen::AngleAxisd(angle, direction.normalized()));
    }
  }
  joint.SetAttribute("type", "fixed");
  for (const char* part : {"limit", "mimic", "axis"}) {
    if (TiXmlElement* found = joint.FirstChildElement(part)) joint.RemoveChild(found);
  }
}

void repair_mechanism(TiXmlElement& robot, RepairLog& log) {
  MechanismRepair(robot, log).run();
}

}  // namespace nao

#include "robot_import/robot_import.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <sstream>

#include "common/error.h"
#include "common/output_file.h"
#include "kinematics/kinematics.h"
#include "kinematics/leg_kinematics.h"
#include "kinematics/support_polygon.h"
#include "robot_import/description_text.h"
#include "robot_import/gait_text.h"
#include "robot_import/hands.h"
#include "robot_import/leg_numbers.h"
#include "robot_import/plausible_numbers.h"
#include "robot_import/robot_structure.h"
#include "robot_import/touching_bodies.h"
#include "robot_import/urdf_repair.h"
#include "robot_import/yaml_name.h"
#include "robot_model/robot_model.h"

namespace nao {
namespace {

namespace fs = std::filesystem;

// Distance of the center of mass from the edge of the support polygon below which a stance is
// unsafe, fraction of the leg's length.
constexpr double kStanceMargin = 0.03;

/** From the first joint of the left leg to its sole, at the angle 0, m; 0: there are no legs. */
double calc_leg_height(const RobotModel& model, const RobotStructure& structure) {
  const auto poses = model.link_poses(std::vector<double>(model.num_motors(), 0.0));
  const FoundSole& sole = structure.soles[0];
  const std::vector<int> chain = model.find_chain(sole.foot);
  if (chain.empty()) return 0;
  const int hip = model.joints()[chain.front()].child_link;
  return (poses[hip].translation() - poses[sole.foot] * sole.pose_in_foot.translation()).norm();
}

/** Gives findings about joints and links their lines in the file: they were found in a text that
 * repairs had changed. */
void find_lines(const std::map<std::string, int>& lines, size_t first, Findings& findings) {
  for (size_t i = first; i < findings.size(); ++i) {
    const auto line = lines.find(findings[i].element);
    if (findings[i].line > 0) findings[i].line = line == lines.end() ? 0 : line->second;
  }
}

// The steps need one another's results: the model is loaded several times, each time with more of
// its description.
void import_into(const fs::path& urdf, const fs::path& folder, Findings& findings) {
  const std::string name = folder.filename().string() + ".urdf";
  RepairedUrdf repaired = repair_urdf(urdf, folder);
  findings = repaired.findings;
  replace_file(folder / name, repaired.text);
  // First as a robot whose soles are its root: that is enough to see its structure.
  const std::string root = in_yaml(repaired.root);
  const std::string sole = "{link: " + root + ", outline: [[0, 0], [1, 0], [0, 1]]}";
  replace_file(folder / "robot.yaml", "urdf: " + name + "\ninertial_unit: {accelerometer: " + root +
                                          ", gyroscope: " + root + "}\nsoles: {left: " + sole +
                                          ", right: " + sole + "}\n");
  replace_file(folder / "postures.yaml", "postures: []\n");
  RobotModel tree = RobotModel::load(folder);
  RobotStructure structure = find_structure(tree, repaired.mesh_points, findings);

  const size_t num_found = findings.size();
  repaired.text =
      with_hands_of_one_motor(repaired.text, tree, urdf.filename().string(), structure, findings);
  replace_file(folder / name, repaired.text);
  tree = RobotModel::load(folder);
  repaired.text = with_plausible_numbers(repaired.text, tree, calc_leg_height(tree, structure),
                                         urdf.filename().string(), findings);
  const size_t end = repaired.text.rfind("</robot>");
  if (end == std::string::npos) throw ModelError(urdf.string() + ": has no </robot>");
  // Soles become links of the URDF, so that all programs know their frames.
  replace_file(folder / name, repaired.text.insert(end, make_sole_links(tree, structure)));
  const std::string text = make_structure_text(tree, structure, name);
  replace_file(folder / "robot.yaml", text);
  repaired.text = with_plausible_legs(repaired.text, RobotModel::load(folder),
                                      urdf.filename().string(), findings);
  find_lines(repaired.lines, num_found, findings);
  replace_file(folder / name, repaired.text);
  const RobotModel limbs = RobotModel::load(folder);
  replace_file(folder / "postures.yaml", make_postures_text(limbs, findings));
  replace_file(folder / "transitions.yaml", "transitions: []\n");
  const std::string description = text + make_description_text(limbs);
  replace_file(folder / "robot.yaml", description);
  const RobotModel whole = RobotModel::load(folder);
  replace_file(folder / "robot.yaml", description + make_allowed_contacts_text(whole));
  const std::string gait = make_gait_text(limbs);
  if (!gait.empty()) replace_file(folder / "gait.yaml", gait);
  // The result must load; otherwise the import fails as a whole.
  RobotModel::load(folder);
}

// Lists the abilities that the robot's description lacks, each with the file and what to write
// there.
class Check {
 public:
  explicit Check(const fs::path& folder) : folder_(folder), model_(RobotModel::load(folder)) {}

  Findings run() {
    check_standing();
    check_walking();
    check_postures();
    check_kicks();
    return findings_;
  }

 private:
  void add(const std::string& ability, const std::string& file, const std::string& problem,
           const std::string& remedy) {
    findings_.push_back({Finding::Severity::kMissing, file, 0, ability, problem, remedy});
  }

  void check_standing() {
    const Posture* ready = model_.find_posture(model_.references().ready);
    if (ready == nullptr) {
      return add("standing", "postures.yaml", "there is no posture",
                 "write one of the family standing");
    }
    Kinematics kinematics(model_);
    kinematics.update(ready->position);
    const Eigen::Isometry3d ground = kinematics.left_sole().inverse();
    std::vector<Eigen::Vector2d> corners = model_.left_sole_outline();
    for (const Eigen::Vector2d& corner : model_.right_sole_outline()) {
      const Eigen::Vector3d point(corner.x(), corner.y(), 0);
      corners.emplace_back((ground * kinematics.right_sole() * point).head<2>());
    }
    const Eigen::Vector2d com = (ground * kinematics.center_of_mass()).head<2>();
    // Static stability: the distance of the center of mass from the edge of both soles' hull.
    const double margin = margin_in_polygon(convex_hull(corners), com);
    const double height = model_.references().heights.standing;
    if (margin < kStanceMargin * height) {
      std::ostringstream text;
      text.precision(3);
      text << "the center of mass is " << margin << " m inside the soles in posture "
           << ready->name;
      add("standing", "postures.yaml", text.str(), "move it over the soles");
    }
  }

  void check_walking() {
    try {
      const LegKinematics legs(model_);
      if (legs.roles(Leg::kLeft).ankle_pitch < 0) {
        add("walking", "", "no joint pitches the feet: point feet, or feet fixed to the shank",
            "only steps could keep its balance, and the walk begins with a stand");
      }
    } catch (const ModelError& error) {
      add("walking", "", error.what(), "walking needs such legs");
    }
    if (!fs::exists(folder_ / "gait.yaml")) {
      add("walking", "gait.yaml", "there is no gait", "copy one and tune it with nao-walk-tuner");
    } else if (read(folder_ / "gait.yaml").find(kUntunedGait) != std::string::npos) {
      add("walking", "gait.yaml", "the gait is scaled by the legs' length, not tuned",
          "tune it with nao-walk-tuner");
    }
    if (model_.references().walking_arms.empty()) {
      add("walking", "robot.yaml", "the arms do not swing", "write `walking_arms`");
    }
  }

  void check_postures() {
    for (const Posture& posture : model_.postures()) {
      if (posture.family != "standing" && posture.family != "crouching" &&
          !fs::exists(folder_ / "transitions.yaml")) {
        add("postures", "transitions.yaml", "no way leads to posture " + posture.name,
            "write transitions to it and back");
      }
    }
    const std::vector<double>& fall = model_.references().fall.forward;
    if (std::all_of(fall.begin(), fall.end(), [](double angle) { return std::isnan(angle); })) {
      add("falls", "robot.yaml", "there are no fall poses", "write `fall_poses`");
    }
    const std::string transitions =
        fs::exists(folder_ / "transitions.yaml") ? read(folder_ / "transitions.yaml") : "";
    if (transitions.find("from: belly") == std::string::npos) {
      add("getting up", "transitions.yaml", "there is no way up from the belly",
          "write one; nao-transition-tuner improves it");
    }
  }

  void check_kicks() {
    if (!fs::exists(folder_ / "actions" / "kick.yaml")) {
      add("kicks", "actions/kick.yaml", "there is no kick", "write one, see data/robots/nao");
    }
    if (model_.find_action(Action::Kind::kKick, Side::kLeft) == nullptr) {
      add("kicks", "robot.yaml", "no action kicks", "add one with `does: kick` to `actions`");
    }
  }

  static std::string read(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    std::stringstream text;
    text << stream.rdbuf();
    return text.str();
  }

  fs::path folder_;
  RobotModel model_;
  Findings findings_;
};

}  // namespace

Findings import_robot(const fs::path& urdf, const fs::path& folder) {
  if (fs::exists(folder)) {
    throw ModelError(folder.string() + ": exists already; remove it or choose another name");
  }
  fs::create_directories(folder);
  Findings findings;
  // A folder that is half written would look like a robot.
  try {
    import_into(urdf, folder, findings);
  } catch (...) {
    std::error_code ignored;
    fs::remove_all(folder, ignored);
    throw;
  }
  return findings;
}

Findings check_robot(const fs::path& folder) {
  return Check(folder).run();
}

}  // namespace nao

#include "robot_import/urdf_repair.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cctype>
#include <cmath>
#include <fstream>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <sstream>
#include <vector>

#include "rendering/primitives.h"
#include "robot_import/mesh_import.h"
#include "robot_import/urdf_colors.h"
#include "robot_import/urdf_dialect.h"
#include "robot_import/urdf_mechanism.h"
#include "robot_import/urdf_text.h"
#include "robot_import/urdf_units.h"
#include "robot_import/urdf_values.h"
#include "robot_model/child_elements.h"

namespace nao {
namespace {

namespace fs = std::filesystem;

// Assumed where a URDF says nothing: range, rad; velocity, rad/s; torque, N m for each kg of the
// robot. Chosen: a joint of a NAO's leg has 6.4 rad/s and 9 N m at 5.3 kg.
constexpr double kRange = 3.14;
constexpr double kVelocity = 6;
constexpr double kTorquePerMass = 1.5;
// Of a visual without a color: light grey plastic, linear.
const Color kPrimitiveColor(0.62f, 0.62f, 0.64f, 1);
// Mass of each link of a robot without masses, kg.
constexpr double kAssumedMass = 1;

class UrdfRepair {
 public:
  // Edits the XML itself, so that everything it does not understand stays as it is. Each repair is
  // reported with its line, the assumption and what to write instead.
  UrdfRepair(const fs::path& file, const fs::path& folder)
      : file_(file), folder_(folder), log_{file.filename().string(), {}} {}

  RepairedUrdf run();

 private:
  using Severity = Finding::Severity;

  [[noreturn]] void fail(const TiXmlNode* node, const std::string& problem,
                         const std::string& remedy) const {
    log_.fail(node, problem, remedy);
  }
  void note(Severity severity, const TiXmlNode& node, const std::string& element,
            const std::string& problem, const std::string& remedy) {
    log_.note(severity, node, element, problem, remedy);
  }

  void load();
  void open_loops();
  void find_root();
  void measure_mass();
  void repair_joint(TiXmlElement& joint);
  void repair_limit(TiXmlElement& joint, const std::string& element, bool is_continuous);
  void repair_inertial(TiXmlElement& link, const std::string& element);
  void repair_shapes(TiXmlElement& link, const char* kind, const std::string& element);
  /** @return false if the shape must be removed. */
  bool repair_mesh(TiXmlElement& shape, TiXmlElement& geometry, bool is_collision,
                   const std::string& element);
  void repair_cylinder(TiXmlElement& shape, TiXmlElement& geometry, const std::string& element);
  fs::path find_mesh(const std::string& name) const;
  /** Diagonal of the box about a mesh as its file has it; 0: it cannot be read. */
  double measure_mesh(const fs::path& source);
  void find_mesh_units(const TiXmlElement& element);
  void report_mesh_units();
  /** A visual becomes a mesh, whatever it is. @param make  Writes it to a file.
   * @param key  Visuals of the same key share one. */
  void draw(TiXmlElement& shape, TiXmlElement& geometry, const std::string& name,
            const std::string& key, const std::function<void(const fs::path&)>& make);
  void draw_by_collisions(TiXmlElement& link);
  void draw_primitive(TiXmlElement& shape, TiXmlElement& geometry);
  std::optional<Color> color_of(const TiXmlElement& shape) const {
    const auto found = colors_.find(&shape);
    return found == colors_.end() ? std::nullopt : std::optional(found->second);
  }

  fs::path file_;
  fs::path folder_;
  RepairLog log_;
  TiXmlDocument document_;
  TiXmlElement* robot_ = nullptr;
  double mass_ = 0;
  /** Longest chain of joints, m. */
  double chain_ = 0;
  std::map<const TiXmlElement*, Color> colors_;
  /** Converted meshes, by what they were made from. */
  std::map<std::string, std::string> converted_;
  /** Diagonals of the boxes about meshes, as the files have them. */
  std::map<fs::path, double> extents_;
  struct LargestMesh {
    double extent = 0;
    fs::path source{};
    int line = 0;
  };
  /** Of the meshes of each scale, the largest one with that scale. */
  std::map<std::string, LargestMesh> largest_;
  RepairedUrdf result_;
};

void UrdfRepair::load() {
  std::ifstream stream(file_, std::ios::binary);
  if (!stream) fail(nullptr, "the file cannot be read", "check its path");
  std::stringstream text;
  text << stream.rdbuf();
  const std::string xml = to_xml_text(text.str(), log_);
  check_xml_size(xml, log_);
  document_.Parse(xml.c_str(), nullptr, TIXML_ENCODING_UTF8);
  robot_ = document_.FirstChildElement("robot");
  if (document_.Error() || robot_ == nullptr) {
    throw ModelError(
        file_.filename().string() + ":" + std::to_string(document_.ErrorRow()) +
        ": is not a URDF: " + (document_.Error() ? document_.ErrorDesc() : "no <robot> element"));
  }
  // The reader of the result wants a name, and knows one version.
  if (robot_->Attribute("name") == nullptr) robot_->SetAttribute("name", "robot");
  robot_->RemoveAttribute("version");
  for (const TiXmlElement* element : child_elements(*robot_)) {
    if (element->Attribute("name") != nullptr) {
      result_.lines.emplace(title_of(*element), element->Row());
    }
  }
  colors_ = read_colors(*robot_);
  repair_dialect(*robot_, log_);
  repair_units(*robot_, log_);
  chain_ = measure_chain(*robot_);
}

// A link has one joint above it: the first one counts.
void UrdfRepair::open_loops() {
  std::set<std::string> children;
  for (TiXmlElement* joint : child_elements(*robot_, "joint")) {
    const std::string link = link_of(*joint, "child");
    if (!link.empty() && !children.insert(link).second) {
      note(Severity::kRepaired, *joint, title_of(*joint),
           "closes a loop: another joint moves its child " + link + " already",
           "the loop is left open");
      robot_->RemoveChild(joint);
    }
  }
}

/** Joints by the links above them. */
std::multimap<std::string, TiXmlElement*> joints_by_parent(TiXmlElement& robot) {
  std::multimap<std::string, TiXmlElement*> joints;
  for (TiXmlElement* joint : child_elements(robot, "joint")) {
    const std::string link = link_of(*joint, "parent");
    if (!link.empty()) joints.emplace(link, joint);
  }
  return joints;
}

// The tree with the most links is the robot.
void UrdfRepair::find_root() {
  std::map<std::string, TiXmlElement*> links;
  for (TiXmlElement* link : child_elements(*robot_, "link")) {
    if (link->Attribute("name") == nullptr) fail(link, "a link has no name", "give it one");
    links[link->Attribute("name")] = link;
  }
  if (links.empty()) fail(robot_, "has no <link>", "export the robot with its links");
  const auto joints = joints_by_parent(*robot_);
  // The root is the only link that is not a child of a joint.
  std::set<std::string> roots;
  for (const auto& [name, link] : links) roots.insert(name);
  for (const auto& [parent, joint] : joints) {
    const std::string child = link_of(*joint, "child");
    if (!child.empty()) roots.erase(child);
  }
  if (roots.empty()) fail(robot_, "has no root link", "remove the cycle of joints");
  std::vector<std::string> largest;
  std::map<std::string, std::vector<std::string>> trees;
  for (const std::string& root : roots) {
    std::vector<std::string>& tree = trees[root] = {root};
    for (size_t i = 0; i < tree.size() && tree.size() <= links.size(); ++i) {
      const auto [first, last] = joints.equal_range(tree[i]);
      for (auto joint = first; joint != last; ++joint) {
        const std::string child = link_of(*joint->second, "child");
        if (!child.empty()) tree.push_back(child);
      }
    }
    if (tree.size() <= largest.size()) continue;
    largest = tree;
    result_.root = root;
  }
  for (const auto& [root, tree] : trees) {
    if (root == result_.root) continue;
    note(Severity::kRepaired, *links.at(root), "link " + root,
         "is a second root besides " + result_.root,
         "it is left out with all that it carries: connect the two by a joint if it is a part of "
         "the robot");
    for (const std::string& name : tree) {
      const auto [first, last] = joints.equal_range(name);
      for (auto joint = first; joint != last; ++joint) robot_->RemoveChild(joint->second);
      const auto link = links.find(name);
      if (link != links.end()) robot_->RemoveChild(link->second);
    }
  }
}

// The robot's mass, for the assumed torque limits.
void UrdfRepair::measure_mass() {
  for (const TiXmlElement* link : child_elements(*robot_, "link")) {
    mass_ += std::max(0.0, mass_of(*link));
  }
  if (mass_ > 0) return;
  note(
      Severity::kMissing, *robot_, "robot", "no link has a mass",
      to_text(kAssumedMass) + " kg are assumed for each: export the URDF with <inertial> elements");
  // Every body gets one: the root and what joints move. Frames stay without mass.
  std::set<std::string> bodies = {result_.root};
  for (const TiXmlElement* joint : child_elements(*robot_, "joint")) {
    const std::string type = text_of(*joint, "type");
    if (!type.empty() && type != "fixed") bodies.insert(link_of(*joint, "child"));
  }
  for (TiXmlElement* link : child_elements(*robot_, "link")) {
    if (TiXmlElement* empty = link->FirstChildElement("inertial")) link->RemoveChild(empty);
    if (bodies.count(link->Attribute("name")) == 0) continue;
    link->InsertEndChild(make_inertial(kAssumedMass));
    mass_ += kAssumedMass;
  }
}

void UrdfRepair::repair_limit(TiXmlElement& joint, const std::string& element, bool is_continuous) {
  TiXmlElement& limit = find_or_add(joint, "limit");
  const double none = std::numeric_limits<double>::quiet_NaN();
  double lower = read_number(limit, "lower", none);
  double upper = read_number(limit, "upper", none);
  // Some files write a range although the type says that there is none.
  if (is_continuous && lower < upper && lower >= -kRange && upper <= kRange) is_continuous = false;
  if (!is_continuous && lower > upper) {
    std::swap(lower, upper);
    limit.SetAttribute("lower", to_text(lower).c_str());
    limit.SetAttribute("upper", to_text(upper).c_str());
    note(Severity::kRepaired, joint, element, "has its lower limit above the upper one",
         "they are exchanged: " + to_text(lower) + " to " + to_text(upper) + " rad");
  }
  // Written so that missing numbers (NaN) get the assumed range as well.
  if (is_continuous || !(lower < upper)) {
    limit.SetAttribute("lower", to_text(-kRange).c_str());
    limit.SetAttribute("upper", to_text(kRange).c_str());
    note(Severity::kRepaired, joint, element,
         is_continuous ? "is continuous" : "has no range of angles",
         "-3.14 to 3.14 rad are assumed: write the real range into <limit lower= upper=>");
  }
  if (!(read_number(limit, "velocity", 0) > 0)) {
    limit.SetAttribute("velocity", to_text(kVelocity).c_str());
    note(Severity::kRepaired, joint, element, "has no velocity limit",
         to_text(kVelocity) + " rad/s are assumed: write <limit velocity=>");
  }
  if (!(read_number(limit, "effort", 0) > 0)) {
    const double torque = kTorquePerMass * mass_;
    limit.SetAttribute("effort", to_text(torque).c_str());
    note(Severity::kRepaired, joint, element, "has no effort limit",
         to_text(torque) + " N m are assumed: write <limit effort=>");
  }
}

void UrdfRepair::repair_joint(TiXmlElement& joint) {
  if (joint.Attribute("name") == nullptr) fail(&joint, "a joint has no name", "give it one");
  const std::string kind = text_of(joint, "type");
  if (kind == "fixed") {
    for (const char* part : {"limit", "axis"}) {
      if (TiXmlElement* unused = joint.FirstChildElement(part)) joint.RemoveChild(unused);
    }
    return;
  }
  if (kind == "prismatic" || kind == "floating" || kind == "planar") {
    return hold_joint(joint, 0, "is " + kind, log_);
  }
  if (kind != "revolute" && kind != "continuous") {
    return hold_joint(joint, 0, "has the unknown type \"" + kind + "\"", log_);
  }
  const TiXmlElement* axis = joint.FirstChildElement("axis");
  const auto xyz = axis == nullptr ? std::nullopt : read_numbers(*axis, "xyz", 3);
  if (axis != nullptr && !(xyz && Eigen::Vector3d(xyz->data()).norm() > 1e-6)) {
    return hold_joint(joint, 0, "has no axis", log_);
  }
  joint.SetAttribute("type", "revolute");
  repair_limit(joint, title_of(joint), kind == "continuous");
}

void UrdfRepair::repair_inertial(TiXmlElement& link, const std::string& element) {
  TiXmlElement* inertial = link.FirstChildElement("inertial");
  if (inertial == nullptr) return;
  const double kg = mass_of(link);
  if (!(kg > 0)) {
    note(Severity::kRepaired, *inertial, element, "has no mass above 0",
         "it is a frame without mass");
    link.RemoveChild(inertial);
    return;
  }
  TiXmlElement& inertia = find_or_add(*inertial, "inertia");
  for (const char* name : {"ixx", "iyy", "izz", "ixy", "ixz", "iyz"}) {
    if (!read_numbers(inertia, name, 1)) inertia.SetAttribute(name, "0");
  }
  const auto of = [&](const char* name) { return read_number(inertia, name, 0); };
  Eigen::Matrix3d matrix;
  matrix << of("ixx"), of("ixy"), of("ixz"), of("ixy"), of("iyy"), of("iyz"), of("ixz"), of("iyz"),
      of("izz");
  // As in UrdfFile::convert_inertial(): principal moments of a rigid body obey the triangle
  // inequality.
  const Eigen::Vector3d moments =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(matrix, Eigen::EigenvaluesOnly).eigenvalues();
  if (moments(0) > 0 && moments(2) <= (moments(0) + moments(1)) * (1 + 1e-9)) return;
  set_moment(inertia, ball_moment(kg));
  note(Severity::kRepaired, inertia, element,
       "the inertia is not physical (moments above 0, none larger than the sum of the others)",
       "that of a sphere of its mass is assumed, " + to_text(ball_moment(kg)) +
           " kg m^2: export it anew");
}

std::string to_lower(std::string text) {
  for (char& letter : text) letter = static_cast<char>(std::tolower(letter & 0xff));
  return text;
}

// A file below a folder; names that differ in the case of letters only are the same, as on the
// systems where many URDFs are made.
fs::path find_file(const fs::path& folder, const fs::path& ending) {
  std::error_code error;
  if (fs::is_regular_file(folder / ending, error)) return folder / ending;
  fs::path found = folder;
  for (const fs::path& part : ending) {
    fs::path next = found / part;
    for (fs::directory_iterator entry(found, error), end; !fs::exists(next, error) && entry != end;
         entry.increment(error)) {
      if (to_lower(entry->path().filename().string()) == to_lower(part.string())) {
        next = entry->path();
      }
    }
    found = next;
  }
  return fs::is_regular_file(found, error) ? found : fs::path();
}

/** Bytes of a text with %20 and the like; as it is where none follow. */
std::string without_percent(const std::string& text) {
  std::string plain;
  for (size_t i = 0; i < text.size(); ++i) {
    const bool is_escape = text[i] == '%' && i + 2 < text.size() &&
                           std::isxdigit(text[i + 1] & 0xff) && std::isxdigit(text[i + 2] & 0xff) &&
                           text.substr(i + 1, 2) != "00";
    plain += is_escape ? static_cast<char>(std::stoi(text.substr(i + 1, 2), nullptr, 16)) : text[i];
    i += is_escape ? 2 : 0;
  }
  return plain;
}

fs::path UrdfRepair::find_mesh(const std::string& name) const {
  std::string path = name;
  std::replace(path.begin(), path.end(), '\\', '/');
  // The scheme says how a path is found; the rest is searched beside the file.
  const size_t scheme = path.find("://");
  if (scheme != std::string::npos) path = path.substr(scheme + 3);
  const fs::path start = fs::absolute(file_).parent_path();
  for (const std::string& written : {path, without_percent(path)}) {
    // Without its first folders, one after the other: a package is the URDF's folder, or one above
    // it, or lies in one of them; a path may be that of another computer.
    for (size_t first = 0; first < written.size(); first = written.find('/', first)) {
      if (first > 0) ++first;
      fs::path base = start;
      for (int level = 0; level < 4; ++level) {
        fs::path found = find_file(base, written.substr(first));
        if (!found.empty()) return found;
        if (base == base.parent_path()) break;
        base = base.parent_path();
      }
      if (first == 0 && written[0] == '/') ++first;
    }
  }
  return {};
}

void UrdfRepair::draw(TiXmlElement& shape, TiXmlElement& geometry, const std::string& name,
                      const std::string& key, const std::function<void(const fs::path&)>& make) {
  const auto color = color_of(shape);
  std::string whole_key = key;
  if (color) whole_key += " " + to_text(color->head<3>().cast<double>());
  std::string& target = converted_[whole_key];
  if (target.empty()) {
    const std::string file =
        "meshes/" + std::to_string(converted_.size() - 1) + "_" + name + ".glb";
    fs::create_directories(folder_ / "meshes");
    try {
      make(folder_ / file);
    } catch (...) {
      converted_.erase(whole_key);
      throw;
    }
    target = file;
  }
  geometry.Clear();
  TiXmlElement mesh("mesh");
  mesh.SetAttribute("filename", target.c_str());
  geometry.InsertEndChild(mesh);
}

// The phone's app draws meshes only.
void UrdfRepair::draw_primitive(TiXmlElement& shape, TiXmlElement& geometry) {
  const TiXmlElement& form = *geometry.FirstChildElement();
  const std::string kind = form.Value();
  const auto radius = static_cast<float>(read_number(form, "radius", 0));
  const auto length = static_cast<float>(read_number(form, "length", 0));
  const std::string name = text_of(shape, "name");
  const Color color = color_of(shape).value_or(kPrimitiveColor);
  Mesh mesh;
  if (kind == "box") {
    const auto size = read_numbers(form, "size", 3);
    mesh = make_box(Eigen::Vector3d(size->data()).cast<float>(), color);
  } else if (kind == "sphere") {
    mesh = make_sphere(radius, color);
  } else if (name.ends_with("_capsule")) {
    mesh = make_capsule(radius, length, color);
  } else {
    mesh = make_cylinder(radius, length, color);
  }
  TiXmlPrinter key;
  form.Accept(&key);
  draw(shape, geometry, kind, key.Str() + name,
       [&](const fs::path& file) { write_mesh(mesh, color, file); });
}

double UrdfRepair::measure_mesh(const fs::path& source) {
  const auto [extent, is_new] = extents_.try_emplace(source, 0);
  if (!is_new) return extent->second;
  Eigen::AlignedBox3d box;
  try {
    for (const Eigen::Vector3d& corner : read_mesh_points(source, Eigen::Vector3d::Ones())) {
      box.extend(corner);
    }
  } catch (const ModelError&) {
    return 0;  // reported where the mesh is used
  }
  return extent->second = box.isEmpty() ? 0 : box.sizes().norm();
}

Eigen::Vector3d read_scale(const TiXmlElement& mesh) {
  const auto factors = read_numbers(mesh, "scale", 3);
  return factors ? Eigen::Vector3d(factors->data()) : Eigen::Vector3d::Ones();
}

// Meshes of one scale have one unit, which the largest one shows: small parts could be in either.
void UrdfRepair::find_mesh_units(const TiXmlElement& element) {
  for (const TiXmlElement* child : child_elements(element)) {
    find_mesh_units(*child);
    const char* name = child->Attribute("filename");
    if (child->ValueStr() != "mesh" || name == nullptr) continue;
    const fs::path source = find_mesh(name);
    if (source.empty()) continue;
    const Eigen::Vector3d scale = read_scale(*child);
    LargestMesh& largest = largest_[to_text(scale)];
    const double extent = measure_mesh(source) * scale.cwiseAbs().maxCoeff();
    if (extent <= largest.extent) continue;
    largest = {extent, source, child->Row()};
  }
}

void UrdfRepair::report_mesh_units() {
  for (const auto& [scale, largest] : largest_) {
    const double unit = mesh_unit(largest.extent, chain_);
    if (unit == 1) continue;
    log_.findings.push_back({Severity::kRepaired, log_.file, largest.line,
                             "mesh \"" + largest.source.filename().string() + "\"",
                             "is " + to_text(largest.extent) + " m large",
                             "it, and all of the scale " + scale + ", is taken for one in " +
                                 (unit < 1 ? "millimetres" : "metres") + ": write its scale"});
  }
}

bool UrdfRepair::repair_mesh(TiXmlElement& shape, TiXmlElement& geometry, bool is_collision,
                             const std::string& element) {
  TiXmlElement& mesh = *geometry.FirstChildElement("mesh");
  const std::string name = text_of(mesh, "filename");
  const std::string link_name = shape.Parent()->ToElement()->Attribute("name");
  const fs::path source = find_mesh(name);
  if (source.empty()) {
    // A missing visual only looks bad; a missing collision shape changes the physics.
    note(is_collision ? Severity::kMissing : Severity::kRepaired, mesh, element,
         "mesh \"" + name + "\" is neither beside the URDF nor in the folders above it",
         is_collision ? "the link collides with nothing: put the file there and import again"
                      : "it is left out: put the file there and import again");
    return false;
  }
  const auto add_points = [&](int number, const std::vector<Eigen::Vector3d>& corners) {
    std::vector<Eigen::Vector3d>& points = result_.mesh_points[{link_name, number}];
    const Eigen::Isometry3d pose = read_origin(shape);
    for (const Eigen::Vector3d& corner : corners) points.push_back(pose * corner);
  };
  try {
    Eigen::Vector3d scale = read_scale(mesh);
    scale *= mesh_unit(largest_[to_text(scale)].extent, chain_);
    if (!is_collision) {
      if (shape.Parent()->FirstChildElement("collision") == nullptr) {
        add_points(-1, read_mesh_points(source, scale));
      }
      draw(shape, geometry, source.stem().string(), source.string() + " " + to_text(scale),
           [&](const fs::path& file) { convert_mesh(source, scale, color_of(shape), file); });
      return true;
    }
    const std::vector<Eigen::Vector3d> corners = read_mesh_points(source, scale);
    const FittedShape fitted = fit_shape(corners);
    int number = 0;
    for (const TiXmlNode* before = &shape; (before = before->PreviousSibling("collision"));) {
      ++number;
    }
    add_points(number, corners);
    geometry.RemoveChild(&mesh);
    TiXmlElement primitive(fitted.is_capsule ? "cylinder" : "box");
    if (fitted.is_capsule) {
      primitive.SetAttribute("radius", to_text(fitted.radius).c_str());
      primitive.SetAttribute("length", to_text(fitted.length).c_str());
    } else {
      primitive.SetAttribute("size", to_text(fitted.size).c_str());
    }
    geometry.InsertEndChild(primitive);
    // The fitted shape is in the mesh's frame, which the origin places in the link.
    write_origin(shape, read_origin(shape) * fitted.pose);
    shape.SetAttribute("name",
                       (source.stem().string() + (fitted.is_capsule ? "_capsule" : "")).c_str());
    note(Severity::kNote, shape, element, "collides by a mesh",
         std::string("a ") + (fitted.is_capsule ? "capsule" : "box") + " about it takes its place");
    return true;
  } catch (const ModelError& error) {
    note(is_collision ? Severity::kMissing : Severity::kRepaired, shape, element, error.what(),
         "the shape is left out");
    return false;
  }
}

void UrdfRepair::repair_cylinder(TiXmlElement& shape, TiXmlElement& geometry,
                                 const std::string& element) {
  TiXmlElement& cylinder = *geometry.FirstChildElement("cylinder");
  const std::string name = text_of(shape, "name");
  const double radius = read_number(cylinder, "radius", 0);
  const double length = read_number(cylinder, "length", 0);
  if (name.ends_with("_capsule") || !(radius > 0) || !(length > 0)) return;
  // The physics has no cylinders. A long one becomes the capsule of its length, a short one a box
  // with a square of the same area.
  const bool is_long = length > 2 * radius;
  if (is_long) {
    cylinder.SetAttribute("length", to_text(length - 2 * radius).c_str());
    shape.SetAttribute("name", (name + "_capsule").c_str());
  } else {
    const double edge = std::sqrt(M_PI) * radius;
    TiXmlElement box("box");
    box.SetAttribute("size", to_text(Eigen::Vector3d(edge, edge, length)).c_str());
    geometry.RemoveChild(&cylinder);
    geometry.InsertEndChild(box);
  }
  note(Severity::kNote, shape, element, "collides by a cylinder",
       std::string("a ") + (is_long ? "capsule" : "box") + " of its size takes its place");
}

void UrdfRepair::repair_shapes(TiXmlElement& link, const char* kind, const std::string& element) {
  const bool is_collision = std::string(kind) == "collision";
  for (TiXmlElement* shape : child_elements(link, kind)) {
    TiXmlElement* geometry = shape->FirstChildElement("geometry");
    bool stays = geometry != nullptr && geometry->FirstChildElement() != nullptr;
    if (!stays) {
      note(Severity::kRepaired, *shape, element, std::string("a ") + kind + " has no geometry",
           "it is left out");
    } else if (geometry->FirstChildElement("mesh") != nullptr) {
      stays = repair_mesh(*shape, *geometry, is_collision, element);
    } else if (is_collision && geometry->FirstChildElement("cylinder") != nullptr) {
      repair_cylinder(*shape, *geometry, element);
    } else if (!is_collision) {
      draw_primitive(*shape, *geometry);
    }
    if (!stays) link.RemoveChild(shape);
  }
}

/** Whether a file has a visual or a mesh at all; scripts draw the shells of a robot without. */
bool has_drawing(const TiXmlElement& element) {
  for (const TiXmlElement* child : child_elements(element)) {
    if (child->ValueStr() == "visual" || child->ValueStr() == "mesh" || has_drawing(*child)) {
      return true;
    }
  }
  return false;
}

// A body between others that are seen must be seen, too.
void UrdfRepair::draw_by_collisions(TiXmlElement& link) {
  if (link.FirstChildElement("visual") != nullptr ||
      link.FirstChildElement("inertial") == nullptr) {
    return;
  }
  for (const TiXmlElement* shape : child_elements(link, "collision")) {
    const TiXmlElement* geometry = shape->FirstChildElement("geometry");
    if (geometry == nullptr || geometry->FirstChildElement() == nullptr) continue;
    const TiXmlElement* mesh = geometry->FirstChildElement("mesh");
    const char* name = mesh == nullptr ? nullptr : mesh->Attribute("filename");
    // The collision itself reports what is wrong with its mesh.
    if (mesh != nullptr && (name == nullptr || find_mesh(name).empty())) continue;
    TiXmlElement visual("visual");
    if (shape->Attribute("name") != nullptr) visual.SetAttribute("name", shape->Attribute("name"));
    for (const char* part : {"origin", "geometry"}) {
      if (const TiXmlElement* found = shape->FirstChildElement(part)) visual.InsertEndChild(*found);
    }
    link.InsertEndChild(visual);
  }
  // What is found here is found again in the collisions.
  const size_t num_findings = log_.findings.size();
  repair_shapes(link, "visual", title_of(link));
  log_.findings.resize(num_findings);
}

RepairedUrdf UrdfRepair::run() {
  load();
  open_loops();
  find_root();
  measure_mass();
  for (TiXmlElement* joint : child_elements(*robot_, "joint")) {
    repair_joint(*joint);
  }
  for (TiXmlElement* link : child_elements(*robot_, "link")) {
    repair_inertial(*link, title_of(*link));
  }
  repair_mechanism(*robot_, log_);
  find_mesh_units(*robot_);
  report_mesh_units();
  const bool is_drawn = has_drawing(*robot_);
  for (TiXmlElement* link : child_elements(*robot_, "link")) {
    const std::string element = title_of(*link);
    repair_shapes(*link, "visual", element);
    if (is_drawn) draw_by_collisions(*link);
    repair_shapes(*link, "collision", element);
  }
  std::set<fs::path> meshes;
  for (const auto& [key, target] : converted_) meshes.insert(folder_ / target);
  limit_meshes(meshes);
  bool has_motor = false;
  for (const TiXmlElement* joint : child_elements(*robot_, "joint")) {
    has_motor = has_motor || std::string(joint->Attribute("type")) != "fixed";
  }
  if (!has_motor) fail(robot_, "no joint can move", "import a robot with revolute joints");
  result_.text = to_text(document_);
  result_.findings = std::move(log_.findings);
  return result_;
}

}  // namespace

RepairedUrdf repair_urdf(const fs::path& file, const fs::path& folder) {
  return UrdfRepair(file, folder).run();
}

}  // namespace nao

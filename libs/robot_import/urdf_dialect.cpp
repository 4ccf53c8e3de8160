#include "robot_import/urdf_dialect.h"

#include <algorithm>
#include <map>
#include <set>
#include <vector>

#include "robot_import/urdf_values.h"
#include "robot_model/child_elements.h"

namespace nao {
namespace {

using Severity = Finding::Severity;

constexpr size_t kMaxBytes = 16 << 20;
constexpr int kMaxDepth = 64;
// More links than any robot has; the time of an import grows with the square of their number.
constexpr int kMaxLinks = 500;

/** Elements that are read, by the element that they stand in. */
const std::map<std::string, std::set<std::string>>& known_elements() {
  static const std::map<std::string, std::set<std::string>> known = {
      {"robot", {"link", "joint"}},
      {"link", {"inertial", "visual", "collision"}},
      {"inertial", {"origin", "mass", "inertia"}},
      {"visual", {"origin", "geometry"}},
      {"collision", {"origin", "geometry"}},
      {"geometry", {"box", "sphere", "cylinder", "capsule", "mesh"}},
      {"joint", {"parent", "child", "origin", "axis", "limit", "mimic"}}};
  return known;
}

/** Attributes that are numbers, and how many, by their elements. */
const std::map<std::string, std::vector<std::pair<const char*, size_t>>>& number_attributes() {
  static const std::map<std::string, std::vector<std::pair<const char*, size_t>>> numbers = {
      {"origin", {{"xyz", 3}, {"rpy", 3}}},
      {"axis", {{"xyz", 3}}},
      {"limit", {{"lower", 1}, {"upper", 1}, {"effort", 1}, {"velocity", 1}}},
      {"mass", {{"value", 1}}},
      {"inertia", {{"ixx", 1}, {"iyy", 1}, {"izz", 1}, {"ixy", 1}, {"ixz", 1}, {"iyz", 1}}},
      {"mimic", {{"multiplier", 1}, {"offset", 1}}},
      {"box", {{"size", 3}}},
      {"sphere", {{"radius", 1}}},
      {"cylinder", {{"radius", 1}, {"length", 1}}},
      {"capsule", {{"radius", 1}, {"length", 1}}},
      {"mesh", {{"scale", 3}}}};
  return numbers;
}

/** Elements that are common in URDFs, and say nothing that is used here. */
bool is_common(const std::string& name) {
  static const std::set<std::string> common = {
      "material", "transmission",      "gazebo",           "ros2_control", "sensor", "dynamics",
      "mujoco",   "safety_controller", "joint_properties", "calibration"};
  return common.count(name) > 0;
}

bool is_xacro(const std::string& name) {
  return name.rfind("xacro:", 0) == 0;
}

class DialectRepair {
 public:
  explicit DialectRepair(RepairLog& log) : log_(log) {}

  void run(TiXmlElement& robot) {
    check_xacro(robot, false);
    clean(robot, "");
    remove_duplicates(robot);
    for (const auto& [place, found] : foreign_) {
      const std::string times =
          found.count > 1 ? " (" + std::to_string(found.count) + " times)" : "";
      log_.findings.push_back({Severity::kRepaired, log_.file, found.line, place.first,
                               "<" + place.second + "> is not part of a URDF" + times,
                               "it is left out"});
    }
  }

 private:
  struct Foreign {
    int line = 0;
    int count = 0;
  };

  // xacro's output is a URDF; its input cannot be understood without it.
  void check_xacro(const TiXmlElement& element, bool is_in_tree) const {
    static const std::set<std::string> definitions = {"xacro:macro", "xacro:include", "xacro:if",
                                                      "xacro:unless", "xacro:insert_block"};
    const std::string name = element.Value();
    bool is_input = definitions.count(name) > 0;
    is_in_tree = is_in_tree || name == "link" || name == "joint";
    for (const TiXmlAttribute* attribute = element.FirstAttribute(); attribute != nullptr;
         attribute = attribute->Next()) {
      is_input |= is_in_tree && std::string(attribute->Value()).find("${") != std::string::npos;
    }
    if (is_input) {
      log_.fail(&element, "is the input of xacro",
                "run `xacro FILE.xacro > FILE.urdf` and import that");
    }
    for (const TiXmlElement* child : child_elements(element)) {
      check_xacro(*child, is_in_tree);
    }
  }

  /** Removes what is not read. @param owner  "link foot". */
  void clean(TiXmlElement& element, const std::string& owner) {
    const std::string kind = element.Value();
    const auto known = known_elements().find(kind);
    for (TiXmlElement* child : child_elements(element)) {
      const std::string name = child->Value();
      if (known != known_elements().end() && known->second.count(name) == 0) {
        if (is_xacro(name)) {
          log_.note(Severity::kMissing, *child, owner, "<" + name + "> is not expanded",
                    "it is left out: run xacro if it stands for a part of the robot");
        } else if (!is_common(name)) {
          Foreign& foreign = foreign_[{kind == "robot" ? "" : kind, name}];
          if (foreign.count++ == 0) foreign.line = child->Row();
        }
        element.RemoveChild(child);
      } else {
        const bool is_owner = kind == "robot";
        if (is_owner && ++num_owners_ > 2 * kMaxLinks) {
          log_.fail(child, "has more than " + std::to_string(kMaxLinks) + " links",
                    "leave out those that do not matter");
        }
        clean(*child, is_owner ? title_of(*child) : owner);
      }
    }
    repair_numbers(element, owner);
    for (const char* name : {"name", "link", "joint"}) repair_name(element, name);
    if (kind == "visual" || kind == "collision") repair_geometry(element, owner);
  }

  void repair_numbers(TiXmlElement& element, const std::string& owner) {
    const std::string kind = element.Value();
    const auto attributes = number_attributes().find(kind);
    if (attributes == number_attributes().end()) return;
    for (const auto& [name, count] : attributes->second) {
      if (element.Attribute(name) == nullptr || read_numbers(element, name, count)) continue;
      const std::string repaired = repaired_numbers(element, name, count);
      const std::string problem =
          std::string(name) + "=\"" + element.Attribute(name) + "\" is not ";
      if (!repaired.empty()) {
        if (num_spellings_++ == 0) {
          log_.note(Severity::kRepaired, element, owner,
                    problem + "numbers with points and spaces between them",
                    "this, and all like it, is read as \"" + repaired + "\"");
        }
        element.SetAttribute(name, repaired.c_str());
      } else if (kind == "origin" || kind == "mimic" || kind == "mesh") {
        log_.note(Severity::kRepaired, element, owner, problem + "a number of " + kind,
                  "it is left out, as if the file did not state it");
        element.RemoveAttribute(name);
      }
    }
  }

  // Names are written into files of lines.
  void repair_name(TiXmlElement& element, const char* attribute) {
    const char* value = element.Attribute(attribute);
    if (value == nullptr) return;
    std::string name = value;
    std::replace_if(
        name.begin(), name.end(), [](char letter) { return (letter & 0xff) < ' '; }, ' ');
    const size_t first = name.find_first_not_of(' ');
    name = first == std::string::npos ? ""
                                      : name.substr(first, name.find_last_not_of(' ') + 1 - first);
    if (name != value) element.SetAttribute(attribute, name.c_str());
  }

  void remove_duplicates(TiXmlElement& robot) {
    std::map<std::string, TiXmlElement*> links;
    std::set<std::string> joints;
    for (TiXmlElement* element : child_elements(robot)) {
      const std::string kind = element->Value();
      const std::string name = text_of(*element, "name");
      if (kind == "joint" && !name.empty() && !joints.insert(name).second) {
        std::string other = name;
        while (!joints.insert(other).second) other += "_2";
        log_.note(Severity::kRepaired, *element, title_of(*element), "is a second one of this name",
                  "it is called " + other);
        element->SetAttribute("name", other.c_str());
      } else if (kind == "link" && !name.empty() && !links.emplace(name, element).second) {
        // The one with more in it stays.
        if (links[name]->FirstChildElement() == nullptr) std::swap(links[name], element);
        log_.note(Severity::kRepaired, *element, title_of(*element), "is a second one of this name",
                  "it is left out");
        robot.RemoveChild(element);
      }
    }
    // Joints of links that are not there.
    for (TiXmlElement* joint : child_elements(robot, "joint")) {
      for (const char* end : {"parent", "child"}) {
        const TiXmlElement* element = joint->FirstChildElement(end);
        const char* link = element == nullptr ? nullptr : element->Attribute("link");
        if (link == nullptr || links.count(link) > 0) continue;
        log_.note(Severity::kMissing, *joint, title_of(*joint),
                  std::string("its ") + end + " \"" + link + "\" is not a link",
                  "the joint is left out, and what it would carry: write the link");
        robot.RemoveChild(joint);
        break;
      }
    }
  }

  // Leaves one known geometry with a size above 0, or none.
  void repair_geometry(TiXmlElement& shape, const std::string& owner) {
    TiXmlElement* geometry = shape.FirstChildElement("geometry");
    TiXmlElement* form = geometry == nullptr ? nullptr : geometry->FirstChildElement();
    if (form == nullptr) return;
    const std::string kind = form->Value();
    bool has_size = true;
    if (kind == "box") {
      const auto size = read_numbers(*form, "size", 3);
      has_size = size && *std::min_element(size->begin(), size->end()) > 0;
    } else if (kind != "mesh") {
      has_size = read_number(*form, "radius", 0) > 0 &&
                 (kind != "cylinder" || read_number(*form, "length", 0) > 0);
    }
    if (!has_size) {
      log_.note(Severity::kRepaired, *form, owner, "a " + kind + " has no size above 0",
                "it is left out");
      geometry->RemoveChild(form);
      return;
    }
    if (kind != "capsule") return;
    // The length of a capsule is that between the centers of its ends.
    const double length = read_number(*form, "length", 0);
    TiXmlElement round(length > 0 ? "cylinder" : "sphere");
    round.SetAttribute("radius", form->Attribute("radius"));
    if (length > 0) {
      round.SetAttribute("length", form->Attribute("length"));
      shape.SetAttribute("name", (text_of(shape, "name") + "_capsule").c_str());
    }
    geometry->RemoveChild(form);
    geometry->InsertEndChild(round);
  }

  RepairLog& log_;
  int num_owners_ = 0;
  int num_spellings_ = 0;
  std::map<std::pair<std::string, std::string>, Foreign> foreign_;
};

}  // namespace

void check_xml_size(const std::string& text, const RepairLog& log) {
  if (text.size() > kMaxBytes) {
    log.fail(nullptr, "is larger than " + std::to_string(kMaxBytes >> 20) + " MiB",
             "move meshes into files of their own");
  }
  const auto starts = [&](size_t at, const char* with) {
    return text.compare(at, std::char_traits<char>::length(with), with) == 0;
  };
  int depth = 0;
  for (size_t at = text.find('<'); at != std::string::npos; at = text.find('<', at)) {
    if (starts(at, "<!--")) {
      const size_t end = text.find("-->", at);
      at = end == std::string::npos ? text.size() : end;
      continue;
    }
    // The end of the tag, outside of quoted values.
    const bool is_end = starts(at, "</");
    const bool is_other = starts(at, "<?") || starts(at, "<!");
    char quote = 0;
    size_t end = at;
    for (; end < text.size() && (quote != 0 || text[end] != '>'); ++end) {
      if (quote != 0) {
        if (text[end] == quote) quote = 0;
      } else if (text[end] == '"' || text[end] == '\'') {
        quote = text[end];
      }
    }
    const bool is_empty = end > at && text[end - 1] == '/';
    depth += is_other || (is_empty && !is_end) ? 0 : is_end ? -1 : 1;
    if (depth > kMaxDepth) {
      log.fail(nullptr, "has elements nested more than " + std::to_string(kMaxDepth) + " deep",
               "it is not a URDF");
    }
    at = end;
  }
}

void repair_dialect(TiXmlElement& robot, RepairLog& log) {
  DialectRepair(log).run(robot);
}

}  // namespace nao

#include <console_bridge/console.h>
#include <tinyxml.h>
#include <urdf_parser/urdf_parser.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <vector>

#include "common/error.h"
#include "robot_model/child_elements.h"
#include "robot_model/joint_order.h"
#include "robot_model/robot_model_reader.h"

namespace nao {
namespace {

/** Collects the messages that urdfdom would print, for the text of an error. */
class UrdfdomMessages : public console_bridge::OutputHandler {
 public:
  UrdfdomMessages() : previous_(console_bridge::getOutputHandler()) {
    console_bridge::useOutputHandler(this);
  }
  UrdfdomMessages(const UrdfdomMessages&) = delete;
  UrdfdomMessages& operator=(const UrdfdomMessages&) = delete;
  ~UrdfdomMessages() override { console_bridge::useOutputHandler(previous_); }

  void log(const std::string& text, console_bridge::LogLevel level, const char* /*filename*/,
           int /*line*/) override {
    if (level >= console_bridge::CONSOLE_BRIDGE_LOG_ERROR) {
      errors_ += (errors_.empty() ? "" : "; ") + text;
    }
  }
  const std::string& errors() const { return errors_; }

 private:
  console_bridge::OutputHandler* previous_;
  std::string errors_;
};

/** The kinematic tree of a URDF, checked: urdfdom itself accepts two parents of a link, and leaks
 * the memory of a cycle. */
struct UrdfTree {
  std::string root;
  /** In the file's order; only the names are set. */
  std::vector<UrdfEdge> edges;
};

/** One URDF file: converts urdfdom's structures, and reports errors with the element's name. */
class UrdfFile {
 public:
  explicit UrdfFile(const std::filesystem::path& file) : file_(file), folder_(file.parent_path()) {}

  UrdfTree tree() const;
  /** Sets what order_joints() needs. */
  void describe(const urdf::ModelInterface& urdf, UrdfEdge& edge) const;
  /** @return urdfdom's model. @throws ModelError  if urdfdom reported any error. */
  urdf::ModelInterfaceSharedPtr parse() const;
  Link convert(const urdf::Link& link) const;
  /** Converts everything except the indices of links and joints. */
  Joint convert(const urdf::Joint& joint) const;

  [[noreturn]] void fail(const std::string& element, const std::string& what) const {
    throw ModelError(file_.string() + ": " + element + ": " + what);
  }

 private:
  std::string text() const;
  std::string attribute(const TiXmlElement* xml, const char* name,
                        const std::string& element) const;
  void require(bool is_right, const std::string& element, const std::string& what) const {
    if (!is_right) {
      fail(element, what);
    }
  }
  double finite(double value, const std::string& element, const std::string& what) const {
    require(std::isfinite(value), element, what + " is not finite");
    return value;
  }
  Eigen::Vector3d convert(const urdf::Vector3& vector, const std::string& element) const;
  Eigen::Isometry3d convert(const urdf::Pose& pose, const std::string& element) const;
  Shape convert(const urdf::Geometry* geometry, const urdf::Pose& origin, const std::string& name,
                const std::string& element) const;
  void convert_inertial(const urdf::Inertial& inertial, const std::string& element,
                        Link& link) const;
  std::filesystem::path mesh_path(const std::string& name, const std::string& element) const;

  std::filesystem::path file_;
  std::filesystem::path folder_;
};

// Read twice, by TinyXML for the checks and by urdfdom for the model: the same bytes.
std::string UrdfFile::text() const {
  if (!std::filesystem::is_regular_file(file_)) {
    throw ModelError(file_.string() + ": the file is missing");
  }
  std::ifstream stream(file_, std::ios::binary);
  std::stringstream text;
  text << stream.rdbuf();
  return text.str();
}

// urdfdom reports most errors as messages and continues; any message is an error here.
urdf::ModelInterfaceSharedPtr UrdfFile::parse() const {
  const UrdfdomMessages messages;
  urdf::ModelInterfaceSharedPtr model;
  try {
    model = urdf::parseURDF(text());
  } catch (const std::exception& error) {
    fail("robot", error.what());
  }
  require(model != nullptr && messages.errors().empty(), "robot",
          messages.errors().empty() ? "is not a URDF" : messages.errors());
  return model;
}

std::string UrdfFile::attribute(const TiXmlElement* xml, const char* name,
                                const std::string& element) const {
  const char* value = xml == nullptr ? nullptr : xml->Attribute(name);
  require(value != nullptr, element, std::string("a \"") + name + "\" is missing");
  return value;
}

void UrdfFile::describe(const urdf::ModelInterface& urdf, UrdfEdge& edge) const {
  const urdf::JointConstSharedPtr joint = urdf.getJoint(edge.joint);
  const urdf::LinkConstSharedPtr child = urdf.getLink(edge.child);
  if (joint == nullptr || child == nullptr) fail("joint " + edge.joint, "is missing");
  // A link without mass and collision behind a fixed joint is a frame only.
  edge.is_body = joint->type != urdf::Joint::FIXED || child->inertial != nullptr ||
                 !child->collision_array.empty();
  const urdf::Pose& pose = joint->parent_to_joint_origin_transform;
  // Sort key for branches of one link that is independent of names: origin, rotation and axis.
  edge.place = {pose.position.x, pose.position.y, pose.position.z, pose.rotation.x, pose.rotation.y,
                pose.rotation.z, pose.rotation.w, joint->axis.x,   joint->axis.y,   joint->axis.z};
}

UrdfTree UrdfFile::tree() const {
  TiXmlDocument document;
  document.Parse(text().c_str());
  const TiXmlElement* robot = document.FirstChildElement("robot");
  require(robot != nullptr, "robot", "no <robot> element");

  // Names first, so that joints can be checked against them.
  std::set<std::string> links;
  for (const TiXmlElement* link : child_elements(*robot, "link")) {
    const std::string name = attribute(link, "name", "link");
    require(links.insert(name).second, "link " + name, "appears twice");
  }

  UrdfTree tree;
  std::set<std::string> joints;
  std::map<std::string, std::string> joint_of_child;
  for (const TiXmlElement* joint : child_elements(*robot, "joint")) {
    const std::string name = attribute(joint, "name", "joint");
    const std::string element = "joint " + name;
    require(joints.insert(name).second, element, "appears twice");
    const std::string parent = attribute(joint->FirstChildElement("parent"), "link", element);
    const std::string child = attribute(joint->FirstChildElement("child"), "link", element);
    require(links.count(parent) > 0, element, "its parent \"" + parent + "\" is not a link");
    require(links.count(child) > 0, element, "its child \"" + child + "\" is not a link");
    // A tree: each link has at most one parent.
    const auto [known, is_new] = joint_of_child.try_emplace(child, name);
    require(is_new, element, "its child \"" + child + "\" is also the child of " + known->second);
    UrdfEdge edge;
    edge.joint = name;
    edge.parent = parent;
    edge.child = child;
    tree.edges.push_back(edge);
  }

  // Exactly one link has no parent.
  for (const std::string& link : links) {
    if (joint_of_child.count(link) == 0) {
      require(tree.root.empty(), "link " + link,
              "is a second root besides " + tree.root + ": no joint connects the two");
      tree.root = link;
    }
  }
  require(!tree.root.empty(), "robot", "has no root link");
  // Every link has one parent: links that cannot be reached from the root are on a cycle.
  std::map<std::string, std::vector<std::string>> children;
  for (const UrdfEdge& edge : tree.edges) children[edge.parent].push_back(edge.child);
  std::vector<std::string> reached = {tree.root};
  for (size_t i = 0; i < reached.size(); ++i) {
    for (const std::string& child : children[reached[i]]) reached.push_back(child);
  }
  for (const UrdfEdge& edge : tree.edges) {
    require(std::find(reached.begin(), reached.end(), edge.child) != reached.end(),
            "joint " + edge.joint,
            "is on a cycle or beyond one: no chain of joints leads from the root " + tree.root +
                " to its parent \"" + edge.parent + "\"");
  }
  return tree;
}

Eigen::Vector3d UrdfFile::convert(const urdf::Vector3& vector, const std::string& element) const {
  Eigen::Vector3d converted(vector.x, vector.y, vector.z);
  require(converted.allFinite(), element, "a vector is not finite");
  return converted;
}

Eigen::Isometry3d UrdfFile::convert(const urdf::Pose& pose, const std::string& element) const {
  Eigen::Isometry3d converted = Eigen::Isometry3d::Identity();
  converted.translation() = convert(pose.position, element);
  Eigen::Quaterniond rotation(pose.rotation.w, pose.rotation.x, pose.rotation.y, pose.rotation.z);
  // urdfdom normalizes rpy itself; a norm near 0 or NaN comes from numbers that are not finite.
  require(rotation.coeffs().allFinite() && rotation.norm() > 0.5, element, "rpy is not a rotation");
  converted.linear() = rotation.normalized().toRotationMatrix();
  return converted;
}

std::filesystem::path UrdfFile::mesh_path(const std::string& name,
                                          const std::string& element) const {
  // Meshes outside the folder would be missing on another computer.
  const std::filesystem::path relative = std::filesystem::path(name).lexically_normal();
  require(!name.empty() && relative.is_relative() && *relative.begin() != "..", element,
          "mesh \"" + name + "\" is not inside the robot's folder");
  // Whether it is there is a matter of those who draw it: a robot is driven without.
  return folder_ / relative;
}

Shape UrdfFile::convert(const urdf::Geometry* geometry, const urdf::Pose& origin,
                        const std::string& name, const std::string& element) const {
  require(geometry != nullptr, element, "has no geometry");
  Shape shape;
  shape.name = name;
  shape.pose_in_link = convert(origin, element);
  switch (geometry->type) {
    case urdf::Geometry::BOX:
      shape.kind = Shape::Kind::kBox;
      shape.size = convert(static_cast<const urdf::Box*>(geometry)->dim, element);
      require(shape.size.minCoeff() > 0, element, "the box's sizes must be above 0");
      break;
    case urdf::Geometry::SPHERE:
      shape.kind = Shape::Kind::kSphere;
      shape.radius = static_cast<const urdf::Sphere*>(geometry)->radius;
      break;
    case urdf::Geometry::CYLINDER: {
      const auto* cylinder = static_cast<const urdf::Cylinder*>(geometry);
      // URDF has no capsule: a cylinder whose name ends in "_capsule" stands for one.
      shape.kind = name.ends_with("_capsule") ? Shape::Kind::kCapsule : Shape::Kind::kCylinder;
      shape.radius = cylinder->radius;
      shape.length = finite(cylinder->length, element, "the length");
      require(shape.length > 0, element, "the length must be above 0");
      break;
    }
    case urdf::Geometry::MESH: {
      const auto* mesh = static_cast<const urdf::Mesh*>(geometry);
      shape.kind = Shape::Kind::kMesh;
      shape.mesh = mesh_path(mesh->filename, element);
      shape.is_mirrored = mesh->scale.y == -1;
      require(mesh->scale.x == 1 && (mesh->scale.y == 1 || shape.is_mirrored) && mesh->scale.z == 1,
              element,
              "a mesh must be in metres, without a scale other than \"1 -1 1\", its mirror image");
      break;
    }
  }
  const bool has_radius = shape.kind != Shape::Kind::kBox && shape.kind != Shape::Kind::kMesh;
  require(!has_radius || (std::isfinite(shape.radius) && shape.radius > 0), element,
          "the radius must be above 0");
  return shape;
}

void UrdfFile::convert_inertial(const urdf::Inertial& inertial, const std::string& element,
                                Link& link) const {
  link.mass = finite(inertial.mass, element, "the mass");
  require(link.mass > 0, element,
          "the mass must be above 0; omit <inertial> for a link without mass");
  const Eigen::Isometry3d pose = convert(inertial.origin, element);
  link.center_of_mass = pose.translation();
  Eigen::Matrix3d inertia;
  inertia << inertial.ixx, inertial.ixy, inertial.ixz,  //
      inertial.ixy, inertial.iyy, inertial.iyz,         //
      inertial.ixz, inertial.iyz, inertial.izz;
  require(inertia.allFinite(), element, "the inertia is not finite");
  // Principal moments, rising. A rigid body's satisfy the triangle inequality, I3 <= I1 + I2, since
  // I1 + I2 - I3 is twice an integral of a square.
  const Eigen::Vector3d moments =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(inertia, Eigen::EigenvaluesOnly).eigenvalues();
  require(
      moments(0) > 0 && moments(2) <= (moments(0) + moments(1)) * (1 + 1e-9), element,
      "the inertia is not physical: the principal moments must be above 0, and none larger than "
      "the sum of the others");
  // Re-expressed in the link's axes.
  link.inertia = pose.linear() * inertia * pose.linear().transpose();
}

Link UrdfFile::convert(const urdf::Link& source) const {
  const std::string element = "link " + source.name;
  Link link;
  link.name = source.name;
  if (source.inertial != nullptr) {
    convert_inertial(*source.inertial, element, link);
  }
  for (const urdf::VisualSharedPtr& visual : source.visual_array) {
    link.visuals.push_back(convert(visual->geometry.get(), visual->origin, visual->name,
                                   element + ": visual " + visual->name));
  }
  for (const urdf::CollisionSharedPtr& collision : source.collision_array) {
    link.collisions.push_back(convert(collision->geometry.get(), collision->origin, collision->name,
                                      element + ": collision " + collision->name));
  }
  return link;
}

Joint UrdfFile::convert(const urdf::Joint& source) const {
  const std::string element = "joint " + source.name;
  Joint joint;
  joint.name = source.name;
  joint.pose_in_parent = convert(source.parent_to_joint_origin_transform, element);
  if (source.type == urdf::Joint::FIXED) {
    // A fixed joint has neither axis nor limits.
    return joint;
  }
  require(source.type == urdf::Joint::REVOLUTE, element, "must be revolute or fixed");
  joint.kind = Joint::Kind::kRevolute;
  joint.axis = convert(source.axis, element);
  require(joint.axis.norm() > 1e-6, element, "the axis must not be 0");
  joint.axis.normalize();
  require(source.limits != nullptr, element, "has no limits");
  joint.lower = finite(source.limits->lower, element, "the lower limit");
  joint.upper = finite(source.limits->upper, element, "the upper limit");
  require(joint.lower < joint.upper, element, "the lower limit is not below the upper one");
  joint.max_velocity = finite(source.limits->velocity, element, "the velocity limit");
  joint.max_torque = finite(source.limits->effort, element, "the effort limit");
  require(joint.max_velocity > 0, element, "the velocity limit must be above 0");
  require(joint.max_torque > 0, element, "the effort limit must be above 0");
  if (source.mimic != nullptr) {
    joint.mimic_multiplier = finite(source.mimic->multiplier, element, "the mimic's multiplier");
    joint.mimic_offset = finite(source.mimic->offset, element, "the mimic's offset");
  }
  return joint;
}

}  // namespace

// Order of links and joints: order_joints(); indices rise from the root outwards, which the
// kinematics rely on.
void RobotModelReader::read_urdf(const std::filesystem::path& file_path,
                                 const std::map<std::string, int>& limb_of_link) {
  const UrdfFile file(file_path);
  UrdfTree tree = file.tree();
  const urdf::ModelInterfaceSharedPtr urdf = file.parse();
  model_.name_ = urdf->getName();

  const auto add_link = [this, &file, &urdf](const std::string& name, int parent_joint) {
    const urdf::LinkConstSharedPtr source = urdf->getLink(name);
    if (source == nullptr) {
      file.fail("link " + name, "is missing");
    }
    Link link = file.convert(*source);
    link.parent_joint = parent_joint;
    model_.links_.push_back(link);
  };
  add_link(tree.root, -1);
  for (UrdfEdge& edge : tree.edges) file.describe(*urdf, edge);
  for (const UrdfEdge& edge : order_joints(tree.root, tree.edges, limb_of_link)) {
    const urdf::JointConstSharedPtr source = urdf->getJoint(edge.joint);
    Joint joint = file.convert(*source);
    const int index = static_cast<int>(model_.joints_.size());
    joint.parent_link = model_.find_link(edge.parent);
    joint.child_link = static_cast<int>(model_.links_.size());
    add_link(edge.child, index);
    model_.joints_.push_back(joint);
    if (joint.kind == Joint::Kind::kRevolute && source->mimic == nullptr) {
      model_.motor_joints_.push_back(index);
      model_.motor_names_.push_back(joint.name);
    }
  }
  // Mimic joints after all motors are known: the leader may stand below its follower.
  for (Joint& joint : model_.joints_) {
    const urdf::JointConstSharedPtr source = urdf->getJoint(joint.name);
    if (joint.kind != Joint::Kind::kRevolute || source->mimic == nullptr) {
      continue;
    }
    const int motor = model_.find_motor(source->mimic->joint_name);
    if (motor < 0) {
      file.fail("joint " + joint.name,
                "mimics \"" + source->mimic->joint_name + "\", which is not a joint with a motor");
    }
    joint.mimic_joint = model_.motor_joints_[motor];
  }
}

}  // namespace nao

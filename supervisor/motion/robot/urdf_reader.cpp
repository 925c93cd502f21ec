#include "supervisor/motion/robot/urdf_reader.h"

#include <algorithm>
#include <map>
#include <utility>

#include "runtime/ground/result/closest.h"
#include "supervisor/motion/robot/codes.h"
#include "supervisor/motion/robot/internal/robot_tree.h"

namespace stepwright::motion {

namespace {

using internal::Reader;
using internal::ReadJoint;
using internal::ReadLink;
using pugi::xml_node;

constexpr const char* kMillimetres = "URDF is in metres: are these millimetres?";

class UrdfReader {
 public:
  explicit UrdfReader(const internal::XmlDocument& document) : reader_(document) {}

  result::Result<Robot> read() {
    const xml_node root = reader_.document().root();
    if (std::string_view(root.name()) != "robot") {
      reader_.complain(code::kBadMember, reader_.document().at(root), "the file holds no <robot>",
                       "URDF is read here; SDF and xacro are not");
      return tl::unexpected(reader_.take());
    }
    read_links(root);
    read_joints(root);
    if (reader_.failed()) return tl::unexpected(reader_.take());
    Robot robot = make_tree(std::move(links_), joints_, reader_);
    robot.name = reader_.text(root, "name");
    if (!reader_.failed()) check_length(robot);
    if (reader_.failed()) return tl::unexpected(reader_.take());
    return robot;
  }

 private:
  result::Location at(xml_node node) const { return reader_.document().at(node); }

  Transform origin(xml_node node) {
    const xml_node found = reader_.child(node, "origin", false);
    if (!found) return {};
    const Vector3 rpy = reader_.vector(found, "rpy", Vector3{});
    return {from_rpy(rpy.x, rpy.y, rpy.z), reader_.vector(found, "xyz", Vector3{})};
  }

  double size(xml_node node, const char* attribute) {
    const std::size_t before = reader_.count();
    const double value = reader_.number(node, attribute, std::nullopt);
    if (reader_.count() == before) check_size(value, node, attribute);
    return value;
  }

  void check_size(double value, xml_node node, const char* attribute) {
    if (!(value > 0.0))
      reader_.complain(code::kOutOfRange, reader_.document().at(node, attribute),
                       std::string("'") + attribute + "' is not above zero");
    else if (value > kLongestRobot_m)
      reader_.complain(code::kUnits, reader_.document().at(node, attribute),
                       std::string("'") + attribute + "' is longer than 50 m", kMillimetres);
  }

  void read_shape(xml_node collision, Link& link) {
    const xml_node geometry = reader_.child(collision, "geometry", true);
    if (!geometry) return;
    Shape shape;
    shape.origin = origin(collision);
    const xml_node body = geometry.first_child();
    const std::string_view kind = body.name();
    if (kind == "box") {
      shape.kind = ShapeKind::Box;
      const std::size_t before = reader_.count();
      shape.size_m = reader_.vector(body, "size", std::nullopt);
      if (reader_.count() == before)
        for (const double side : {shape.size_m.x, shape.size_m.y, shape.size_m.z})
          check_size(side, body, "size");
    } else if (kind == "cylinder") {
      shape.kind = ShapeKind::Cylinder;
      shape.radius_m = size(body, "radius");
      shape.length_m = size(body, "length");
    } else if (kind == "sphere") {
      shape.kind = ShapeKind::Sphere;
      shape.radius_m = size(body, "radius");
    } else if (kind == "mesh") {
      shape.kind = ShapeKind::Mesh;
      shape.mesh = reader_.text(body, "filename");
      shape.where = reader_.document().at(body, "filename");
      shape.scale = reader_.vector(body, "scale", Vector3{1, 1, 1});
      if (shape.scale.x == 0.0 || shape.scale.y == 0.0 || shape.scale.z == 0.0)
        reader_.complain(code::kOutOfRange, reader_.document().at(body, "scale"), "a mesh of no size");
    } else {
      reader_.complain(code::kBadMember, at(body ? body : geometry),
                       "<geometry> holds none of box, cylinder, sphere, mesh");
      return;
    }
    if (++shapes_ == kMostShapes + 1)
      reader_.complain(code::kTooLarge, at(collision), "there are more than 16384 <collision> elements");
    if (shapes_ <= kMostShapes) link.shapes.push_back(std::move(shape));
  }

  void read_links(xml_node root) {
    for (const xml_node node : root.children("link")) {
      if (links_.size() == kMostLinks) {
        reader_.complain(code::kTooLarge, at(node), "there are more than 1024 links");
        return;
      }
      ReadLink read{node, {}};
      read.link.name = reader_.text(node, "name");
      if (!link_names_.emplace(read.link.name, static_cast<int>(links_.size())).second)
        reader_.complain(code::kBadMember, reader_.document().at(node, "name"),
                         "there are two links '" + read.link.name + "'");
      for (const xml_node collision : node.children("collision")) read_shape(collision, read.link);
      links_.push_back(std::move(read));
    }
    if (links_.empty()) reader_.complain(code::kBadMember, at(root), "the robot has no <link>");
  }

  int linked(xml_node joint, const char* role) {
    const xml_node node = reader_.child(joint, role, true);
    if (!node) return -1;
    const std::string name = reader_.text(node, "link");
    const auto found = link_names_.find(name);
    if (found != link_names_.end()) return found->second;
    std::vector<std::string> names;
    for (const auto& [known, number] : link_names_) names.push_back(known);
    const std::string* meant = result::closest(name, names, 2);
    if (!name.empty())
      reader_.complain(code::kUnknownName, reader_.document().at(node, "link"),
                       "there is no link '" + name + "'", meant ? "did you mean '" + *meant + "'?" : "");
    return -1;
  }

  bool read_kind(xml_node node, Joint& joint) {
    const std::string type = reader_.text(node, "type");
    if (type == "fixed")
      joint.kind = JointKind::Fixed;
    else if (type == "revolute")
      joint.kind = JointKind::Revolute;
    else if (type == "continuous")
      joint.kind = JointKind::Continuous;
    else if (type == "prismatic")
      joint.kind = JointKind::Prismatic;
    else {
      if (!type.empty())
        reader_.complain(
            code::kJointType, reader_.document().at(node, "type"),
            "joints of type '" + type + "' are not planned for",
            "fixed, revolute, continuous and prismatic are; planar and floating are made of those");
      return false;
    }
    return true;
  }

  void read_axis(xml_node node, Joint& joint) {
    const xml_node axis = reader_.child(node, "axis", false);
    if (!axis || joint.kind == JointKind::Fixed) return;
    const Vector3 given = reader_.vector(axis, "xyz", Vector3{1, 0, 0});
    if (length(given) < 1e-6)
      reader_.complain(code::kOutOfRange, reader_.document().at(axis, "xyz"), "the axis has no direction");
    else
      joint.axis = normalised(given);
  }

  void read_limits(xml_node node, ReadJoint& read) {
    const JointKind kind = read.joint.kind;
    const bool bounded = kind == JointKind::Revolute || kind == JointKind::Prismatic;
    const xml_node limit = reader_.child(node, "limit", false);
    if (!limit) {
      if (bounded && read.mimics.empty())
        reader_.complain(code::kNoLimits, at(node),
                         "the joint '" + read.joint.name + "' moves and has no <limit>",
                         R"(<limit lower="-1.57" upper="1.57" velocity="1" effort="10"/>, in rad or m)");
      return;
    }
    if (bounded) {
      for (const char* needed : {"lower", "upper"})
        if (!limit.attribute(needed) && read.mimics.empty())
          reader_.complain(code::kNoLimits, at(limit),
                           "the joint '" + read.joint.name + "' has no limit '" + needed + "'",
                           "in rad or m");
      read.limits.lower = reader_.number(limit, "lower", 0.0);
      read.limits.upper = reader_.number(limit, "upper", 0.0);
      if (read.limits.lower > read.limits.upper)
        reader_.complain(code::kOutOfRange, reader_.document().at(limit, "lower"),
                         "the lower limit of '" + read.joint.name + "' is above the upper one");
      constexpr double kMostTurns_rad = 100.0;  // 16 turns
      const double most = std::max(std::abs(read.limits.lower), std::abs(read.limits.upper));
      if (kind == JointKind::Revolute && most > kMostTurns_rad)
        reader_.complain(code::kUnits, at(limit),
                         "the joint '" + read.joint.name + "' turns by more than 100 rad",
                         "URDF is in radians: are these degrees?");
      if (kind == JointKind::Prismatic && most > kLongestRobot_m)
        reader_.complain(code::kUnits, at(limit), "the joint '" + read.joint.name + "' is longer than 50 m",
                         kMillimetres);
    }
    read.limits.velocity_per_s = reader_.number(limit, "velocity", 0.0);
    if (read.limits.velocity_per_s < 0.0)
      reader_.complain(code::kOutOfRange, reader_.document().at(limit, "velocity"),
                       "'velocity' is below zero");
  }

  void read_mimic(xml_node node, ReadJoint& read) {
    const xml_node mimic = reader_.child(node, "mimic", false);
    if (!mimic || read.joint.kind == JointKind::Fixed) return;
    read.mimics = reader_.text(mimic, "joint");
    read.joint.multiplier = reader_.number(mimic, "multiplier", 1.0);
    read.joint.offset = reader_.number(mimic, "offset", 0.0);
  }

  void read_joints(xml_node root) {
    std::map<std::string, bool> names;
    for (const xml_node node : root.children("joint")) {
      if (joints_.size() == kMostLinks) {
        reader_.complain(code::kTooLarge, at(node), "there are more than 1024 joints");
        return;
      }
      ReadJoint read{node, {}, {}, -1, -1, {}};
      read.joint.name = reader_.text(node, "name");
      if (!names.emplace(read.joint.name, true).second)
        reader_.complain(code::kBadMember, reader_.document().at(node, "name"),
                         "there are two joints '" + read.joint.name + "'");
      if (!read_kind(node, read.joint)) continue;
      read.joint.origin = origin(node);
      read.parent = linked(node, "parent");
      read.child = linked(node, "child");
      read_axis(node, read.joint);
      read_mimic(node, read);
      read_limits(node, read);
      if (read.parent >= 0 && read.parent == read.child)
        reader_.complain(code::kNoTree, at(node),
                         "the joint '" + read.joint.name + "' joins a link to itself");
      joints_.push_back(std::move(read));
    }
  }

  // How far from the root a link can be, at most: no robot reaches 50 m.
  void check_length(const Robot& robot) {
    std::vector<double> reach(robot.links.size(), 0.0);
    for (std::size_t j = 0; j < robot.joints.size(); ++j) {
      const Joint& joint = robot.joints[j];
      double travel = 0.0;
      if (joint.kind == JointKind::Prismatic && joint.coordinate >= 0) {
        const Coordinate& limits = robot.coordinates[static_cast<std::size_t>(joint.coordinate)];
        travel = std::abs(joint.multiplier) * std::max(std::abs(limits.lower), std::abs(limits.upper)) +
                 std::abs(joint.offset);
      }
      reach[j + 1] = reach[static_cast<std::size_t>(joint.parent)] + length(joint.origin.position_m) + travel;
      if (!(reach[j + 1] <= kLongestRobot_m)) return too_long(joint);
    }
    for (std::size_t k = 0; k < robot.links.size(); ++k)
      for (const Shape& shape : robot.links[k].shapes)
        if (!(reach[k] + length(shape.origin.position_m) <= kLongestRobot_m)) {
          reader_.complain(code::kUnits, at(reader_.document().root()),
                           "a body of the link '" + robot.links[k].name + "' is more than 50 m from the root",
                           kMillimetres);
          return;
        }
  }

  void too_long(const Joint& joint) {
    for (const ReadJoint& each : joints_)
      if (each.joint.name == joint.name)
        reader_.complain(code::kUnits, at(each.node.child("origin") ? each.node.child("origin") : each.node),
                         "the robot reaches further than 50 m at the joint '" + joint.name + "'",
                         kMillimetres);
  }

  Reader reader_;
  std::vector<ReadLink> links_;
  std::vector<ReadJoint> joints_;
  std::map<std::string, int> link_names_;
  std::size_t shapes_ = 0;
};

}  // namespace

result::Result<Robot> read_urdf(std::string_view text, std::string name) {
  auto document = internal::XmlDocument::parse(text, std::move(name));
  if (!document) return result::forward(document);
  return UrdfReader(*document).read();
}

}  // namespace stepwright::motion

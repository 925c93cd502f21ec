#include "supervisor/motion/robot/srdf_reader.h"

#include <map>
#include <set>

#include "runtime/ground/result/closest.h"
#include "supervisor/motion/robot/codes.h"
#include "supervisor/motion/robot/internal/xml_document.h"

namespace stepwright::motion {

namespace {

using pugi::xml_node;

class SrdfReader {
 public:
  SrdfReader(const internal::XmlDocument& document, const Robot& robot) : reader_(document), robot_(robot) {
    for (const Link& each : robot.links) link_names_.push_back(each.name);
    for (const Joint& each : robot.joints) joint_names_.push_back(each.name);
  }

  result::Result<Semantics> read() {
    const xml_node root = reader_.document().root();
    if (std::string_view(root.name()) != "robot")
      reader_.complain(code::kBadMember, reader_.document().at(root), "the file holds no <robot>",
                       "SRDF is read here, with the robot's groups");
    read_groups(root);
    read_states(root);
    read_end_effectors(root);
    read_disabled(root);
    if (reader_.failed()) return tl::unexpected(reader_.take());
    return std::move(read_);
  }

 private:
  struct Members {
    std::set<int> links;
    std::set<int> joints;
  };

  // -1 and a message where there is none of that name.
  int named(xml_node node, const char* attribute, const char* what, const std::vector<std::string>& names) {
    const std::string name = reader_.text(node, attribute);
    if (name.empty()) return -1;
    const auto found = std::find(names.begin(), names.end(), name);
    if (found != names.end()) return static_cast<int>(found - names.begin());
    const std::string* meant = result::closest(name, names, 2);
    reader_.complain(code::kUnknownName, reader_.document().at(node, attribute),
                     std::string("the robot has no ") + what + " '" + name + "'",
                     meant ? "did you mean '" + *meant + "'?" : "");
    return -1;
  }
  int link(xml_node node, const char* attribute) { return named(node, attribute, "link", link_names_); }
  int joint(xml_node node, const char* attribute) { return named(node, attribute, "joint", joint_names_); }

  std::string name_of(xml_node node) {
    std::string name = reader_.text(node, "name");
    return name;
  }

  void add_link(int link, Members& members) {
    if (link < 0) return;
    members.links.insert(link);
    if (link > 0) members.joints.insert(Robot::joint_above(link));
  }

  void add_joint(int joint, Members& members) {
    if (joint < 0) return;
    members.joints.insert(joint);
    members.links.insert(Robot::link_below(joint));
  }

  void add_chain(xml_node node, Group& group, Members& members) {
    const int base = link(node, "base_link");
    const int tip = link(node, "tip_link");
    if (base < 0 || tip < 0) return;
    if (!robot_.hangs_below(tip, base)) {
      reader_.complain(code::kNoChain, reader_.document().at(node),
                       "the link '" + link_names_[static_cast<std::size_t>(tip)] + "' does not hang below '" +
                           link_names_[static_cast<std::size_t>(base)] + "'",
                       "a chain goes from a link down to one that it carries");
      return;
    }
    // The joint above the base is none of the chain's: it moves the base.
    members.links.insert(base);
    for (int at = tip; at != base; at = robot_.parent_link(at)) add_link(at, members);
    group.base_link = base;
    group.tip_link = tip;
  }

  void read_group(xml_node node) {
    Group group;
    group.name = name_of(node);
    Members members;
    int parts = 0;
    for (const xml_node each : node.children()) {
      const std::string_view kind = each.name();
      if (each.type() != pugi::node_element || kind == "passive_joint") continue;
      ++parts;
      if (kind == "chain")
        add_chain(each, group, members);
      else if (kind == "link")
        add_link(link(each, "name"), members);
      else if (kind == "joint")
        add_joint(joint(each, "name"), members);
      else if (kind == "group")
        add_group(each, members);
      else
        reader_.complain(code::kBadMember, reader_.document().at(each),
                         "<" + std::string(kind) + "> is not known in <group>", "chain, link, joint, group");
    }
    if (parts != 1) group.base_link = group.tip_link = -1;
    if (!group.name.empty() && read_.group(group.name))
      reader_.complain(code::kBadMember, reader_.document().at(node),
                       "there are two groups '" + group.name + "'");
    group.links.assign(members.links.begin(), members.links.end());
    group.joints.assign(members.joints.begin(), members.joints.end());
    std::set<int> coordinates;
    for (const int each : group.joints) {
      const Joint& moved = robot_.joints[static_cast<std::size_t>(each)];
      if (moved.coordinate >= 0) coordinates.insert(moved.coordinate);
    }
    group.coordinates.assign(coordinates.begin(), coordinates.end());
    read_.groups.push_back(std::move(group));
  }

  // Groups stand before those that name them: so none can name itself round a circle.
  void add_group(xml_node node, Members& members) {
    const std::string name = name_of(node);
    const Group* found = read_.group(name);
    if (!found) {
      if (!name.empty())
        reader_.complain(code::kUnknownName, reader_.document().at(node, "name"),
                         "there is no group '" + name + "' above this one",
                         "a group names groups that stand before it in the file");
      return;
    }
    members.links.insert(found->links.begin(), found->links.end());
    members.joints.insert(found->joints.begin(), found->joints.end());
  }

  void read_groups(xml_node root) {
    for (const xml_node node : root.children("group")) {
      if (read_.groups.size() == kMostGroups) {
        reader_.complain(code::kTooLarge, reader_.document().at(node), "there are more than 256 groups");
        return;
      }
      read_group(node);
    }
  }

  bool known_group(xml_node node, const char* attribute, const std::string& name) {
    if (name.empty() || read_.group(name)) return !name.empty();
    std::vector<std::string> names;
    for (const Group& each : read_.groups) names.push_back(each.name);
    const std::string* meant = result::closest(name, names, 2);
    reader_.complain(code::kUnknownName, reader_.document().at(node, attribute),
                     "there is no group '" + name + "'", meant ? "did you mean '" + *meant + "'?" : "");
    return false;
  }

  void read_states(xml_node root) {
    for (const xml_node node : root.children("group_state")) {
      if (read_.states.size() == kMostNamedStates) {
        reader_.complain(code::kTooLarge, reader_.document().at(node), "there are more than 4096 states");
        return;
      }
      NamedState state;
      state.name = name_of(node);
      state.group = reader_.text(node, "group");
      known_group(node, "group", state.group);
      for (const xml_node each : node.children("joint")) {
        const int of = joint(each, "name");
        const double value = reader_.number(each, "value", std::nullopt);
        if (of >= 0) add_value(each, of, value, state);
      }
      read_.states.push_back(std::move(state));
    }
  }

  void add_value(xml_node node, int of, double value, NamedState& state) {
    const int coordinate = robot_.joints[static_cast<std::size_t>(of)].coordinate;
    if (coordinate < 0 || robot_.coordinates[static_cast<std::size_t>(coordinate)].joint != of) return;
    const Coordinate& limits = robot_.coordinates[static_cast<std::size_t>(coordinate)];
    constexpr double kRounded = 1e-3;  // files give limits with few digits
    if (value < limits.lower - kRounded || value > limits.upper + kRounded)
      reader_.complain(code::kOutOfRange, reader_.document().at(node, "value"),
                       "the value of '" + limits.name + "' is outside of its limits");
    state.values.emplace_back(coordinate, std::clamp(value, limits.lower, limits.upper));
  }

  void read_end_effectors(xml_node root) {
    for (const xml_node node : root.children("end_effector")) {
      EndEffector hand;
      hand.name = name_of(node);
      hand.group = reader_.text(node, "group");
      known_group(node, "group", hand.group);
      hand.parent_link = link(node, "parent_link");
      hand.parent_group = node.attribute("parent_group").value();
      if (!hand.parent_group.empty()) known_group(node, "parent_group", hand.parent_group);
      if (read_.end_effectors.size() < kMostGroups) read_.end_effectors.push_back(std::move(hand));
    }
  }

  void read_disabled(xml_node root) {
    std::set<std::pair<int, int>> pairs;
    for (const xml_node node : root.children("disable_collisions")) {
      const int a = link(node, "link1");
      const int b = link(node, "link2");
      if (a >= 0 && b >= 0) pairs.emplace(std::min(a, b), std::max(a, b));
    }
    read_.disabled.assign(pairs.begin(), pairs.end());
  }

  internal::Reader reader_;
  const Robot& robot_;
  std::vector<std::string> link_names_;
  std::vector<std::string> joint_names_;
  Semantics read_;
};

}  // namespace

result::Result<Semantics> read_srdf(std::string_view text, std::string name, const Robot& robot) {
  auto document = internal::XmlDocument::parse(text, std::move(name));
  if (!document) return result::forward(document);
  return SrdfReader(*document, robot).read();
}

}  // namespace stepwright::motion

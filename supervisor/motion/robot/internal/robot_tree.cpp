#include "supervisor/motion/robot/internal/robot_tree.h"

#include <algorithm>
#include <map>
#include <utility>

#include "runtime/ground/result/closest.h"
#include "supervisor/motion/robot/codes.h"

namespace stepwright::motion::internal {

namespace {

class TreeMaker {
 public:
  TreeMaker(std::vector<ReadLink> links, std::vector<ReadJoint> joints, Reader& reader)
      : links_(std::move(links)),
        joints_(std::move(joints)),
        reader_(reader),
        joint_of_link_(links_.size(), -1) {}

  Robot make() {
    if (!find_parents()) return {};
    if (!order_links()) return {};
    add_coordinates();
    return std::move(robot_);
  }

 private:
  result::Location place(std::size_t joint) const { return reader_.document().at(joints_[joint].node); }

  bool find_parents() {
    bool sound = true;
    for (std::size_t j = 0; j < joints_.size(); ++j) {
      int& above = joint_of_link_[static_cast<std::size_t>(joints_[j].child)];
      if (above >= 0) {
        sound = false;
        reader_.complain(code::kNoTree, place(j),
                         "the link '" + links_[static_cast<std::size_t>(joints_[j].child)].link.name +
                             "' has two parents: the joints '" +
                             joints_[static_cast<std::size_t>(above)].joint.name + "' and '" +
                             joints_[j].joint.name + "'",
                         "closed kinematic loops are not planned for; cut one of the joints");
      } else {
        above = static_cast<int>(j);
      }
    }
    return sound;
  }

  // From the root down, children in the order of the file.
  bool order_links() {
    std::vector<std::size_t> roots;
    for (std::size_t k = 0; k < links_.size(); ++k)
      if (joint_of_link_[k] < 0) roots.push_back(k);
    if (roots.size() > 1) {
      reader_.complain(code::kNoTree, reader_.document().at(links_[roots[1]].node),
                       "the links '" + links_[roots[0]].link.name + "' and '" + links_[roots[1]].link.name +
                           "' both have no parent",
                       "join them by a fixed joint");
      return false;
    }
    std::vector<std::vector<std::size_t>> below(links_.size());
    for (std::size_t j = 0; j < joints_.size(); ++j)
      below[static_cast<std::size_t>(joints_[j].parent)].push_back(j);
    std::vector<int> number(links_.size(), -1);
    std::vector<std::size_t> open(roots.rbegin(), roots.rend());
    while (!open.empty()) {
      const std::size_t link = open.back();
      open.pop_back();
      number[link] = static_cast<int>(robot_.links.size());
      robot_.links.push_back(std::move(links_[link].link));
      if (const int above = joint_of_link_[link]; above >= 0) {
        ReadJoint& read = joints_[static_cast<std::size_t>(above)];
        read.joint.parent = number[static_cast<std::size_t>(read.parent)];
        order_.push_back(static_cast<std::size_t>(above));
      }
      const auto& children = below[link];
      for (std::size_t k = children.size(); k-- > 0;)
        open.push_back(static_cast<std::size_t>(joints_[children[k]].child));
    }
    const auto left = std::find(number.begin(), number.end(), -1);
    if (left == number.end()) return true;
    const auto lost = static_cast<std::size_t>(left - number.begin());
    reader_.complain(code::kNoTree, place(static_cast<std::size_t>(joint_of_link_[lost])),
                     "the joints go round in a circle at the link '" + links_[lost].link.name + "'",
                     "closed kinematic loops are not planned for; cut one of the joints");
    return false;
  }

  // Follows joints that mimic others to one that moves by itself; false: there is none.
  bool follow(std::size_t from, Joint& joint, std::size_t& moved_by) {
    moved_by = from;
    for (std::size_t steps = 0; !joints_[moved_by].mimics.empty(); ++steps) {
      const auto found = by_name_.find(joints_[moved_by].mimics);
      if (found == by_name_.end()) {
        unknown_mimic(moved_by);
        return false;
      }
      if (steps > joints_.size()) {
        reader_.complain(code::kNoTree, place(from),
                         "the joint '" + joints_[from].joint.name + "' mimics itself");
        return false;
      }
      moved_by = found->second;
      const Joint& next = joints_[moved_by].joint;
      if (next.kind == JointKind::Fixed) {
        reader_.complain(
            code::kNoTree, place(from),
            "the joint '" + joints_[from].joint.name + "' mimics '" + next.name + "', which is fixed");
        return false;
      }
      if (!joints_[moved_by].mimics.empty()) {  // value = m (m' v + o') + o
        joint.offset += joint.multiplier * next.offset;
        joint.multiplier *= next.multiplier;
      }
    }
    return true;
  }

  void unknown_mimic(std::size_t joint) {
    std::vector<std::string> names;
    for (const ReadJoint& each : joints_) names.push_back(each.joint.name);
    const std::string* meant = result::closest(joints_[joint].mimics, names, 2);
    reader_.complain(code::kUnknownName, place(joint),
                     "there is no joint '" + joints_[joint].mimics + "' to mimic",
                     meant ? "did you mean '" + *meant + "'?" : "");
  }

  void add_coordinates() {
    for (std::size_t j = 0; j < joints_.size(); ++j) by_name_.emplace(joints_[j].joint.name, j);
    std::map<std::size_t, int> coordinate_of;
    for (std::size_t k = 0; k < order_.size(); ++k) {
      const ReadJoint& read = joints_[order_[k]];
      if (read.joint.kind == JointKind::Fixed || !read.mimics.empty()) continue;
      coordinate_of[order_[k]] = static_cast<int>(robot_.coordinates.size());
      robot_.coordinates.push_back(read.limits);
      robot_.coordinates.back().name = read.joint.name;
      robot_.coordinates.back().joint = static_cast<int>(k);
    }
    for (const std::size_t each : order_) {
      Joint joint = joints_[each].joint;
      std::size_t moved_by = each;
      if (joint.kind != JointKind::Fixed && follow(each, joint, moved_by))
        joint.coordinate = coordinate_of[moved_by];
      robot_.joints.push_back(std::move(joint));
    }
  }

  std::vector<ReadLink> links_;
  std::vector<ReadJoint> joints_;
  Reader& reader_;
  std::vector<int> joint_of_link_;
  std::vector<std::size_t> order_;  // read joints as the tree has them
  std::map<std::string, std::size_t> by_name_;
  Robot robot_;
};

}  // namespace

Robot make_tree(std::vector<ReadLink> links, std::vector<ReadJoint> joints, Reader& reader) {
  return TreeMaker(std::move(links), std::move(joints), reader).make();
}

}  // namespace stepwright::motion::internal

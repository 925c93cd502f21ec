#include "supervisor/fleet/vda5050/stitching.h"

#include <set>
#include <utility>

namespace stepwright::fleet::vda5050 {

namespace {

class UpdateCheck {
 public:
  UpdateCheck(const Order& held, const Order& update, const std::string& source)
      : held_(held), update_(update), source_(source) {}

  result::Diagnostics check() {
    if (update_.order_id != held_.order_id)
      refuse("/orderId", "is not that of the order '" + held_.order_id + "'");
    if (update_.update_id <= held_.update_id) {
      refuse("/orderUpdateId",
             std::to_string(update_.update_id) + " does not follow " + std::to_string(held_.update_id));
    }
    const auto last = decision_point(held_);
    if (!last) {
      refuse("/nodes/0", "nothing is released that it could follow");
      return std::move(wrong_);
    }
    check_stitching_node(held_.nodes[*last], update_.nodes.front());
    check_actions(*last);
    return std::move(wrong_);
  }

 private:
  void refuse(const std::string& pointer, const std::string& what, const std::string& hint = {}) {
    wrong_.push_back({.code = "F0905",
                      .severity = result::Severity::Error,
                      .where = {source_, 0, 0},
                      .message = pointer + ": " + what,
                      .hint = hint});
  }

  void check_stitching_node(const Node& end, const Node& first) {
    const std::string hint = "an update begins with the last node of the base, unchanged";
    if (first.id != end.id) refuse("/nodes/0/nodeId", "is not '" + end.id + "'", hint);
    if (first.sequence != end.sequence) {
      refuse("/nodes/0/sequenceId", "is not " + std::to_string(end.sequence), hint);
    }
    if (!first.released) refuse("/nodes/0/released", "takes back a node of the base", hint);
    if (first.position != end.position) refuse("/nodes/0/nodePosition", "has changed", hint);
    if (first.actions != end.actions) refuse("/nodes/0/actions", "have changed", hint);
  }

  void check_actions(std::size_t last) {
    std::set<std::string> known;
    for (std::size_t k = 0; k <= last; ++k) {
      for (const Action& action : held_.nodes[k].actions) known.insert(action.id);
      if (k == last) break;
      for (const Action& action : held_.edges[k].actions) known.insert(action.id);
    }
    for (std::size_t k = 1; k < update_.nodes.size(); ++k) {
      const std::string node = "/nodes/" + std::to_string(k), edge = "/edges/" + std::to_string(k - 1);
      refuse_known(update_.nodes[k].actions, node, known);
      refuse_known(update_.edges[k - 1].actions, edge, known);
    }
  }

  void refuse_known(const std::vector<Action>& actions, const std::string& pointer,
                    const std::set<std::string>& known) {
    for (std::size_t a = 0; a < actions.size(); ++a) {
      if (!known.contains(actions[a].id)) continue;
      refuse(pointer + "/actions/" + std::to_string(a) + "/actionId",
             "'" + actions[a].id + "' is an action of the base already");
    }
  }

  const Order& held_;
  const Order& update_;
  const std::string& source_;
  result::Diagnostics wrong_;
};

}  // namespace

result::Diagnostics check_update(const Order& held, const Order& update, const std::string& source) {
  return UpdateCheck(held, update, source).check();
}

Order stitched(Order held, const Order& update) {
  const std::size_t last = decision_point(held).value_or(0);
  held.header = update.header;
  held.update_id = update.update_id;
  held.nodes.resize(last + 1);
  held.edges.resize(last);
  held.nodes.insert(held.nodes.end(), update.nodes.begin() + 1, update.nodes.end());
  held.edges.insert(held.edges.end(), update.edges.begin(), update.edges.end());
  return held;
}

}  // namespace stepwright::fleet::vda5050

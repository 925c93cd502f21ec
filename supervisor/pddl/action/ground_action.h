#pragma once

// One action of a plan, instantiated: what it requires, changes, reads and writes, by ground names. The
// translator builds guards from it and the executive compares what it observes with it.
//
// Thread rule: plain values, pure function.
//
//   auto info = inspect_action(task, {"unload", {"v1", "a1", "level8"}});
//   for (const Requirement& r : info->preconditions) ...

#include <cstdint>
#include <functional>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "runtime/ground/result/result.h"
#include "supervisor/model/plan.h"
#include "supervisor/pddl/definition/numeric_kinds.h"
#include "supervisor/pddl/task/task.h"

namespace stepwright::pddl {

// A ground arithmetic expression. Fluents that no action changes are folded into constants.
struct NumericNode {
  NumericKind kind = NumericKind::Constant;
  double constant = 0.0;
  std::string fluent;                 // "(lev v1)"
  std::vector<NumericNode> operands;  // one for Negate, two for the other operators
};

enum class RequirementKind : std::uint8_t { Fact, Comparison, Any, All };

// One requirement. What is decided by static facts and objects is left out already; quantifiers are expanded.
struct Requirement {
  RequirementKind kind = RequirementKind::Fact;
  std::string text;                // PDDL, ground
  std::string fact;                // Fact: "(is-at v1 f1)"
  bool positive = true;            // Fact: must hold, or must not
  Relation relation{};             // Comparison: left relation right
  NumericNode left, right;         // Comparison
  std::vector<Requirement> parts;  // Any: one suffices (none: impossible); All: inside Any
};

// One change. `when` is empty unless the effect is conditional; the conditions are read before the action.
struct Change {
  ChangeKind kind = ChangeKind::Add;
  std::string target;  // the fact or fluent
  NumericNode amount;  // numeric changes
  std::vector<Requirement> when;
};

struct GroundActionInfo {
  model::GroundAction action;
  std::vector<Requirement> preconditions;  // all must hold
  std::vector<Change> changes;
  std::set<std::string> reads;   // facts and fluents that conditions and amounts look at, and what derived
                                 // ones among them depend on
  std::set<std::string> writes;  // facts and fluents that may change
  std::set<std::string>
      counts;  // fluents that only the metric reads and that are only increased or decreased here
};

// For many actions of one task. One object per use; it only reads the task, which must outlive it.
class ActionInspector {
 public:
  // `stop` is asked now and then; since it said so nothing can be inspected any more.
  explicit ActionInspector(const Task& task, std::function<bool()> stop = {});
  ActionInspector(const ActionInspector&) = delete;
  ActionInspector& operator=(const ActionInspector&) = delete;
  ~ActionInspector();

  // Fails (P03xx) on an unknown action, a wrong number of arguments, an unknown object or a wrong type, and
  // once it is stopped (P0311).
  [[nodiscard]] result::Result<GroundActionInfo> inspect(const model::GroundAction& action);

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

// The same for a single action.
[[nodiscard]] result::Result<GroundActionInfo> inspect_action(const Task& task,
                                                              const model::GroundAction& action);

}  // namespace stepwright::pddl

#pragma once

// Mentions of objects: by facts and fluents of the ground task, and through these by operators, axioms and
// the goal.
//
// Thread rule: immutable.

#include <string>
#include <utility>
#include <vector>

#include "supervisor/pddl/ground_task/ground_task.h"

namespace stepwright::pddl {

class ObjectMentions {
 public:
  explicit ObjectMentions(const GroundTask& task);

  const std::vector<int>& facts(int object) const { return at(object).facts; }
  const std::vector<int>& variables(int object) const { return at(object).variables; }
  const std::vector<int>& operators(int object) const { return at(object).operators; }
  bool by_goal(int object) const { return at(object).by_goal; }
  bool by_axiom(int object) const { return at(object).by_axiom; }

  // Which symbols mention it where, and how often: objects that can change places have the same pattern.
  using Pattern = std::vector<std::pair<int, int>>;
  const Pattern& pattern(int object) const { return at(object).pattern; }

  // Does no fact and no fluent mention both?
  bool apart(int a, int b) const;

  // Objects that an operator mentions, ascending.
  const std::vector<int>& objects(int op) const { return objects_[static_cast<std::size_t>(op)]; }

 private:
  struct Entry {
    std::vector<int> facts, variables, operators;
    std::vector<int> neighbours;  // objects that some fact or fluent mentions with it, ascending
    Pattern pattern;
    bool by_goal = false, by_axiom = false;
  };

  const Entry& at(int object) const { return entries_[static_cast<std::size_t>(object)]; }
  void enter(const Atom& atom, int index, int symbol, std::vector<int> Entry::*list);

  std::vector<Entry> entries_;
  std::vector<std::vector<int>> objects_;  // by operator
};

}  // namespace stepwright::pddl

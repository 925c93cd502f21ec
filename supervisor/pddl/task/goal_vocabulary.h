#pragma once

// Vocabulary of the goals of a task, for forms in which people put goals together.
//
// Thread rule: pure function.
//
//   const GoalVocabulary words = goal_vocabulary(task);
//   words.objects.at("place")       // {"f1", "a1", "a2"}, subtypes included

#include <map>
#include <string>
#include <vector>

#include "supervisor/pddl/task/task.h"

namespace stepwright::pddl {

struct GoalParameter {
  std::string name;  // as the domain names it, without its question mark
  std::string type;  // a key of GoalVocabulary::objects
};

struct GoalSymbol {
  std::string name;
  std::vector<GoalParameter> parameters;
  bool changes = false;  // some action changes it; what none changes is only good for comparing with
};

struct GoalVocabulary {
  std::map<std::string, std::vector<std::string>> objects;  // of every type that a parameter below has
  std::vector<GoalSymbol> predicates;  // those that change or are derived: the others hold or never will
  std::vector<GoalSymbol> functions;   // all, without the metric's total-time
};

GoalVocabulary goal_vocabulary(const Task& task);

// A goal's conjuncts as one text, each on a line of its own behind the first: a diagnostic's line says which
// conjunct it is about.
std::string goal_text(const std::vector<std::string>& conjuncts);

}  // namespace stepwright::pddl

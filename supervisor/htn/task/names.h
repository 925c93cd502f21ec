#pragma once

// The names of a task while it is being resolved.
//
// Thread rule: one reading, one object.

#include <map>
#include <string>

namespace stepwright::htn {

struct Names {
  std::map<std::string, int> types;  // an either by its text
  std::map<std::string, int> objects;
  std::map<std::string, int> predicates;
  std::map<std::string, int> functions;
  std::map<std::string, int> actions;
  std::map<std::string, int> tasks;
};

}  // namespace stepwright::htn

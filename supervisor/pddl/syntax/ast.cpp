#include "supervisor/pddl/syntax/ast.h"

#include <algorithm>

namespace stepwright::pddl {

bool Definition::is_subtype(int type, int ancestor) const {
  const std::vector<int>& own = types[static_cast<std::size_t>(type)].members;
  if (!own.empty()) {
    return std::all_of(own.begin(), own.end(), [&](int member) { return is_subtype(member, ancestor); });
  }
  const std::vector<int>& wanted = types[static_cast<std::size_t>(ancestor)].members;
  if (!wanted.empty()) {
    return std::any_of(wanted.begin(), wanted.end(), [&](int member) { return is_subtype(type, member); });
  }
  while (type != -1 && type != ancestor) type = types[static_cast<std::size_t>(type)].parent;
  return type == ancestor;
}

bool Definition::is_of_type(int object, int type) const {
  const std::vector<int>& own = objects[static_cast<std::size_t>(object)].types;
  return std::any_of(own.begin(), own.end(), [&](int declared) { return is_subtype(declared, type); });
}

}  // namespace stepwright::pddl

#include "supervisor/pddl/definition/ast.h"

#include <algorithm>

namespace stepwright::pddl {

std::vector<int> Definition::lineage(int type) const {
  std::vector<int> line{type};
  std::vector<bool> met(types.size(), false);
  met[static_cast<std::size_t>(type)] = true;
  for (std::size_t i = 0; i < line.size(); ++i) {
    for (const int parent : types[static_cast<std::size_t>(line[i])].parents) {
      if (!met[static_cast<std::size_t>(parent)]) line.push_back(parent);
      met[static_cast<std::size_t>(parent)] = true;
    }
  }
  return line;
}

bool Definition::is_subtype(int type, int ancestor) const {
  if (type == ancestor) return true;
  const std::vector<int>& own = types[static_cast<std::size_t>(type)].members;
  if (!own.empty()) {
    return std::all_of(own.begin(), own.end(), [&](int member) { return is_subtype(member, ancestor); });
  }
  const std::vector<int>& wanted = types[static_cast<std::size_t>(ancestor)].members;
  if (!wanted.empty()) {
    return std::any_of(wanted.begin(), wanted.end(), [&](int member) { return is_subtype(type, member); });
  }
  const std::vector<int> line = lineage(type);
  return std::find(line.begin(), line.end(), ancestor) != line.end();
}

bool Definition::is_of_type(int object, int type) const {
  const std::vector<int>& own = objects[static_cast<std::size_t>(object)].types;
  return std::any_of(own.begin(), own.end(), [&](int declared) { return is_subtype(declared, type); });
}

}  // namespace stepwright::pddl

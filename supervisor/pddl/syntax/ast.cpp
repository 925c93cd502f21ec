#include "supervisor/pddl/syntax/ast.h"

namespace stepwright::pddl {

bool Definition::is_subtype(int type, int ancestor) const {
  while (type != -1 && type != ancestor) type = types[static_cast<std::size_t>(type)].parent;
  return type == ancestor;
}

}  // namespace stepwright::pddl

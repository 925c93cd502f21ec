#include "hmi_web/access/role.h"

namespace stepwright::access {

const char* to_string(Role role) {
  switch (role) {
    case Role::None:
      return "none";
    case Role::Viewer:
      return "viewer";
    case Role::Operator:
      return "operator";
    case Role::Engineer:
      return "engineer";
    case Role::Administrator:
      return "administrator";
  }
  return "none";
}

std::optional<Role> role_of(std::string_view text) {
  for (const Role role : {Role::Viewer, Role::Operator, Role::Engineer, Role::Administrator}) {
    if (text == to_string(role)) return role;
  }
  return std::nullopt;
}

}  // namespace stepwright::access

#pragma once

// Roles of people. Each role may do what those before it may.
//
//   if (who.role >= Role::Operator) ...
//
// Pure; any thread.

#include <cstdint>
#include <optional>
#include <string_view>

namespace stepwright::access {

enum class Role : std::uint8_t {
  None,           // nobody has logged in
  Viewer,         // looks
  Operator,       // runs plans
  Engineer,       // writes and forces values
  Administrator,  // says who may do what
};

// "none", "viewer", "operator", "engineer", "administrator".
const char* to_string(Role role);
// One that a user can have; nullopt for "none" and for anything else.
std::optional<Role> role_of(std::string_view text);

}  // namespace stepwright::access

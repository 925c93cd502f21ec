#pragma once

// Statement lists that are nothing but assignments: what graphical formats can hold. Internal to this folder.

#include <optional>
#include <string>
#include <vector>

namespace stepwright::exchange {

struct Assignment {
  std::string target;
  std::string expression;
};

// `a := b; c.d := e + f;` as its assignments, or nullopt if the text holds anything else.
std::optional<std::vector<Assignment>> assignments_of(const std::string& st);

}  // namespace stepwright::exchange

#include "supervisor/pddl/definition/state.h"

#include <array>
#include <cctype>
#include <cstdio>

#include "runtime/ground/naming/ascii_names.h"

namespace stepwright::pddl {

std::string canonical_name(std::string_view text) {
  std::string name = "(";
  bool gap = false;
  for (const char c : text) {
    if (c == '(' || c == ')' || std::isspace(static_cast<unsigned char>(c)) != 0) {
      gap = name.size() > 1;
    } else {
      if (gap) name += ' ';
      gap = false;
      name += naming::to_lower(c);
    }
  }
  return name + ")";
}

std::string number_text(double value) {
  std::array<char, 40> buffer{};
  std::snprintf(buffer.data(), buffer.size(), "%.12g", value + 0.0);
  return buffer.data();
}

bool State::holds(std::string_view fact) const {
  return facts_.find(canonical_name(fact)) != facts_.end();
}

void State::set(std::string_view fact, bool value) {
  if (value) {
    facts_.insert(canonical_name(fact));
  } else {
    facts_.erase(canonical_name(fact));
  }
}

std::optional<double> State::value(std::string_view fluent) const {
  const auto found = fluents_.find(canonical_name(fluent));
  if (found == fluents_.end()) return std::nullopt;
  return found->second;
}

void State::assign(std::string_view fluent, double value) {
  fluents_[canonical_name(fluent)] = value;
}

}  // namespace stepwright::pddl

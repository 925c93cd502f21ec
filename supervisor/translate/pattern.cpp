#include "supervisor/translate/pattern.h"

#include <cassert>
#include <cctype>
#include <utility>

#include "runtime/ground/naming/ascii_names.h"

namespace stepwright::translate {

namespace {

bool is_space(char c) {
  return std::isspace(static_cast<unsigned char>(c)) != 0;
}

bool unify(Assignment& assignment, const std::string& variable, const std::string& value) {
  return assignment.emplace(variable, value).first->second == value;
}

}  // namespace

bool is_variable(std::string_view argument) {
  return !argument.empty() && argument.front() == '?';
}

std::optional<Pattern> parse_pattern(std::string_view text) {
  while (!text.empty() && is_space(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_space(text.back())) text.remove_suffix(1);
  if (text.size() < 3 || text.front() != '(' || text.back() != ')') return std::nullopt;
  std::vector<std::string> words(1);
  for (const char c : text.substr(1, text.size() - 2)) {
    if (c == '(' || c == ')') return std::nullopt;
    if (!is_space(c)) {
      words.back() += naming::to_lower(c);
    } else if (!words.back().empty()) {
      words.emplace_back();
    }
  }
  if (words.back().empty()) words.pop_back();
  if (words.empty() || is_variable(words.front())) return std::nullopt;
  for (const std::string& word : words) {
    if (word == "?") return std::nullopt;
  }
  Pattern pattern;
  pattern.name = std::move(words.front());
  pattern.arguments.assign(std::make_move_iterator(words.begin() + 1), std::make_move_iterator(words.end()));
  return pattern;
}

std::string to_string(const Pattern& pattern) {
  return model::to_string(model::GroundAction{pattern.name, pattern.arguments});
}

std::optional<Assignment> match(const Pattern& pattern, const model::GroundAction& action) {
  if (pattern.name != action.name || pattern.arguments.size() != action.arguments.size()) return std::nullopt;
  Assignment assignment;
  for (std::size_t i = 0; i < action.arguments.size(); ++i) {
    const std::string& wanted = pattern.arguments[i];
    const bool fits =
        is_variable(wanted) ? unify(assignment, wanted, action.arguments[i]) : wanted == action.arguments[i];
    if (!fits) return std::nullopt;
  }
  return assignment;
}

std::string instantiate(const Pattern& pattern, const Assignment& assignment) {
  model::GroundAction ground{pattern.name, {}};
  for (const std::string& argument : pattern.arguments) {
    if (!is_variable(argument)) {
      ground.arguments.push_back(argument);
      continue;
    }
    const auto bound = assignment.find(argument);
    assert(bound != assignment.end());
    ground.arguments.push_back(bound->second);
  }
  return model::to_string(ground);
}

bool covers(const Pattern& general, const Pattern& special) {
  // A pattern matches another one as it would match an action, its variables taken as names of their own.
  return match(general, model::GroundAction{special.name, special.arguments}).has_value();
}

}  // namespace stepwright::translate

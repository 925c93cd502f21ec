#include "supervisor/translate/internal/atom_reader.h"

#include <algorithm>
#include <utility>

namespace stepwright::translate::internal {

namespace {

const char* noun(AtomKind kind) {
  switch (kind) {
    case AtomKind::Action:
      return "action";
    case AtomKind::Fact:
      return "predicate";
    case AtomKind::Fluent:
      return "function";
  }
  return "";
}

const std::vector<model::Symbol>& symbols(const model::Vocabulary& vocabulary, AtomKind kind) {
  switch (kind) {
    case AtomKind::Action:
      return vocabulary.actions;
    case AtomKind::Fact:
      return vocabulary.predicates;
    case AtomKind::Fluent:
      break;
  }
  return vocabulary.functions;
}

// True if `pattern` could stand for the ground atom `text`.
bool could_be(const Pattern& pattern, const std::string& text) {
  const auto ground = parse_pattern(text);
  return ground && match(pattern, {ground->name, ground->arguments}).has_value();
}

}  // namespace

std::string suggestion(std::string_view word, const std::vector<std::string>& candidates) {
  const std::string meant = settings::closest(word, candidates);
  if (!meant.empty()) return "did you mean '" + meant + "'?";
  std::string list;
  for (const std::string& candidate : candidates) list += (list.empty() ? "" : ", ") + candidate;
  return list.empty() ? "there are none" : "there are: " + list;
}

void AtomReader::problem(const char* code, const TomlTable& table, std::string_view key, std::string message,
                         std::string hint) {
  problems_.push_back({code, result::Severity::Error, table.where(key), std::move(message), std::move(hint)});
}

std::optional<Pattern> AtomReader::atom(const TomlTable& table, std::string_view key, AtomKind kind,
                                        const Pattern* scope) {
  const std::string text = table.required_text(key);
  if (text.empty()) return std::nullopt;  // told
  return parse(table, key, text, kind, scope);
}

std::optional<Pattern> AtomReader::parse(const TomlTable& table, std::string_view key,
                                         const std::string& text, AtomKind kind, const Pattern* scope) {
  auto pattern = parse_pattern(text);
  if (!pattern) {
    table.report(key, "'" + text + "' is not an atom",
                 "write it as in PDDL, for example \"(lev v1)\" or \"(lev ?v)\"");
    return std::nullopt;
  }
  if (known(table, key, *pattern, kind) && kind != AtomKind::Action) bound(table, key, *pattern, scope);
  return pattern;
}

bool AtomReader::known(const TomlTable& table, std::string_view key, const Pattern& pattern, AtomKind kind) {
  if (vocabulary_ == nullptr) return true;
  std::vector<std::string> names;
  const model::Symbol* symbol = nullptr;
  for (const model::Symbol& candidate : symbols(*vocabulary_, kind)) {
    names.push_back(candidate.name);
    if (candidate.name == pattern.name) symbol = &candidate;
  }
  const std::string what = std::string(noun(kind)) + " '" + pattern.name + "'";
  if (symbol == nullptr) {
    problem("B0007", table, key, "the planning domain has no " + what, suggestion(pattern.name, names));
    return false;
  }
  if (symbol->arity != pattern.arguments.size()) {
    problem("B0007", table, key,
            what + " takes " + std::to_string(symbol->arity) + " arguments, here are " +
                std::to_string(pattern.arguments.size()));
    return false;
  }
  for (const std::string& argument : pattern.arguments) {
    const auto& objects = vocabulary_->objects;
    if (is_variable(argument) || std::find(objects.begin(), objects.end(), argument) != objects.end()) {
      continue;
    }
    problem("B0007", table, key, "the planning problem has no object '" + argument + "'",
            suggestion(argument, objects));
    return false;
  }
  return true;
}

void AtomReader::bound(const TomlTable& table, std::string_view key, const Pattern& pattern,
                       const Pattern* scope) {
  for (const std::string& argument : pattern.arguments) {
    if (!is_variable(argument)) continue;
    if (scope == nullptr) {
      table.report(key, "'" + argument + "' is a variable; a ground atom is needed here",
                   "name the object, for example \"(is-at v1 f1)\"");
      return;
    }
    const auto& variables = scope->arguments;
    if (std::find(variables.begin(), variables.end(), argument) != variables.end()) continue;
    problem("B0007", table, key, "the variable '" + argument + "' is not in " + to_string(*scope),
            suggestion(argument, variables));
    return;
  }
}

std::optional<Pattern> AtomReader::observed(const TomlTable& table, std::string_view key,
                                            const std::string& text, AtomKind kind, const Pattern* scope) {
  const std::size_t problems_before = problems_.size();
  auto pattern = parse(table, key, text, kind, scope);
  if (!pattern || problems_.size() != problems_before) return pattern;
  std::vector<std::string> names;
  for (const Sensor& sensor : binding_.sensors) {
    if (kind == AtomKind::Fluent) names.push_back(sensor.fluent);
  }
  for (const ObservedFact& fact : binding_.facts) {
    if (kind == AtomKind::Fact) names.push_back(fact.fact);
  }
  const auto fits = [&pattern](const std::string& name) { return could_be(*pattern, name); };
  if (std::any_of(names.begin(), names.end(), fits)) return pattern;
  const char* what = kind == AtomKind::Fact ? "no [[facts]] entry observes " : "no sensor measures ";
  problem("B0007", table, key, what + to_string(*pattern), suggestion(text, names));
  return pattern;
}

const Tag* AtomReader::tag(const TomlTable& table, std::string_view key, const std::string& name) {
  if (const Tag* found = binding_.tag(name)) return found;
  std::vector<std::string> names;
  for (const Tag& candidate : binding_.tags) names.push_back(candidate.name);
  problem("B0007", table, key, "there is no tag '" + name + "'", suggestion(name, names));
  return nullptr;
}

const Tag* AtomReader::output(const TomlTable& table, std::string_view key, const std::string& name) {
  const Tag* found = tag(table, key, name);
  if (found == nullptr || (found->output && found->type == "BOOL")) return found;
  table.report(key, "'" + name + "' cannot be driven: it is no BOOL output",
               "its address is " + found->address + " and its type " + found->type);
  return nullptr;
}

}  // namespace stepwright::translate::internal

#include "supervisor/pddl/lifted/lifted_state.h"

#include <cmath>
#include <optional>
#include <sstream>

#include "supervisor/lisp/name_hints.h"
#include "supervisor/pddl/lifted/derive.h"

namespace stepwright::pddl {
namespace {

std::string atom_name(const Definition& definition, const std::vector<Symbol>& table, const Atom& atom) {
  std::string text = "(" + table[static_cast<std::size_t>(atom.symbol)].name;
  for (const int object : atom.arguments) {
    text += " " + definition.objects[static_cast<std::size_t>(object)].name;
  }
  return text + ")";
}

class Lifter {
 public:
  explicit Lifter(const Definition& definition) : definition_(definition) {}

  std::optional<Atom> atom(const std::string& name, bool function) {
    std::istringstream words(name.substr(1, name.size() - 2));
    std::string word;
    words >> word;
    const auto& ids = function ? definition_.function_ids : definition_.predicate_ids;
    const auto found = ids.find(word);
    if (found == ids.end()) {
      fail("P0201", name,
           std::string(function ? "no fluent" : "no predicate") + " '" + word + "' in the domain",
           lisp::did_you_mean(word, lisp::names_of(ids)));
      return std::nullopt;
    }
    Atom atom{found->second, {}};
    while (words >> word) {
      const auto object = definition_.object_ids.find(word);
      if (object == definition_.object_ids.end()) {
        fail("P0202", name, "no object '" + word + "' in the problem",
             lisp::did_you_mean(word, lisp::names_of(definition_.object_ids)));
        return std::nullopt;
      }
      atom.arguments.push_back(object->second);
    }
    const auto& table = function ? definition_.functions : definition_.predicates;
    if (!fits(atom, table[static_cast<std::size_t>(atom.symbol)])) {
      fail("P0202", name, "number or type of the arguments is wrong", {});
      return std::nullopt;
    }
    return atom;
  }

  void value(const std::string& name, double value) {
    if (!std::isfinite(value)) fail("P0203", name, "the value is not a finite number", {});
  }

  result::Diagnostics diagnostics;

 private:
  bool fits(const Atom& atom, const Symbol& symbol) const {
    if (atom.arguments.size() != symbol.parameters.size()) return false;
    for (std::size_t i = 0; i < atom.arguments.size(); ++i) {
      if (!definition_.is_of_type(atom.arguments[i], symbol.parameters[i].type)) return false;
    }
    return true;
  }

  void fail(const char* code, const std::string& name, const std::string& message, std::string hint) {
    result::Diagnostic diagnostic;
    diagnostic.code = code;
    diagnostic.where.file = "state";
    diagnostic.message = name + ": " + message;
    diagnostic.hint = std::move(hint);
    diagnostics.push_back(std::move(diagnostic));
  }

  const Definition& definition_;
};

}  // namespace

LiftedState initial_state(const Definition& definition) {
  return {definition.facts, definition.fluents};
}

result::Result<LiftedState> lift(const Definition& definition, const State& state) {
  Lifter lifter(definition);
  LiftedState lifted;
  for (const std::string& fact : state.facts()) {
    if (auto atom = lifter.atom(fact, false)) lifted.facts.insert(std::move(*atom));
  }
  for (const auto& [fluent, value] : state.fluents()) {
    lifter.value(fluent, value);
    if (auto atom = lifter.atom(fluent, true)) lifted.fluents[std::move(*atom)] = value;
  }
  if (!lifter.diagnostics.empty()) return tl::unexpected<result::Diagnostics>(std::move(lifter.diagnostics));
  derive(definition, lifted);
  return lifted;
}

State name_state(const Definition& definition, const LiftedState& state) {
  State named;
  for (const Atom& fact : state.facts) named.set(fact_name(definition, fact), true);
  for (const auto& [fluent, value] : state.fluents) named.assign(fluent_name(definition, fluent), value);
  return named;
}

std::string fact_name(const Definition& definition, const Atom& atom) {
  return atom_name(definition, definition.predicates, atom);
}

std::string fluent_name(const Definition& definition, const Atom& atom) {
  return atom_name(definition, definition.functions, atom);
}

}  // namespace stepwright::pddl

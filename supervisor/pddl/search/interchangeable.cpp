#include "supervisor/pddl/search/interchangeable.h"

#include <algorithm>
#include <cstring>
#include <map>
#include <optional>
#include <string>
#include <unordered_set>

namespace stepwright::pddl {
namespace {

// Larger tasks take longer than the proof of small ones.
constexpr std::size_t kMostOperators = 3'000, kMostFacts = 2'000;
// So many operators are looked at for all pairs of objects together.
constexpr std::size_t kMostChecks = 20'000;

// What takes the place of every fact and variable.
struct Exchange {
  std::vector<int> facts, variables;
};

// Parts of the task under an exchange as texts: the same text, the same meaning.
class Writer {
 public:
  explicit Writer(const Exchange& exchange) : exchange_(exchange) {}

  std::string text(const GroundOperator& op) const {
    std::string text = this->text(op.precondition);
    std::vector<std::string> effects;
    for (const GroundEffect& effect : op.effects) effects.push_back(this->text(effect));
    append_sorted(effects, text);
    return text;
  }
  std::string text(const GroundAxiom& axiom) const {
    std::string text;
    append(fact(axiom.fact), text);
    append(axiom.layer, text);
    return text + this->text(axiom.body);
  }
  std::string text(const Condition& condition) const {
    std::string text(condition.impossible ? "i" : "c");
    std::vector<int> literals;
    for (const int literal : condition.literals) literals.push_back(2 * fact(literal / 2) + literal % 2);
    append_sorted(literals, text);
    std::vector<std::string> parts;
    for (const Comparison& comparison : condition.comparisons) {
      std::string& part = parts.emplace_back(this->text(comparison.difference));
      append(comparison.relation, part);
    }
    append_sorted(parts, text);
    parts.clear();
    for (const auto& options : condition.choices) {
      std::vector<std::string> ways;
      for (const Condition& option : options) ways.push_back(this->text(option));
      append_sorted(ways, parts.emplace_back());
    }
    append_sorted(parts, text);
    return text;
  }
  std::string text(const GroundExpression& expression) const {
    std::string text;
    std::vector<std::string> terms;
    for (const LinearTerm& term : expression.terms) {
      std::string& part = terms.emplace_back();
      append(variable(term.variable), part);
      append(term.coefficient, part);
    }
    append_sorted(terms, text);
    append(expression.constant, text);
    append(expression.program.size(), text);
    for (const NumericOperation& operation : expression.program) {
      append(operation.kind, text);
      append(operation.constant, text);
      append(operation.variable < 0 ? -1 : variable(operation.variable), text);
    }
    return text;
  }

 private:
  std::string text(const GroundEffect& effect) const {
    std::string text = this->text(effect.when);
    for (const std::vector<int>* list : {&effect.adds, &effect.deletes}) {
      std::vector<int> facts;
      for (const int f : *list) facts.push_back(fact(f));
      append_sorted(facts, text);
    }
    std::vector<std::string> changes;
    for (const NumericEffect& numeric : effect.numeric) {
      std::string& change = changes.emplace_back();
      append(variable(numeric.variable), change);
      append(numeric.kind, change);
      change += this->text(numeric.amount);
    }
    append_sorted(changes, text);
    return text + this->text(effect.cost);
  }

  int fact(int f) const { return exchange_.facts[static_cast<std::size_t>(f)]; }
  int variable(int v) const { return exchange_.variables[static_cast<std::size_t>(v)]; }

  template <typename T>
  static void append(const T& value, std::string& text) {
    char bytes[sizeof(T)];
    std::memcpy(bytes, &value, sizeof(T));
    text.append(bytes, sizeof(T));
  }
  static void append(const std::string& part, std::string& text) {
    append(part.size(), text);
    text += part;
  }
  template <typename T>
  static void append_sorted(std::vector<T>& parts, std::string& text) {
    std::sort(parts.begin(), parts.end());
    append(parts.size(), text);
    for (const T& part : parts) append(part, text);
  }

  const Exchange& exchange_;
};

class Finder {
 public:
  explicit Finder(const GroundTask& task) : task_(task) {
    for (std::size_t f = 0; f < task.facts.size(); ++f) {
      same_.facts.push_back(static_cast<int>(f));
      fact_of_.emplace(task.facts[f], static_cast<int>(f));
    }
    for (std::size_t v = 0; v < task.variables.size(); ++v) {
      same_.variables.push_back(static_cast<int>(v));
      variable_of_.emplace(task.variables[v], static_cast<int>(v));
    }
  }

  std::vector<std::vector<int>> find() {
    if (task_.operators.size() > kMostOperators || task_.facts.size() > kMostFacts) return {};
    const Writer writer(same_);
    for (const GroundOperator& op : task_.operators) operators_.insert(writer.text(op));
    for (const GroundAxiom& axiom : task_.axioms) axioms_.insert(writer.text(axiom));
    std::vector<std::vector<int>> sets;
    for (std::size_t o = 0; o < task_.definition->objects.size(); ++o) {
      const int object = static_cast<int>(o);
      if (mentioned(object)) place(object, sets);
    }
    std::erase_if(sets, [](const auto& set) { return set.size() < 2; });
    return sets;
  }

  // The facts or variables that mention the first object, and what takes their place for another one.
  static std::vector<int> mentions(const std::vector<Atom>& atoms, int object) {
    std::vector<int> list;
    for (std::size_t i = 0; i < atoms.size(); ++i) {
      if (mentions(atoms[i], object)) list.push_back(static_cast<int>(i));
    }
    return list;
  }

  std::optional<Exchange> exchange(int a, int b) const {
    Exchange result;
    if (!exchange(task_.facts, fact_of_, a, b, result.facts)) return std::nullopt;
    if (!exchange(task_.variables, variable_of_, a, b, result.variables)) return std::nullopt;
    return result;
  }

 private:
  static bool mentions(const Atom& atom, int object) {
    return std::find(atom.arguments.begin(), atom.arguments.end(), object) != atom.arguments.end();
  }
  bool mentioned(int object) const {
    const auto by = [&](const Atom& atom) { return mentions(atom, object); };
    return std::any_of(task_.facts.begin(), task_.facts.end(), by) ||
           std::any_of(task_.variables.begin(), task_.variables.end(), by);
  }

  void place(int object, std::vector<std::vector<int>>& sets) {
    for (auto& set : sets) {
      const bool fits = std::all_of(set.begin(), set.end(), [&](int o) { return apart(o, object); });
      if (!fits || !interchangeable(set.front(), object)) continue;
      set.push_back(object);
      return;
    }
    sets.push_back({object});
  }

  // Does nothing mention both?
  bool apart(int a, int b) const {
    const auto both = [&](const Atom& atom) { return mentions(atom, a) && mentions(atom, b); };
    return std::none_of(task_.facts.begin(), task_.facts.end(), both) &&
           std::none_of(task_.variables.begin(), task_.variables.end(), both);
  }

  static bool exchange(const std::vector<Atom>& atoms, const std::map<Atom, int>& index, int a, int b,
                       std::vector<int>& images) {
    for (std::size_t i = 0; i < atoms.size(); ++i) {
      if (!mentions(atoms[i], a) && !mentions(atoms[i], b)) {
        images.push_back(static_cast<int>(i));
        continue;
      }
      Atom image = atoms[i];
      for (int& argument : image.arguments) argument = argument == a ? b : argument == b ? a : argument;
      const auto found = index.find(image);
      if (found == index.end()) return false;
      images.push_back(found->second);
    }
    return true;
  }

  // Each operator must have its counterpart: then every way through the states has one.
  bool interchangeable(int a, int b) {
    const std::optional<Exchange> exchanged = exchange(a, b);
    if (!exchanged) return false;
    const Writer writer(*exchanged), same(same_);
    if (writer.text(task_.goal) != same.text(task_.goal)) return false;
    if (writer.text(task_.potential) != same.text(task_.potential)) return false;
    if (checks_ + task_.operators.size() > kMostChecks) return false;
    for (const GroundOperator& op : task_.operators) {
      ++checks_;
      if (operators_.count(writer.text(op)) == 0) return false;
    }
    return std::all_of(task_.axioms.begin(), task_.axioms.end(),
                       [&](const GroundAxiom& axiom) { return axioms_.count(writer.text(axiom)) != 0; });
  }

  const GroundTask& task_;
  Exchange same_;
  std::map<Atom, int> fact_of_, variable_of_;
  std::unordered_set<std::string> operators_, axioms_;
  std::size_t checks_ = 0;
};

}  // namespace

Interchangeable::Interchangeable(const StateSpace& space) : fact_words_(space.fact_words()) {
  const GroundTask& task = space.task();
  Finder finder(task);
  objects_ = finder.find();
  for (const std::vector<int>& objects : objects_) {
    const std::vector<int> facts = Finder::mentions(task.facts, objects.front());
    const std::vector<int> variables = Finder::mentions(task.variables, objects.front());
    Set& set = sets_.emplace_back();
    for (const int object : objects) {
      const std::optional<Exchange> exchange = finder.exchange(objects.front(), object);
      Mentions& mentions = set.emplace_back();
      for (const int f : facts) mentions.facts.push_back(exchange->facts[static_cast<std::size_t>(f)]);
      for (const int v : variables) {
        mentions.variables.push_back(exchange->variables[static_cast<std::size_t>(v)]);
      }
    }
  }
}

std::vector<std::pair<int, int>> Interchangeable::exchanged_variables() const {
  std::vector<std::pair<int, int>> list;
  for (const Set& set : sets_) {
    for (const Mentions& other : set) {
      for (std::size_t i = 0; i < other.variables.size(); ++i) {
        list.emplace_back(set.front().variables[i], other.variables[i]);
      }
    }
  }
  return list;
}

void Interchangeable::arrange(const Set& set, Word* state) const {
  profiles_.resize(set.size());
  for (std::size_t o = 0; o < set.size(); ++o) {
    std::vector<Word>& profile = profiles_[o];
    profile.assign((set[o].facts.size() + 63) / 64, 0);
    for (std::size_t i = 0; i < set[o].facts.size(); ++i) {
      const int fact = set[o].facts[i];
      profile[i >> 6] |= (state[fact >> 6] >> (fact & 63) & 1) << (i & 63);
    }
    for (const int v : set[o].variables) profile.push_back(state[fact_words_ + static_cast<std::size_t>(v)]);
  }
  if (std::is_sorted(profiles_.begin(), profiles_.end())) return;
  std::sort(profiles_.begin(), profiles_.end());
  for (std::size_t o = 0; o < set.size(); ++o) {
    const std::vector<Word>& profile = profiles_[o];
    for (std::size_t i = 0; i < set[o].facts.size(); ++i) {
      const int fact = set[o].facts[i];
      const Word bit = Word{1} << (fact & 63);
      const bool holds = (profile[i >> 6] >> (i & 63) & 1) != 0;
      state[fact >> 6] = holds ? state[fact >> 6] | bit : state[fact >> 6] & ~bit;
    }
    const std::size_t words = profile.size() - set[o].variables.size();
    for (std::size_t i = 0; i < set[o].variables.size(); ++i) {
      state[fact_words_ + static_cast<std::size_t>(set[o].variables[i])] = profile[words + i];
    }
  }
}

void Interchangeable::arrange(Word* state) const {
  for (const Set& set : sets_) arrange(set, state);
}

}  // namespace stepwright::pddl

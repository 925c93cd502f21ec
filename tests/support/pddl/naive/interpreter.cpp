#include "tests/support/pddl/naive/interpreter.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace stepwright::pddl::testing {
namespace {

const Tree* section(const Tree& tree, const std::string& name) {
  for (const Tree& part : tree.parts) {
    if (part.head() == name) return &part;
  }
  return nullptr;
}

// The part of an action that follows a keyword; an empty list without it.
Tree after(const Tree& action, const std::string& keyword) {
  for (std::size_t i = 0; i + 1 < action.size(); ++i) {
    if (action[i].word == keyword) return action[i + 1];
  }
  return {};
}

std::string object_of(const Tree& term, const std::map<std::string, std::string>& binding) {
  const auto bound = binding.find(term.word);
  return bound == binding.end() ? term.word : bound->second;
}

std::string name_of(const Tree& call, const std::map<std::string, std::string>& binding) {
  if (call.leaf()) return "(" + call.word + ")";
  std::string name = "(" + call.head();
  for (std::size_t i = 1; i < call.size(); ++i) name += " " + object_of(call[i], binding);
  return name + ")";
}

bool is_number(const std::string& word) {
  return !word.empty() && (std::isdigit(static_cast<unsigned char>(word[0])) != 0 ||
                           (word.size() > 1 && (word[0] == '-' || word[0] == '.')));
}

// Decimals, not doubles: nine places count.
double decimal(double value) {
  return std::abs(value) < 1e6 ? std::nearbyint(value * 1e9) / 1e9 + 0.0 : value + 0.0;
}

constexpr double kSame = 5e-10;

}  // namespace

struct Interpreter::Changes {
  std::set<std::string> adds, deletes;
  std::map<std::string, std::vector<std::pair<std::string, double>>> numeric;
  bool undefined = false;
};

Interpreter::Interpreter(const std::string& domain, const std::string& problem) {
  read_domain(read_tree(domain));
  read_problem(read_tree(problem));
}

void Interpreter::add_objects(const std::vector<TypedName>& names) {
  objects_.insert(objects_.end(), names.begin(), names.end());
}

void Interpreter::read_domain(const Tree& domain) {
  if (const Tree* types = section(domain, ":types")) {
    for (const auto& [name, parents] : read_typed(types->parts, 1)) {
      if (name != "object") parents_[name] = parents;
    }
  }
  if (const Tree* constants = section(domain, ":constants")) add_objects(read_typed(constants->parts, 1));
  if (const Tree* functions = section(domain, ":functions")) {
    for (const Tree& function : functions->parts) functions_.insert(function.head());
  }
  if (const Tree* predicates = section(domain, ":predicates")) {
    for (std::size_t i = 1; i < predicates->size(); ++i) {
      predicates_[(*predicates)[i].head()] = read_typed((*predicates)[i].parts, 1);
    }
  }
  for (const Tree& part : domain.parts) {
    if (part.head() == ":action") {
      schemas_[part[1].word] = part;
      order_.push_back(part[1].word);
    }
    if (part.head() == ":derived") {
      axioms_.push_back(part);
      layers_[part[1].head()] = 0;
    }
  }
  // A predicate comes after all that it negates: raised until nothing moves.
  for (std::size_t round = 0; round <= layers_.size(); ++round) {
    for (const Tree& axiom : axioms_) {
      std::size_t& layer = layers_[axiom[1].head()];
      for (const std::string& name : negated_in(axiom[2], false)) layer = std::max(layer, layers_[name] + 1);
      for (const std::string& name : negated_in(axiom[2], true)) layer = std::max(layer, layers_[name]);
    }
  }
}

// The derived predicates that the formula negates; with `negated`, those it does not.
std::set<std::string> Interpreter::negated_in(const Tree& formula, bool negated) const {
  std::set<std::string> names;
  const std::string head = formula.head();
  if (layers_.count(head) != 0 && negated) names.insert(head);
  std::size_t first = head == "forall" || head == "exists" ? 2 : 1;
  for (; first < formula.size(); ++first) {
    const bool flip = head == "not" || (head == "imply" && first == 1);
    names.merge(negated_in(formula[first], negated != flip));
  }
  return names;
}

void Interpreter::read_problem(const Tree& problem) {
  if (const Tree* objects = section(problem, ":objects")) add_objects(read_typed(objects->parts, 1));
  const Tree* init = section(problem, ":init");
  for (std::size_t i = 1; init != nullptr && i < init->size(); ++i) {
    const Tree& element = (*init)[i];
    if (element.head() == "=") {
      initial_.fluents[name_of(element[1], {})] = std::stod(element[2].word);
    } else {
      initial_.facts.insert(name_of(element, {}));
    }
  }
  goal_ = (*section(problem, ":goal"))[1];
  if (const Tree* metric = section(problem, ":metric")) metric_ = (*metric)[2];
}

NaiveState Interpreter::initial() const {
  NaiveState state = initial_;
  derive(state);
  return state;
}

bool Interpreter::fits(const std::string& object, const std::vector<std::string>& types) const {
  std::vector<std::string> open;
  for (const auto& [name, own] : objects_) {
    if (name == object) open = own;
  }
  std::set<std::string> seen;
  while (!open.empty()) {
    const std::string type = open.back();
    open.pop_back();
    if (std::find(types.begin(), types.end(), type) != types.end()) return true;
    const auto above = parents_.find(type);
    if (above != parents_.end() && seen.insert(type).second) {
      open.insert(open.end(), above->second.begin(), above->second.end());
    } else if (type != "object") {
      open.push_back("object");
    }
  }
  return false;
}

void Interpreter::each(const std::vector<TypedName>& variables, Binding binding,
                       const std::function<void(const Binding&)>& visit, std::size_t next) const {
  if (next == variables.size()) return visit(binding);
  for (const auto& [object, types] : objects_) {
    if (!fits(object, variables[next].second)) continue;
    binding[variables[next].first] = object;
    each(variables, binding, visit, next + 1);
  }
}

std::optional<double> Interpreter::value(const Tree& expression, const Binding& binding,
                                         const NaiveState& state) const {
  if (is_number(expression.word)) return std::stod(expression.word);
  const std::string head = expression.head();
  if (std::string("+-*/").find(head) == std::string::npos || head.empty()) {
    const auto found = state.fluents.find(name_of(expression, binding));
    if (found == state.fluents.end()) return std::nullopt;
    return found->second;
  }
  std::optional<double> result = value(expression[1], binding, state);
  if (expression.size() == 2 && result) return -*result;
  for (std::size_t i = 2; i < expression.size(); ++i) {
    const auto operand = value(expression[i], binding, state);
    if (!operand || !result || (head == "/" && *operand == 0.0)) return std::nullopt;
    if (head == "+") result = *result + *operand;
    if (head == "-") result = *result - *operand;
    if (head == "*") result = *result * *operand;
    if (head == "/") result = *result / *operand;
  }
  return result;
}

Interpreter::Truth Interpreter::compare(const Tree& formula, const Binding& binding,
                                        const NaiveState& state) const {
  const auto left = value(formula[1], binding, state);
  const auto right = value(formula[2], binding, state);
  if (!left || !right) return Truth::Undefined;
  const double difference = *left - *right;
  const bool same = std::abs(difference) <= kSame;
  const std::string head = formula.head();
  bool holds = same;
  if (head == "<") holds = !same && difference < 0;
  if (head == "<=") holds = same || difference < 0;
  if (head == ">") holds = !same && difference > 0;
  if (head == ">=") holds = same || difference > 0;
  return holds ? Truth::Yes : Truth::No;
}

Interpreter::Truth Interpreter::truth(const Tree& formula, const Binding& binding,
                                      const NaiveState& state) const {
  const std::string head = formula.head();
  const auto invert = [](Truth t) {
    return t == Truth::Yes ? Truth::No : t == Truth::No ? Truth::Yes : Truth::Undefined;
  };
  if (head.empty()) return Truth::Yes;
  if (head == "not") return invert(truth(formula[1], binding, state));
  if (head == "and" || head == "or") {
    Truth result = head == "and" ? Truth::Yes : Truth::No;
    for (std::size_t i = 1; i < formula.size(); ++i) {
      const Truth part = truth(formula[i], binding, state);
      result = head == "and" ? std::min(result, part) : std::max(result, part);
    }
    return result;
  }
  if (head == "imply") {
    return std::max(invert(truth(formula[1], binding, state)), truth(formula[2], binding, state));
  }
  if (head == "forall" || head == "exists") {
    Truth result = head == "forall" ? Truth::Yes : Truth::No;
    each(read_typed(formula[1].parts, 0), binding, [&](const Binding& inner) {
      const Truth part = truth(formula[2], inner, state);
      result = head == "forall" ? std::min(result, part) : std::max(result, part);
    });
    return result;
  }
  const auto object = [&](const Tree& term) { return term.leaf() && functions_.count(term.word) == 0; };
  if (head == "=" && object(formula[1]) && object(formula[2]) && !is_number(formula[1].word)) {
    return object_of(formula[1], binding) == object_of(formula[2], binding) ? Truth::Yes : Truth::No;
  }
  if (std::string("<>=").find(head[0]) != std::string::npos) return compare(formula, binding, state);
  return state.facts.count(name_of(formula, binding)) != 0 ? Truth::Yes : Truth::No;
}

void Interpreter::collect(const Tree& effect, const Binding& binding, const NaiveState& state,
                          Changes& changes) const {
  const std::string head = effect.head();
  if (head.empty()) return;
  if (head == "and") {
    for (std::size_t i = 1; i < effect.size(); ++i) collect(effect[i], binding, state, changes);
  } else if (head == "when") {
    if (truth(effect[1], binding, state) == Truth::Yes) collect(effect[2], binding, state, changes);
  } else if (head == "forall") {
    each(read_typed(effect[1].parts, 0), binding,
         [&](const Binding& inner) { collect(effect[2], inner, state, changes); });
  } else if (head == "not") {
    changes.deletes.insert(name_of(effect[1], binding));
  } else if (head == "assign" || head == "increase" || head == "decrease" || head == "scale-up" ||
             head == "scale-down") {
    const auto amount = value(effect[2], binding, state);
    if (!amount) changes.undefined = true;
    if (amount) changes.numeric[name_of(effect[1], binding)].emplace_back(head, *amount);
  } else {
    changes.adds.insert(name_of(effect, binding));
  }
}

std::vector<NaiveAction> Interpreter::actions() const {
  std::vector<NaiveAction> list;
  for (const std::string& name : order_) {
    const auto parameters = read_typed(after(schemas_.at(name), ":parameters").parts, 0);
    each(parameters, {}, [&](const Binding& binding) {
      NaiveAction action{name, {}};
      for (const auto& [parameter, types] : parameters) action.arguments.push_back(binding.at(parameter));
      list.push_back(std::move(action));
    });
  }
  return list;
}

std::optional<NaiveState> Interpreter::apply(const NaiveState& state, const NaiveAction& action) const {
  const auto found = schemas_.find(action.name);
  if (found == schemas_.end()) return std::nullopt;
  const auto parameters = read_typed(after(found->second, ":parameters").parts, 0);
  if (parameters.size() != action.arguments.size()) return std::nullopt;
  Binding binding;
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    if (!fits(action.arguments[i], parameters[i].second)) return std::nullopt;
    binding[parameters[i].first] = action.arguments[i];
  }
  if (truth(after(found->second, ":precondition"), binding, state) != Truth::Yes) return std::nullopt;
  Changes changes;
  collect(after(found->second, ":effect"), binding, state, changes);
  if (changes.undefined) return std::nullopt;
  NaiveState next = state;
  for (const auto& [fluent, list] : changes.numeric) {
    const bool known = state.fluents.count(fluent) != 0;
    double value = known ? state.fluents.at(fluent) : 0.0;
    for (const auto& [kind, amount] : list) {
      const bool adds = kind == "increase" || kind == "decrease";
      if ((!adds && list.size() > 1) || (kind != "assign" && !known)) return std::nullopt;
      if (kind == "assign") value = amount;
      if (kind == "increase") value += amount;
      if (kind == "decrease") value -= amount;
      if (kind == "scale-up") value *= amount;
      if (kind == "scale-down") value /= amount;
    }
    if (!std::isfinite(value)) return std::nullopt;
    next.fluents[fluent] = decimal(value);
  }
  for (const std::string& fact : changes.deletes) next.facts.erase(fact);
  next.facts.insert(changes.adds.begin(), changes.adds.end());
  derive(next);
  return next;
}

bool Interpreter::goal(const NaiveState& state) const {
  return truth(goal_, {}, state) == Truth::Yes;
}

std::optional<double> Interpreter::metric(const NaiveState& state) const {
  if (metric_.leaf() || metric_.size() != 0) return value(metric_, {}, state);
  return 0.0;
}

bool Interpreter::derived(const std::string& fact) const {
  return layers_.count(fact.substr(1, fact.find_first_of(" )") - 1)) != 0;
}

void Interpreter::derive(NaiveState& state) const {
  std::erase_if(state.facts, [&](const std::string& fact) { return derived(fact); });
  for (std::size_t layer = 0; layer <= layers_.size(); ++layer) {
    for (bool changed = !axioms_.empty(); changed;) {
      changed = false;
      for (const Tree& axiom : axioms_) {
        if (layers_.at(axiom[1].head()) != layer) continue;
        std::vector<TypedName> parameters = read_typed(axiom[1].parts, 1);
        const std::vector<TypedName>& declared = predicates_.at(axiom[1].head());
        for (std::size_t i = 0; i < parameters.size(); ++i) {
          if (parameters[i].second == std::vector<std::string>{"object"}) {
            parameters[i].second = declared[i].second;
          }
        }
        each(parameters, {}, [&](const Binding& binding) {
          if (truth(axiom[2], binding, state) != Truth::Yes) return;
          std::string fact = "(" + axiom[1].head();
          for (const TypedName& parameter : parameters) fact += " " + binding.at(parameter.first);
          changed = state.facts.insert(fact + ")").second || changed;
        });
      }
    }
  }
}

}  // namespace stepwright::pddl::testing

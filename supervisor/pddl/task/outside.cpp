#include "supervisor/pddl/task/outside.h"

#include <algorithm>
#include <memory>
#include <utility>

#include "supervisor/pddl/definition/ast.h"

namespace stepwright::pddl {

namespace {

constexpr const char* kOutsideCode = "P0119";

class Splitter {
 public:
  Splitter(const Task& task, const std::vector<std::string>& predicates)
      : task_(task),
        names_(predicates.begin(), predicates.end()),
        changed_(std::make_shared<Definition>(task.definition())) {}

  result::Result<OutsideTask> run() {
    for (Action& action : changed_->actions) {
      action_ = &action;
      take(action.precondition, true);
      take(action.effect, true);
    }
    look(changed_->goal);
    for (Axiom& axiom : changed_->axioms) look(axiom.body);
    if (!wrong_.empty()) return tl::unexpected(std::move(wrong_));
    return OutsideTask{Task(changed_, task_.warnings()), std::move(conditions_), std::move(effects_),
                       objects()};
  }

 private:
  std::map<std::string, std::vector<std::vector<std::string>>> objects() const {
    std::map<std::string, std::vector<std::vector<std::string>>> all;
    for (const Symbol& each : changed_->predicates) {
      if (!names_.contains(each.name)) continue;
      auto& parameters = all[each.name];
      for (const Typed& parameter : each.parameters) {
        auto& names = parameters.emplace_back();
        for (const int object : changed_->objects_by_type[static_cast<std::size_t>(parameter.type)])
          names.push_back(changed_->objects[static_cast<std::size_t>(object)].name);
      }
    }
    return all;
  }

  bool is_outside(const Call& call) const { return names_.contains(call.name); }

  void refuse(const Place& at, const std::string& name) {
    const std::string file = at.file < changed_->files.size() ? changed_->files[at.file] : std::string();
    auto refused = result::fail(kOutsideCode, {file, at.line, at.column},
                                "'" + name + "' is judged outside, and cannot be asked or changed here",
                                "in the outermost conjunction of a precondition or an effect, not negated");
    wrong_.insert(wrong_.end(), refused.value().begin(), refused.value().end());
  }

  OutsideAtom atom_of(const Call& call) const {
    OutsideAtom atom{call.name, {}};
    for (const Term& term : call.arguments) {
      OutsideAtom::Argument argument{-1, term.name};
      for (std::size_t k = 0; term.variable && k < action_->parameters.size(); ++k)
        if (action_->parameters[k].slot == term.index) argument = {static_cast<int>(k), {}};
      atom.arguments.push_back(std::move(argument));
    }
    return atom;
  }

  // Nothing of it is outside; what is, is refused.
  void look(const Formula& formula) {
    if (formula.kind == FormulaKind::Atom && is_outside(formula.call))
      refuse(formula.call.at, formula.call.name);
    for (const Formula& part : formula.parts) look(part);
  }
  void look(const Effect& effect) {
    if ((effect.kind == EffectKind::Add || effect.kind == EffectKind::Delete) && is_outside(effect.call))
      refuse(effect.call.at, effect.call.name);
    for (const Formula& condition : effect.condition) look(condition);
    for (const Effect& part : effect.parts) look(part);
  }

  void take(Formula& formula, bool outermost) {
    if (formula.kind == FormulaKind::Atom && outermost && is_outside(formula.call)) {
      conditions_[action_->name].push_back(atom_of(formula.call));
      formula = Formula{};
    } else if (formula.kind == FormulaKind::And && outermost) {
      for (Formula& part : formula.parts) take(part, true);
    } else {
      look(formula);
    }
  }
  void take(Effect& effect, bool outermost) {
    if (effect.kind == EffectKind::Add && outermost && is_outside(effect.call)) {
      effects_[action_->name].push_back(atom_of(effect.call));
      effect = Effect{};
    } else if (effect.kind == EffectKind::And && outermost) {
      for (Effect& part : effect.parts) take(part, true);
    } else {
      look(effect);
    }
  }

  const Task& task_;
  std::set<std::string> names_;
  std::shared_ptr<Definition> changed_;
  const Action* action_ = nullptr;
  std::map<std::string, std::vector<OutsideAtom>> conditions_, effects_;
  result::Diagnostics wrong_;
};

// The beginnings that speak of the same actions, as a tree whose leaves are forbidden.
struct Tree {
  struct Node {
    std::vector<std::pair<model::GroundAction, std::size_t>> next;
    bool forbidden = false;
    int predicate = -1;
  };
  std::string about;
  std::vector<Node> nodes{Node{}};

  void add(const std::vector<model::GroundAction>& actions) {
    std::size_t at = 0;
    for (const model::GroundAction& each : actions) {
      if (nodes[at].forbidden) return;
      const auto known =
          std::ranges::find_if(nodes[at].next, [&](const auto& edge) { return edge.first == each; });
      if (known != nodes[at].next.end()) {
        at = known->second;
        continue;
      }
      nodes[at].next.emplace_back(each, nodes.size());
      at = nodes.size();
      nodes.emplace_back();
    }
    nodes[at].forbidden = true;
    nodes[at].next.clear();
  }
};

Formula fact(const Definition& definition, int predicate) {
  Formula formula;
  formula.kind = FormulaKind::Atom;
  formula.call.name = definition.predicates[static_cast<std::size_t>(predicate)].name;
  formula.call.symbol = predicate;
  return formula;
}

Formula negated(Formula formula) {
  Formula out;
  out.kind = FormulaKind::Not;
  out.parts.push_back(std::move(formula));
  return out;
}

Effect change(const Definition& definition, int predicate, EffectKind kind) {
  Effect effect;
  effect.kind = kind;
  effect.call = fact(definition, predicate).call;
  return effect;
}

class Forbidder {
 public:
  Forbidder(Definition& definition, const CountedActions& counted)
      : definition_(definition), counted_(counted) {}

  void forbid(Tree& tree) {
    for (Tree::Node& node : tree.nodes)
      if (!node.next.empty()) node.predicate = new_predicate();
    if (tree.nodes.front().predicate < 0) return;
    definition_.facts.insert(Atom{tree.nodes.front().predicate, {}});
    for (Action& action : definition_.actions) {
      const auto counts = counted_.find(action.name);
      if (counts == counted_.end() || (!tree.about.empty() && counts->second < 0)) continue;
      for (const Tree::Node& node : tree.nodes)
        if (node.predicate >= 0) step(tree, node, action, counts->second);
    }
  }

 private:
  int new_predicate() {
    const int number = static_cast<int>(definition_.predicates.size());
    Symbol symbol;
    symbol.name = "begun-so-far-" + std::to_string(number);
    symbol.changes = true;
    definition_.predicate_ids.emplace(symbol.name, number);
    definition_.predicates.push_back(std::move(symbol));
    return number;
  }

  Formula is_object(const Action& action, std::size_t parameter, const std::string& object) const {
    const Typed& variable = action.parameters[parameter];
    Formula formula;
    formula.kind = FormulaKind::SameObject;
    formula.terms.resize(2);
    formula.terms[0].name = variable.name;
    formula.terms[0].variable = true;
    formula.terms[0].index = variable.slot;
    formula.terms[1].name = object;
    formula.terms[1].index = definition_.object_ids.at(object);
    return formula;
  }

  static Formula all_of(std::vector<Formula> parts) {
    Formula formula;
    formula.parts = std::move(parts);
    return formula;
  }

  Formula is_action(const Action& action, const model::GroundAction& ground) const {
    std::vector<Formula> parts;
    for (std::size_t k = 0; k < ground.arguments.size(); ++k)
      parts.push_back(is_object(action, k, ground.arguments[k]));
    return all_of(std::move(parts));
  }

  // What the action does to plans that have come to this node.
  void step(const Tree& tree, const Tree::Node& node, Action& action, int about) {
    const auto place_of = [&](std::size_t k) { return tree.nodes[k].predicate; };
    std::vector<Formula> leaves{fact(definition_, node.predicate)};
    if (!tree.about.empty()) leaves.push_back(is_object(action, static_cast<std::size_t>(about), tree.about));
    for (const auto& [ground, next] : node.next) {
      if (ground.name != action.name) continue;
      Formula here = is_action(action, ground);
      leaves.push_back(negated(here));
      Formula both = all_of({fact(definition_, node.predicate), std::move(here)});
      if (tree.nodes[next].forbidden)
        require(action, negated(std::move(both)));
      else
        add(action, std::move(both),
            {change(definition_, node.predicate, EffectKind::Delete),
             change(definition_, place_of(next), EffectKind::Add)});
    }
    add(action, all_of(std::move(leaves)), {change(definition_, node.predicate, EffectKind::Delete)});
  }

  static void require(Action& action, Formula more) {
    action.precondition = all_of({std::move(action.precondition), std::move(more)});
  }

  static void add(Action& action, Formula when, std::vector<Effect> changes) {
    Effect body;
    body.parts = std::move(changes);
    Effect conditional;
    conditional.kind = EffectKind::When;
    conditional.condition.push_back(std::move(when));
    conditional.parts.push_back(std::move(body));
    Effect all;
    all.parts.push_back(std::move(action.effect));
    all.parts.push_back(std::move(conditional));
    action.effect = std::move(all);
  }

  Definition& definition_;
  const CountedActions& counted_;
};

}  // namespace

std::vector<std::string> OutsideAtom::of(const model::GroundAction& action) const {
  std::vector<std::string> names;
  for (const Argument& each : arguments)
    names.push_back(each.parameter < 0 ? each.object
                                       : action.arguments[static_cast<std::size_t>(each.parameter)]);
  return names;
}

result::Result<OutsideTask> split_outside(const Task& task, const std::vector<std::string>& predicates) {
  return Splitter(task, predicates).run();
}

Task without_beginnings(const Task& task, const CountedActions& counted,
                        const std::vector<Beginning>& forbidden) {
  auto changed = std::make_shared<Definition>(task.definition());
  std::vector<Tree> trees;
  for (const Beginning& each : forbidden) {
    auto tree = std::ranges::find_if(trees, [&](const Tree& known) { return known.about == each.about; });
    if (tree == trees.end()) {
      trees.push_back({each.about});
      tree = trees.end() - 1;
    }
    tree->add(each.actions);
  }
  Forbidder forbidder(*changed, counted);
  for (Tree& each : trees) forbidder.forbid(each);
  return Task(std::move(changed), task.warnings());
}

}  // namespace stepwright::pddl

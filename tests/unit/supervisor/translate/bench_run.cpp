#include "bench_run.h"

#include <algorithm>
#include <iterator>
#include <set>
#include <stdexcept>
#include <utility>

namespace stepwright::translate::testing {

namespace {

using model::all_of;
using model::compare;
using model::Comparison;
using model::Condition;
using model::constant;
using model::Expression;
using model::fact;
using model::fluent;

std::string at(const std::string& place) {
  return "(is-at v1 " + place + ")";
}

std::string level(const std::string& distributor) {
  return "(level " + distributor + ")";
}

Expression sum(Expression a, double b) {
  Expression result;
  result.kind = model::ExpressionKind::Sum;
  result.operands = {std::move(a), constant(b)};
  return result;
}

// What an action requires and does, with the names that it touches.
struct Effect {
  Condition precondition;
  std::set<std::string> reads;
  std::set<std::string> writes;
};

void move(const std::vector<std::string>& arguments, model::NamedState& state, Effect& effect) {
  effect.precondition = fact(at(arguments[1]));
  effect.writes = {at(arguments[1]), at(arguments[2])};
  state.facts.erase(at(arguments[1]));
  state.facts.insert(at(arguments[2]));
  state.fluents["(distance-travelled)"] +=
      state.fluents.at("(distance " + arguments[1] + " " + arguments[2] + ")");
}

void load(const std::vector<std::string>& arguments, double amount, model::NamedState& state,
          Effect& effect) {
  effect.precondition = all_of({fact(at(arguments[1])), compare(sum(fluent("(lev v1)"), amount),
                                                                Comparison::LessEqual, constant(10))});
  effect.reads = {at(arguments[1])};
  effect.writes = {"(lev v1)"};
  state.fluents["(lev v1)"] += amount;
}

void unload(const std::vector<std::string>& arguments, double amount, model::NamedState& state,
            Effect& effect) {
  effect.precondition =
      all_of({fact(at(arguments[1])),
              compare(sum(fluent("(lev v1)"), -amount), Comparison::GreaterEqual, constant(2)),
              compare(sum(fluent(level(arguments[1])), amount), Comparison::LessEqual, constant(10))});
  effect.reads = {at(arguments[1])};
  effect.writes = {"(lev v1)", level(arguments[1])};
  state.fluents["(lev v1)"] -= amount;
  state.fluents[level(arguments[1])] += amount;
}

void order(const model::GroundAction& action, double amount, model::NamedState& state, Effect& effect) {
  const std::string received = "(received " + action.arguments[1] + ")";
  const std::string demand = "(demand " + action.arguments[1] + ")";
  const std::string from = level(action.arguments[0]);
  Condition enough = compare(sum(fluent(from), -amount), Comparison::GreaterEqual, constant(2));
  Condition kind = action.name == "complete_order" ? compare(fluent(received), Comparison::Equal, constant(0))
                   : action.name == "final_order"
                       ? compare(fluent(received), Comparison::Greater, constant(0))
                       : compare(constant(amount), Comparison::Less, fluent(demand));
  effect.precondition = all_of({std::move(kind), std::move(enough)});
  effect.writes = {from, received};
  state.fluents[from] -= amount;
  state.fluents[received] += amount;
}

Effect apply(const model::GroundAction& action, model::NamedState& state) {
  Effect effect;
  const double amount =
      action.name == "move" ? 0.0 : state.fluents.at("(amount " + action.arguments.back() + ")");
  if (action.name == "move") move(action.arguments, state, effect);
  if (action.name == "load") load(action.arguments, amount, state, effect);
  if (action.name == "unload") unload(action.arguments, amount, state, effect);
  if (action.name.ends_with("_order")) order(action, amount, state, effect);
  return effect;
}

bool meet(const std::set<std::string>& a, const std::set<std::string>& b) {
  return std::any_of(a.begin(), a.end(), [&b](const std::string& name) { return b.contains(name); });
}

bool depend(const Effect& a, const Effect& b) {
  return meet(a.writes, b.writes) || meet(a.writes, b.reads) || meet(a.reads, b.writes);
}

}  // namespace

model::NamedState bench_start() {
  model::NamedState state;
  state.facts = {at("f1"), "(serves a1 c1)", "(serves a2 c2)"};
  state.fluents = {{"(lev v1)", 2},         {"(level a1)", 2},           {"(level a2)", 2},
                   {"(received c1)", 0},    {"(received c2)", 0},        {"(demand c1)", 7},
                   {"(demand c2)", 10},     {"(distance-travelled)", 0}, {"(distance f1 a1)", 1},
                   {"(distance a1 f1)", 1}, {"(distance f1 a2)", 1},     {"(distance a2 f1)", 1},
                   {"(distance a1 a2)", 2}, {"(distance a2 a1)", 2}};
  for (int i = 1; i <= 10; ++i) state.fluents["(amount level" + std::to_string(i) + ")"] = i;
  return state;
}

model::Vocabulary bench_vocabulary() {
  model::Vocabulary vocabulary;
  vocabulary.actions = {{"load", 3},           {"move", 3},          {"unload", 3},
                        {"complete_order", 3}, {"partial_order", 3}, {"final_order", 3}};
  vocabulary.predicates = {{"is-at", 2}, {"serves", 2}};
  vocabulary.functions = {{"lev", 1},
                          {"level", 1},
                          {"amount", 1},
                          {"distance", 2},
                          {"demand", 1},
                          {"received", 1},
                          {"distance-travelled", 0}};
  vocabulary.objects = {"v1", "f1", "a1", "a2", "c1", "c2"};
  for (int i = 1; i <= 10; ++i) vocabulary.objects.push_back("level" + std::to_string(i));
  return vocabulary;
}

model::PlannedRun bench_run(const std::vector<std::string>& plan, model::NamedState start) {
  model::PlannedRun run;
  run.initial = start;
  run.orderings.emplace();
  std::vector<Effect> effects;
  for (const std::string& text : plan) {
    const auto atom = parse_pattern(text);
    if (!atom) throw std::invalid_argument(text);
    model::PlannedAction planned;
    planned.action = {atom->name, atom->arguments};
    planned.before = start;
    Effect effect = apply(planned.action, start);
    planned.precondition = effect.precondition;
    planned.after = start;
    for (std::size_t i = 0; i < effects.size(); ++i) {
      if (depend(effects[i], effect)) run.orderings->push_back({i, effects.size()});
    }
    effects.push_back(std::move(effect));
    run.actions.push_back(std::move(planned));
  }
  return run;
}

std::vector<std::string> metric_ff_plan() {
  return {"(load v1 f1 level8)",
          "(move v1 f1 a1)",
          "(unload v1 a1 level8)",
          "(move v1 a1 f1)",
          "(load v1 f1 level8)",
          "(move v1 f1 a2)",
          "(unload v1 a2 level8)",
          "(move v1 a2 f1)",
          "(complete_order a1 c1 level7)",
          "(load v1 f1 level2)",
          "(move v1 f1 a1)",
          "(unload v1 a1 level2)",
          "(move v1 a1 f1)",
          "(partial_order a2 c2 level8)",
          "(load v1 f1 level5)",
          "(move v1 f1 a2)",
          "(unload v1 a2 level5)",
          "(move v1 a2 f1)",
          "(final_order a2 c2 level2)"};
}

Binding bench_binding() {
  const model::Vocabulary vocabulary = bench_vocabulary();
  auto binding = load_binding(STEPWRIGHT_SOURCE_DIR "/tests/cells/bench/binding.toml", &vocabulary);
  if (!binding) throw std::runtime_error(to_string(binding.error()));
  return std::move(*binding);
}

}  // namespace stepwright::translate::testing

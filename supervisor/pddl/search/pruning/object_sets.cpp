#include "supervisor/pddl/search/pruning/object_sets.h"

#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <unordered_map>
#include <unordered_set>

#include "supervisor/pddl/search/pruning/object_mentions.h"

namespace stepwright::pddl {
namespace {

// What is parted by more hardly ever becomes alike, and it would be asked of every state.
constexpr std::size_t kMostNeeds = 8;
// Where most objects are alike each operator is looked at once or twice for each object that it mentions.
constexpr std::size_t kLeastChecks = 1'000, kChecksPerOperator = 16;

using Objects = std::vector<int>;

bool contains(const Objects& list, int object) {
  return std::find(list.begin(), list.end(), object) != list.end();
}

class Finder {
 public:
  Finder(const GroundTask& task, ValueOrder& order, const SetLimits& limits)
      : task_(task),
        order_(order),
        checks_left_(std::min(limits.checks, kLeastChecks + kChecksPerOperator * task.operators.size())),
        mentions_(task) {
    for (std::size_t f = 0; f < task.facts.size(); ++f) {
      same_.facts.push_back(static_cast<int>(f));
      fact_of_.emplace(task.facts[f], static_cast<int>(f));
    }
    for (std::size_t v = 0; v < task.variables.size(); ++v) {
      same_.variables.push_back(static_cast<int>(v));
      variable_of_.emplace(task.variables[v], static_cast<int>(v));
    }
  }

  std::vector<ExchangeSet> find() {
    const ExchangeText same(same_);
    for (const GroundOperator& op : task_.operators) operators_.insert(same.text(op));
    for (const GroundAxiom& axiom : task_.axioms) axioms_.insert(same.text(axiom));
    std::vector<Objects> alike, equal;
    for (std::size_t o = 0; o < task_.definition->objects.size(); ++o) {
      const int object = static_cast<int>(o);
      if (mentions_.facts(object).empty() && mentions_.variables(object).empty()) continue;
      place(object, equal, [&](int front) { return equals(front, object); });
      place(object, alike, [&](int front) { return compared(front, object).has_value(); });
    }
    std::vector<ExchangeSet> sets;
    for (const Objects& objects : equal) {
      if (objects.size() > 1) sets.push_back(set_of(objects));
    }
    for (const Objects& objects : alike) {
      if (objects.size() < 2 || std::find(equal.begin(), equal.end(), objects) != equal.end()) continue;
      if (auto set = parted_set(objects)) sets.push_back(std::move(*set));
    }
    return sets;
  }

 private:
  // Into the first set that it fits into, or one of its own.
  template <typename Fits>
  void place(int object, std::vector<Objects>& sets, const Fits& fits) {
    for (Objects& set : sets) {
      const bool apart =
          std::all_of(set.begin(), set.end(), [&](int o) { return mentions_.apart(o, object); });
      if (!apart || !fits(set.front())) continue;
      set.push_back(object);
      return;
    }
    sets.push_back({object});
  }

  bool exchange(const std::vector<Atom>& atoms, const std::map<Atom, int>& index, int a, int b,
                const std::vector<int>& list, std::vector<int>& images) const {
    for (const int i : list) {
      Atom image = atoms[static_cast<std::size_t>(i)];
      for (int& argument : image.arguments) argument = argument == a ? b : argument == b ? a : argument;
      const auto found = index.find(image);
      if (found == index.end()) return false;
      images[static_cast<std::size_t>(i)] = found->second;
    }
    return true;
  }

  // Nothing if a fact or fluent has no counterpart, or if goal, metric or axioms tell them apart.
  std::optional<Exchange> exchange(int a, int b) const {
    Exchange result = same_;
    for (const int object : {a, b}) {
      if (!exchange(task_.facts, fact_of_, a, b, mentions_.facts(object), result.facts) ||
          !exchange(task_.variables, variable_of_, a, b, mentions_.variables(object), result.variables))
        return std::nullopt;
    }
    const ExchangeText exchanged(result), same(same_);
    if (exchanged.text(task_.goal) != same.text(task_.goal) ||
        exchanged.text(task_.potential) != same.text(task_.potential))
      return std::nullopt;
    const bool axioms = std::all_of(task_.axioms.begin(), task_.axioms.end(), [&](const GroundAxiom& axiom) {
      return axioms_.count(exchanged.text(axiom)) != 0;
    });
    return axioms ? std::optional(std::move(result)) : std::nullopt;
  }

  // Facts take far less time than operators.
  std::optional<Exchange> compared(int a, int b) {
    if (mentions_.pattern(a) != mentions_.pattern(b) || !affords(1 + mentions_.facts(a).size() / 4))
      return std::nullopt;
    return exchange(a, b);
  }

  // Each operator must have its counterpart: then every way through the states has one.
  bool equals(int a, int b) {
    if (mentions_.operators(a).size() != mentions_.operators(b).size()) return false;
    const std::optional<Exchange> exchanged = compared(a, b);
    if (!exchanged) return false;
    const ExchangeText text(*exchanged);
    for (const int object : {a, b}) {
      if (!affords(mentions_.operators(object).size())) return false;
      for (const int op : mentions_.operators(object)) {
        if (operators_.count(text.text(task_.operators[static_cast<std::size_t>(op)])) == 0) return false;
      }
    }
    return true;
  }

  bool affords(std::size_t checks) {
    if (checks > checks_left_) return false;
    checks_left_ -= checks;
    return true;
  }

  ExchangeSet set_of(const Objects& objects) const {
    ExchangeSet set;
    for (const int object : objects) {
      const std::optional<Exchange> exchanged = exchange(objects.front(), object);
      ExchangeMember& member = set.members.emplace_back();
      member.object = object;
      for (const int f : mentions_.facts(objects.front()))
        member.facts.push_back(exchanged->facts[static_cast<std::size_t>(f)]);
      for (const int v : mentions_.variables(objects.front()))
        member.variables.push_back(exchanged->variables[static_cast<std::size_t>(v)]);
    }
    set.first_is_enough = std::none_of(objects.begin(), objects.end(), [&](int object) {
      return mentions_.by_goal(object) || mentions_.by_axiom(object) || meets_another(object, objects);
    });
    return set;
  }

  // Does an operator mention it together with another one of the set?
  bool meets_another(int object, const Objects& objects) const {
    const auto& list = mentions_.operators(object);
    return std::any_of(list.begin(), list.end(), [&](int op) { return mentions_two(op, objects); });
  }
  bool mentions_two(int op, const Objects& objects) const {
    const auto& list = mentions_.objects(op);
    return std::count_if(list.begin(), list.end(), [&](int o) { return contains(objects, o); }) > 1;
  }

  // Operators that mention one of the objects and have a counterpart for every other one tell nothing apart;
  // for all others there must be an end.
  std::optional<ExchangeSet> parted_set(const Objects& objects) {
    std::unordered_map<std::string, std::size_t> counterparts;  // by what an operator says of the first one
    std::vector<std::vector<std::string>> texts(objects.size());
    for (std::size_t i = 0; i < objects.size(); ++i) {
      const auto& list = mentions_.operators(objects[i]);
      const std::optional<Exchange> exchanged = exchange(objects.front(), objects[i]);
      if (!exchanged || !affords(list.size())) return std::nullopt;
      const ExchangeText text(*exchanged);
      std::unordered_set<std::string> seen;
      for (const int op : list) {
        std::string& said = texts[i].emplace_back();
        if (mentions_two(op, objects)) continue;
        said = text.text(task_.operators[static_cast<std::size_t>(op)]);
        if (seen.insert(said).second) ++counterparts[said];
      }
    }
    ExchangeSet whole = set_of(objects), set;
    bool parted = false;
    for (std::size_t i = 0; i < objects.size(); ++i) {
      const auto& list = mentions_.operators(objects[i]);
      ExchangeMember& member = whole.members[i];
      bool ends = true;
      for (std::size_t k = 0; k < list.size() && ends; ++k) {
        if (!texts[i][k].empty() && counterparts[texts[i][k]] == objects.size()) continue;
        const std::optional<VariableValue> need = parting_need(list[k], objects);
        ends = need.has_value();
        if (need) member.parted_by.push_back(*need);
      }
      if (!ends) continue;
      std::sort(member.parted_by.begin(), member.parted_by.end());
      member.parted_by.erase(std::unique(member.parted_by.begin(), member.parted_by.end()),
                             member.parted_by.end());
      if (member.parted_by.size() > kMostNeeds) continue;
      parted = parted || !member.parted_by.empty();
      set.members.push_back(std::move(member));
    }
    if (!parted || set.members.size() < 2) return std::nullopt;
    set.first_is_enough = std::none_of(objects.begin(), objects.end(), [&](int object) {
      return mentions_.by_goal(object) || mentions_.by_axiom(object);
    });
    return set;
  }

  // Rather one that is about the objects themselves: others may pass late.
  std::optional<VariableValue> parting_need(int op, const Objects& objects) {
    const auto needs = order_.passing_needs(task_.operators[static_cast<std::size_t>(op)]);
    const auto about = std::find_if(needs.begin(), needs.end(), [&](const VariableValue& need) {
      const int fact = order_.fact_of(need);
      if (fact < 0) return false;
      const Objects& arguments = task_.facts[static_cast<std::size_t>(fact)].arguments;
      return std::any_of(arguments.begin(), arguments.end(), [&](int o) { return contains(objects, o); });
    });
    if (about != needs.end()) return *about;
    return needs.empty() ? std::nullopt : std::optional(needs.front());
  }

  const GroundTask& task_;
  ValueOrder& order_;
  std::size_t checks_left_;
  const ObjectMentions mentions_;
  Exchange same_;
  std::map<Atom, int> fact_of_, variable_of_;
  std::unordered_set<std::string> operators_, axioms_;
};

}  // namespace

std::vector<ExchangeSet> find_exchange_sets(const StateSpace& space, ValueOrder& order,
                                            const SetLimits& limits) {
  const GroundTask& task = space.task();
  if (task.operators.size() > limits.operators || task.facts.size() > limits.facts) return {};
  return Finder(task, order, limits).find();
}

}  // namespace stepwright::pddl

#include "supervisor/pddl/plan/partial_order.h"

#include <algorithm>
#include <functional>
#include <iterator>
#include <optional>
#include <set>
#include <string>
#include <unordered_map>
#include <vector>

#include "supervisor/pddl/action/ground_action.h"

namespace stepwright::pddl {
namespace {

// Facts and fluents as numbers, ascending.
struct Footprint {
  std::vector<int> reads, writes, counts;
};

// Numbers names in the order in which they come.
class Names {
 public:
  std::vector<int> numbers(const std::set<std::string>& names) {
    std::vector<int> list;
    for (const std::string& name : names) {
      list.push_back(numbers_.try_emplace(name, static_cast<int>(numbers_.size())).first->second);
    }
    std::sort(list.begin(), list.end());
    return list;
  }
  std::size_t count() const { return numbers_.size(); }

 private:
  std::unordered_map<std::string, int> numbers_;
};

// Of each action once: a long plan applies the same ones again and again.
class Footprints {
 public:
  Footprints(const Task& task, std::function<bool()> stop) : inspector_(task, std::move(stop)) {}

  result::Result<const Footprint*> of(const model::GroundAction& action) {
    const auto [entry, added] = known_.try_emplace(model::to_string(action));
    if (!added) return &entry->second;
    auto info = inspector_.inspect(action);
    if (!info) return result::forward(info);
    entry->second = {names_.numbers(info->reads), names_.numbers(info->writes), names_.numbers(info->counts)};
    return &entry->second;
  }
  std::size_t names() const { return names_.count(); }

 private:
  ActionInspector inspector_;
  Names names_;
  std::unordered_map<std::string, Footprint> known_;  // pointers to its values stay valid
};

bool has(const std::vector<int>& list, int name) {
  return std::binary_search(list.begin(), list.end(), name);
}

// Who has used a fact or fluent so far. Two uses interfere if one of them writes, unless both only count.
class Uses {
 public:
  // Adds the earlier actions to which `action` must be ordered, but for those that come before another one of
  // them; `action` is the last use from now on.
  void use(std::size_t action, bool reads, bool writes, bool counts, std::vector<std::size_t>& earlier) {
    if (barrier_) earlier.push_back(*barrier_);
    const bool plain = writes && !counts;
    if (reads || plain) earlier.insert(earlier.end(), counted_.begin(), counted_.end());
    if (writes) earlier.insert(earlier.end(), readers_.begin(), readers_.end());
    if (plain || (reads && writes)) {
      barrier_ = action;  // behind all uses before it, before all that follow
      counted_.clear();
      readers_.clear();
    } else {
      (writes ? counted_ : readers_).push_back(action);
    }
  }

 private:
  std::optional<std::size_t> barrier_;
  std::vector<std::size_t> counted_, readers_;  // since then
};

// The direct predecessors of each action, ascending actions first.
class Reduction {
 public:
  explicit Reduction(std::size_t count) : predecessors_(count), seen_(count, count) {}

  // Of these earlier actions those that come before no other one of them.
  const std::vector<std::size_t>& add(std::size_t action, std::vector<std::size_t>& earlier) {
    std::sort(earlier.begin(), earlier.end(), std::greater<>());
    earlier.erase(std::unique(earlier.begin(), earlier.end()), earlier.end());
    for (const std::size_t before : earlier) {
      if (seen_[before] == action) continue;
      predecessors_[action].push_back(before);
      if (before != earlier.back()) mark(action, before, earlier.back());
    }
    return predecessors_[action];
  }

 private:
  // All that comes before `from`, back to `first`.
  void mark(std::size_t action, std::size_t from, std::size_t first) {
    open_.assign(1, from);
    while (!open_.empty()) {
      const std::size_t at = open_.back();
      open_.pop_back();
      for (const std::size_t before : predecessors_[at]) {
        if (before < first || seen_[before] == action) continue;
        seen_[before] = action;
        open_.push_back(before);
      }
    }
  }

  std::vector<std::vector<std::size_t>> predecessors_;
  std::vector<std::size_t> seen_;  // the last action before which each was found to come
  std::vector<std::size_t> open_;
};

}  // namespace

result::Result<std::vector<model::Ordering>> lift_partial_order(const Task& task, const model::Plan& plan,
                                                                std::function<bool()> stop) {
  const std::size_t count = plan.actions.size();
  Footprints prints(task, std::move(stop));
  std::vector<const Footprint*> steps;
  for (const model::GroundAction& action : plan.actions) {
    auto print = prints.of(action);
    if (!print) return result::forward(print);
    steps.push_back(*print);
  }
  Reduction reduction(count);
  std::vector<Uses> uses(prints.names());
  std::vector<model::Ordering> orderings;
  std::vector<std::size_t> earlier;
  for (std::size_t j = 0; j < count; ++j) {
    const Footprint& print = *steps[j];
    std::vector<int> used;
    std::set_union(print.reads.begin(), print.reads.end(), print.writes.begin(), print.writes.end(),
                   std::back_inserter(used));
    earlier.clear();
    for (const int name : used) {
      uses[static_cast<std::size_t>(name)].use(j, has(print.reads, name), has(print.writes, name),
                                               has(print.counts, name), earlier);
    }
    for (const std::size_t i : reduction.add(j, earlier)) orderings.push_back({i, j});
  }
  std::sort(orderings.begin(), orderings.end(), [](const model::Ordering& a, const model::Ordering& b) {
    return a.before != b.before ? a.before < b.before : a.after < b.after;
  });
  return orderings;
}

}  // namespace stepwright::pddl

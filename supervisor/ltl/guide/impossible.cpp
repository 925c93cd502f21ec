#include "supervisor/ltl/guide/impossible.h"

#include <algorithm>
#include <utility>

namespace stepwright::ltl {

namespace {

constexpr std::size_t kMostParts = 40;
constexpr std::size_t kTextWidth = 200;

// What a point reaches that keeps to the task, and what it may not enter.
struct Reach {
  Label reached = 0;
  Label refused = 0;  // of regions that would break the task
};

Reach explore(const RegionMap& map, const Automaton& automaton, const Guide& guide, std::uint32_t start) {
  Reach reach;
  std::vector<bool> seen(map.regions().size() * automaton.size(), false);
  std::vector<Stage> open;
  const auto visit = [&](std::uint32_t region, std::uint32_t state) {
    if (automaton.rejecting(state)) {
      reach.refused |= map.region(region).label;
      return;
    }
    const std::size_t node = static_cast<std::size_t>(region) * automaton.size() + state;
    if (seen[node]) return;
    seen[node] = true;
    reach.reached |= map.region(region).label;
    open.push_back({region, state});
  };
  visit(start, guide.start(start));
  while (!open.empty()) {
    const Stage at = open.back();
    open.pop_back();
    for (const std::uint32_t next : map.region(at.region).across)
      if (next != kNoRegion) visit(next, guide.after(at.state, at.region, next));
  }
  return reach;
}

// All that hangs together with the start, whatever the task says.
Label within_reach(const RegionMap& map, std::uint32_t start) {
  std::vector<bool> seen(map.regions().size(), false);
  std::vector<std::uint32_t> open = {start};
  seen[start] = true;
  Label reached = 0;
  while (!open.empty()) {
    const Region& region = map.region(open.back());
    open.pop_back();
    reached |= region.label;
    for (const std::uint32_t next : region.across) {
      if (next == kNoRegion || seen[next]) continue;
      seen[next] = true;
      open.push_back(next);
    }
  }
  return reached;
}

std::string names(Label label, const std::vector<std::string>& places) {
  std::string text;
  for (std::size_t k = 0; k < places.size(); ++k)
    if ((label >> k & 1) != 0) text += (text.empty() ? "'" : ", '") + places[k] + "'";
  return text;
}

Label mentioned(const Formula& formula, SyntaxId part) {
  Label label = 0;
  std::vector<SyntaxId> open = {part};
  while (!open.empty()) {
    const SyntaxNode& node = formula.tree.nodes[open.back()];
    open.pop_back();
    if (node.op == Operator::Name) label |= Label{1} << node.proposition;
    open.insert(open.end(), node.children.begin(), node.children.end());
  }
  return label;
}

class Search {
 public:
  Search(const RegionMap& map, const Task& task, const std::vector<std::string>& places, std::uint32_t start)
      : map_(map), task_(task), formula_(task.formula), places_(places), start_(start) {}

  Impossible blame(const Automaton& whole) {
    std::vector<SyntaxId> parts = conjuncts(formula_.tree);
    if (parts.size() > kMostParts) return answer({formula_.tree.root}, whole);
    for (const SyntaxId part : parts)
      if (auto alone = impossible({part})) return answer({part}, *alone);
    // Each part that the rest fails without is left out; what remains fails for each of its parts.
    Automaton blamed = whole;
    for (std::size_t k = 0; k < parts.size() && parts.size() > 1;) {
      std::vector<SyntaxId> fewer = parts;
      fewer.erase(fewer.begin() + static_cast<std::ptrdiff_t>(k));
      if (auto still = impossible(fewer)) {
        parts = std::move(fewer);
        blamed = *std::move(still);
      } else {
        ++k;
      }
    }
    return answer(parts, blamed);
  }

 private:
  // The automaton of these parts, if they cannot be done; also nothing where it would be too large.
  std::optional<Automaton> impossible(const std::vector<SyntaxId>& parts) {
    Formula some = formula_;
    std::vector<Term> terms;
    for (const SyntaxId part : parts) terms.push_back(some.positive[part]);
    some.root = some.terms.conjunction(std::move(terms));
    auto automaton = task_automaton(some);
    if (!automaton) return std::nullopt;
    begin_behind(task_.read, *automaton);
    const Guide guide(map_, *automaton);
    if (guide.to_go_m(start_, guide.start(start_)) < Guide::kNever) return std::nullopt;
    return *std::move(automaton);
  }

  Impossible answer(const std::vector<SyntaxId>& parts, const Automaton& automaton) const {
    Impossible found;
    Label wanted = 0;
    for (const SyntaxId part : parts) {
      found.parts.push_back({to_text(formula_.tree, part, kTextWidth), formula_.tree.nodes[part].at});
      wanted |= mentioned(formula_, part);
    }
    found.reason = reason(automaton, wanted);
    return found;
  }

  std::string reason(const Automaton& automaton, Label wanted) const {
    const Guide guide(map_, automaton);
    const Label here = map_.region(start_).label;
    if (automaton.rejecting(guide.start(start_)))
      return here == 0 ? "it fails where the way begins" : "the start is in " + names(here, places_);
    const Label apart = wanted & ~within_reach(map_, start_);
    if (apart != 0) return "no way leads to " + names(apart, places_);
    const Reach reach = explore(map_, automaton, guide, start_);
    if (reach.refused != 0) {
      const Label missed = wanted & ~reach.reached & ~reach.refused;
      const std::string through = "every way leads through " + names(reach.refused, places_);
      return missed != 0 ? through + " to " + names(missed, places_) : through;
    }
    return "no order of the places does it";
  }

  const RegionMap& map_;
  const Task& task_;
  const Formula& formula_;
  const std::vector<std::string>& places_;
  std::uint32_t start_;
};

}  // namespace

std::optional<Impossible> why_impossible(const RegionMap& map, const Task& task,
                                         const std::vector<std::string>& places, std::uint32_t start) {
  const Guide guide(map, task.automaton);
  if (guide.to_go_m(start, guide.start(start)) < Guide::kNever) return std::nullopt;
  return Search(map, task, places, start).blame(task.automaton);
}

}  // namespace stepwright::ltl

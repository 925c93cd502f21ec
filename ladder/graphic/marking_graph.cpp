#include "ladder/graphic/marking_graph.h"

#include <algorithm>
#include <iterator>
#include <limits>
#include <unordered_map>
#include <utility>

namespace stepwright::graphic {
namespace {

constexpr std::size_t kBits = 64;
constexpr std::size_t kCombinations = 10'000;  // of circles that are tried in one situation

void put(PlaceSet& set, std::size_t place) {
  set[place / kBits] |= std::uint64_t{1} << (place % kBits);
}

void take(PlaceSet& set, std::size_t place) {
  set[place / kBits] &= ~(std::uint64_t{1} << (place % kBits));
}

struct Hash {
  std::size_t operator()(const PlaceSet& set) const {
    std::uint64_t hash = 0x9E3779B97F4A7C15U;
    for (const std::uint64_t word : set) {
      hash = (hash ^ word) * 0xFF51AFD7ED558CCDU;
      hash ^= hash >> 32;
    }
    return static_cast<std::size_t>(hash);
  }
};

class Explorer {
 public:
  Explorer(const TokenNet& net, std::size_t limit) : net_(net), limit_(limit), leaving_(net.places) {
    for (std::uint32_t t = 0; t < net.transitions.size(); ++t) {
      // Under its first source: an active step finds the transitions worth testing.
      leaving_[net.transitions[t].sources.front()].push_back(t);
    }
  }

  MarkingGraph run() {
    PlaceSet initial((net_.places + kBits - 1) / kBits, 0);
    for (const std::uint32_t place : net_.marked) put(initial, place);
    find_or_add(std::move(initial), 0, {});
    overrun_.assign(net_.places, false);
    for (std::uint32_t i = 0; i < graph_.markings.size() && graph_.complete; ++i) expand(i);
    return std::move(graph_);
  }

 private:
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

  std::uint32_t find_or_add(PlaceSet marking, std::uint32_t parent, std::vector<std::uint32_t> by) {
    const auto known = index_.find(marking);
    if (known != index_.end()) return known->second;
    if (graph_.markings.size() >= limit_) {
      graph_.complete = false;
      return kNone;
    }
    const auto number = static_cast<std::uint32_t>(graph_.markings.size());
    index_.emplace(marking, number);
    graph_.markings.push_back(std::move(marking));
    graph_.edges.emplace_back();
    graph_.parent.push_back(parent);
    graph_.by.push_back(std::move(by));
    return number;
  }

  void expand(std::uint32_t from) {
    std::vector<std::uint32_t> entering;  // enabled transitions that lead to a full place
    for (std::size_t word = 0; word < graph_.markings[from].size(); ++word) {
      for (std::uint64_t bits = graph_.markings[from][word]; bits != 0; bits &= bits - 1) {
        const std::size_t place = word * kBits + static_cast<std::size_t>(__builtin_ctzll(bits));
        for (const std::uint32_t t : leaving_[place])
          if (fire(from, t)) entering.push_back(t);
      }
    }
    if (entering.size() > 1) circles(from, std::move(entering));
  }

  // True if it leads to a full place.
  bool fire(std::uint32_t from, std::uint32_t t) {
    const NetTransition& transition = net_.transitions[t];
    for (const std::uint32_t source : transition.sources) {
      if (!contains(graph_.markings[from], source)) return false;
    }
    PlaceSet next = graph_.markings[from];
    for (const std::uint32_t source : transition.sources) take(next, source);
    MarkingEdge edge{t, 0, false};
    for (const std::uint32_t target : transition.targets) {
      if (contains(next, target)) {
        edge.overrun = true;
        if (!overrun_[target]) graph_.overruns.push_back({from, t, target});
        overrun_[target] = true;
      }
      put(next, target);
    }
    edge.to = find_or_add(std::move(next), from, {t});
    if (edge.to != kNone) graph_.edges[from].push_back(edge);
    return edge.overrun;
  }

  static bool meet(const std::vector<std::uint32_t>& a, const std::vector<std::uint32_t>& b) {
    return std::any_of(a.begin(), a.end(),
                       [&](std::uint32_t each) { return std::binary_search(b.begin(), b.end(), each); });
  }

  // Fires all that may be a circle together, in every combination. What no other one feeds, or what feeds no
  // other one, is in none.
  void circles(std::uint32_t from, std::vector<std::uint32_t> some) {
    for (std::size_t before = 0; before != some.size();) {
      before = some.size();
      const auto is_in_none = [&](std::uint32_t t) {
        bool feeds = false;
        bool is_fed = false;
        for (const std::uint32_t other : some) {
          if (other == t) continue;
          feeds = feeds || meet(net_.transitions[t].targets, net_.transitions[other].sources);
          is_fed = is_fed || meet(net_.transitions[other].targets, net_.transitions[t].sources);
        }
        return !feeds || !is_fed;
      };
      std::vector<std::uint32_t> left;
      std::remove_copy_if(some.begin(), some.end(), std::back_inserter(left), is_in_none);
      some = std::move(left);
    }
    std::size_t budget = kCombinations;
    std::vector<std::uint32_t> chosen;
    combine(from, some, 0, chosen, budget);
  }

  void combine(std::uint32_t from, const std::vector<std::uint32_t>& some, std::size_t next,
               std::vector<std::uint32_t>& chosen, std::size_t& budget) {
    if (next == some.size()) {
      if (chosen.size() > 1) fire_together(from, chosen);
      return;
    }
    if (budget == 0 || --budget == 0) {
      graph_.complete = false;
      return;
    }
    combine(from, some, next + 1, chosen, budget);
    const auto conflicts = [&](std::uint32_t other) {
      return meet(net_.transitions[other].sources, net_.transitions[some[next]].sources);
    };
    if (std::any_of(chosen.begin(), chosen.end(), conflicts)) return;
    chosen.push_back(some[next]);
    combine(from, some, next + 1, chosen, budget);
    chosen.pop_back();
  }

  void fire_together(std::uint32_t from, const std::vector<std::uint32_t>& chosen) {
    PlaceSet next = graph_.markings[from];
    for (const std::uint32_t t : chosen)
      for (const std::uint32_t source : net_.transitions[t].sources) take(next, source);
    for (const std::uint32_t t : chosen)
      for (const std::uint32_t target : net_.transitions[t].targets) put(next, target);
    const std::uint32_t to = find_or_add(std::move(next), from, chosen);
    if (to != kNone) graph_.edges[from].push_back({chosen.front(), to, true});
  }

  const TokenNet& net_;
  std::size_t limit_;
  std::vector<std::vector<std::uint32_t>> leaving_;
  std::unordered_map<PlaceSet, std::uint32_t, Hash> index_;
  std::vector<bool> overrun_;
  MarkingGraph graph_;
};

// Strongly connected components by Tarjan's algorithm, without recursion; a component comes after all that it
// leads to.
class Components {
 public:
  explicit Components(const MarkingGraph& graph)
      : graph_(graph), number_(graph.markings.size(), 0), low_(number_.size()), of_(number_.size(), kOpen) {
    for (std::uint32_t i = 0; i < number_.size(); ++i) {
      if (number_[i] == 0) search(i);
    }
  }

  std::size_t count() const { return count_; }
  std::uint32_t of(std::size_t marking) const { return of_[marking]; }

 private:
  static constexpr std::uint32_t kOpen = std::numeric_limits<std::uint32_t>::max();

  struct Frame {
    std::uint32_t marking = 0;
    std::size_t next = 0;
  };

  void open(std::uint32_t marking) {
    number_[marking] = low_[marking] = ++last_;
    stack_.push_back(marking);
    frames_.push_back({marking, 0});
  }

  void search(std::uint32_t root) {
    open(root);
    while (!frames_.empty()) {
      Frame& frame = frames_.back();
      const std::uint32_t from = frame.marking;
      if (frame.next < graph_.edges[from].size()) {
        const std::uint32_t to = graph_.edges[from][frame.next++].to;
        if (number_[to] == 0) {
          open(to);
        } else if (of_[to] == kOpen) {
          low_[from] = std::min(low_[from], number_[to]);
        }
        continue;
      }
      frames_.pop_back();
      if (!frames_.empty()) {
        std::uint32_t& above = low_[frames_.back().marking];
        above = std::min(above, low_[from]);
      }
      if (low_[from] == number_[from]) close(from);
    }
  }

  void close(std::uint32_t root) {
    for (std::uint32_t member = kOpen; member != root;) {
      member = stack_.back();
      stack_.pop_back();
      of_[member] = static_cast<std::uint32_t>(count_);
    }
    ++count_;
  }

  const MarkingGraph& graph_;
  std::vector<std::uint32_t> number_;
  std::vector<std::uint32_t> low_;
  std::vector<std::uint32_t> of_;
  std::vector<std::uint32_t> stack_;
  std::vector<Frame> frames_;
  std::uint32_t last_ = 0;
  std::size_t count_ = 0;
};

}  // namespace

bool contains(const PlaceSet& set, std::size_t place) {
  return (set[place / kBits] >> (place % kBits) & 1U) != 0;
}

MarkingGraph explore(const TokenNet& net, std::size_t limit) {
  return Explorer(net, limit).run();
}

std::vector<PlaceSet> places_to_leave(const TokenNet& net, const MarkingGraph& graph) {
  const Components components(graph);
  const std::size_t words = (net.places + kBits - 1) / kBits;
  std::vector<std::vector<std::uint32_t>> members(components.count());
  for (std::uint32_t i = 0; i < graph.markings.size(); ++i) members[components.of(i)].push_back(i);
  std::vector<PlaceSet> of_component(components.count(), PlaceSet(words, 0));
  for (std::size_t c = 0; c < members.size(); ++c) {
    for (const std::uint32_t marking : members[c]) {
      for (std::size_t place = 0; place < net.places; ++place) {
        if (net.busy[place] && contains(graph.markings[marking], place)) put(of_component[c], place);
      }
      for (const MarkingEdge& edge : graph.edges[marking]) {
        for (const std::uint32_t source : net.transitions[edge.transition].sources)
          put(of_component[c], source);
        const PlaceSet& later = of_component[components.of(edge.to)];
        for (std::size_t word = 0; word < words; ++word) of_component[c][word] |= later[word];
      }
    }
  }
  std::vector<PlaceSet> result;
  result.reserve(graph.markings.size());
  for (std::size_t i = 0; i < graph.markings.size(); ++i) result.push_back(of_component[components.of(i)]);
  return result;
}

std::vector<std::vector<std::uint32_t>> way_to(const MarkingGraph& graph, std::uint32_t marking) {
  std::vector<std::vector<std::uint32_t>> way;
  for (; marking != 0; marking = graph.parent[marking]) way.push_back(graph.by[marking]);
  std::reverse(way.begin(), way.end());
  return way;
}

}  // namespace stepwright::graphic

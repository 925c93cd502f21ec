// The reductions of a token net; see token_net.h.

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "ladder/graphic/token_net.h"

namespace stepwright::graphic {
namespace {

using Numbers = std::set<std::uint32_t>;

class Reduction {
 public:
  explicit Reduction(TokenNet net) : net_(std::move(net)), in_(net_.places), out_(net_.places) {
    marked_.insert(net_.marked.begin(), net_.marked.end());
    for (std::uint32_t t = 0; t < net_.transitions.size(); ++t) {
      sources_.emplace_back(net_.transitions[t].sources.begin(), net_.transitions[t].sources.end());
      targets_.emplace_back(net_.transitions[t].targets.begin(), net_.transitions[t].targets.end());
      for (const std::uint32_t place : sources_[t]) out_[place].insert(t);
      for (const std::uint32_t place : targets_[t]) in_[place].insert(t);
    }
    alive_.assign(net_.transitions.size(), true);
  }

  TokenNet run() {
    for (bool changed = true; changed;) {
      changed = false;
      for (std::uint32_t t = 0; t < alive_.size(); ++t) {
        if (alive_[t]) changed = drop_idle_loop(t) || melt_places(t) || changed;
      }
      for (std::uint32_t place = 0; place < net_.places; ++place) {
        changed = melt_transitions(place) || changed;
      }
      changed = drop_twins() || changed;
    }
    return rest();
  }

 private:
  void remove(std::uint32_t t) {
    for (const std::uint32_t place : sources_[t]) out_[place].erase(t);
    for (const std::uint32_t place : targets_[t]) in_[place].erase(t);
    alive_[t] = false;
  }

  // A transition from a place to itself moves nothing, but its place does not wait.
  bool drop_idle_loop(std::uint32_t t) {
    if (sources_[t].size() != 1 || sources_[t] != targets_[t]) return false;
    net_.busy[*sources_[t].begin()] = true;
    remove(t);
    return true;
  }

  // p -> t -> q where nothing else leaves p: p and q are one place, q.
  bool melt_places(std::uint32_t t) {
    if (!alive_[t] || sources_[t].size() != 1 || targets_[t].size() != 1) return false;
    const std::uint32_t p = *sources_[t].begin();
    const std::uint32_t q = *targets_[t].begin();
    if (p == q || out_[p].size() != 1 || (marked_.count(p) != 0 && marked_.count(q) != 0)) return false;
    const bool twice = std::any_of(in_[p].begin(), in_[p].end(),
                                   [&](std::uint32_t from) { return targets_[from].count(q) != 0; });
    if (twice) return false;
    remove(t);
    for (const std::uint32_t from : in_[p]) {
      targets_[from].erase(p);
      targets_[from].insert(q);
      in_[q].insert(from);
    }
    in_[p].clear();
    if (marked_.erase(p) != 0) marked_.insert(q);
    return true;
  }

  // t -> p -> u where nothing else touches p and u needs nothing else: t and u are one transition, t.
  bool melt_transitions(std::uint32_t p) {
    if (in_[p].size() != 1 || out_[p].size() != 1 || marked_.count(p) != 0) return false;
    const std::uint32_t t = *in_[p].begin();
    const std::uint32_t u = *out_[p].begin();
    if (t == u || sources_[u].size() != 1) return false;
    const bool twice = std::any_of(targets_[u].begin(), targets_[u].end(),
                                   [&](std::uint32_t place) { return targets_[t].count(place) != 0; });
    if (twice) return false;
    const Numbers moved = targets_[u];
    remove(u);
    targets_[t].erase(p);
    in_[p].clear();
    for (const std::uint32_t place : moved) {
      targets_[t].insert(place);
      in_[place].insert(t);
    }
    return true;
  }

  bool drop_twins() {
    bool changed = false;
    std::map<std::pair<Numbers, Numbers>, std::uint32_t> seen;
    for (std::uint32_t t = 0; t < alive_.size(); ++t) {
      if (!alive_[t] || seen.emplace(std::pair(sources_[t], targets_[t]), t).second) continue;
      remove(t);
      changed = true;
    }
    std::map<std::pair<Numbers, Numbers>, std::uint32_t> places;
    for (std::uint32_t place = 0; place < net_.places; ++place) {
      if (in_[place].empty() || out_[place].empty()) continue;
      const auto [first, added] = places.emplace(std::pair(in_[place], out_[place]), place);
      if (added || marked_.count(first->second) != marked_.count(place)) continue;
      if (net_.busy[first->second] != net_.busy[place]) continue;
      for (const std::uint32_t t : in_[place]) targets_[t].erase(place);
      for (const std::uint32_t t : out_[place]) sources_[t].erase(place);
      in_[place].clear();
      out_[place].clear();
      marked_.erase(place);
      changed = true;
    }
    return changed;
  }

  TokenNet rest() {
    TokenNet result;
    result.places = net_.places;
    result.busy = net_.busy;
    result.marked.assign(marked_.begin(), marked_.end());
    for (std::uint32_t t = 0; t < alive_.size(); ++t) {
      if (!alive_[t]) continue;
      result.transitions.push_back({{sources_[t].begin(), sources_[t].end()},
                                    {targets_[t].begin(), targets_[t].end()},
                                    net_.transitions[t].origin});
    }
    return result;
  }

  TokenNet net_;
  std::vector<Numbers> in_;  // transitions into a place
  std::vector<Numbers> out_;
  std::vector<Numbers> sources_;  // places of a transition
  std::vector<Numbers> targets_;
  std::vector<bool> alive_;
  Numbers marked_;
};

}  // namespace

TokenNet reduced(TokenNet net) {
  return Reduction(std::move(net)).run();
}

}  // namespace stepwright::graphic

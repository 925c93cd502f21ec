#include "supervisor/fleet/allocation/internal/neighbourhood_search.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace stepwright::fleet::internal {

namespace {

constexpr std::uint64_t kMostRemoved = 30;
constexpr std::size_t kMostRegretted = 400;    // trips; their time grows with the second power
constexpr std::size_t kMostJudged = 4;         // consistent ones of them
constexpr std::size_t kMostTried = 12;         // insertions of a coupled trip, the cheapest ones
constexpr double kBlink = 0.02;                // how often a place is passed over
constexpr double kSpread = 0.1;                // see RoutePlan::set_spread
constexpr double kSmooth = 0.05;               // weight of the mean beside that of the last vehicle
constexpr double kHot = 0.02, kCold = 0.0002;  // of the value: what the search begins and ends with

}  // namespace

NeighbourhoodSearch::NeighbourhoodSearch(const TripModel& model, std::uint64_t seed)
    : model_(model),
      random_(seed),
      current_(model),
      best_(model),
      coupled_with_(model.problem().transports.size()) {
  const auto tie = [&](std::uint32_t a, std::uint32_t b) {
    coupled_with_[a].push_back(b);
    coupled_with_[b].push_back(a);
  };
  for (const TransportConstraint& c : model.problem().constraints) {
    const auto is_trip = [](const TransportTimepoint& t) {
      return t.moment == TransportMoment::TransportStart || t.moment == TransportMoment::TransportEnd;
    };
    if (is_trip(c.from) && is_trip(c.to) && c.from.index != c.to.index) tie(c.from.index, c.to.index);
  }
  for (const FixedOrder& order : model.problem().orders) tie(order.before.value, order.after.value);
}

void NeighbourhoodSearch::run(std::uint64_t iterations, const Limits& limits) {
  if (!begun_) {
    begun_ = true;
    recreate(current_, true);
    current_standing_ = best_standing_ = standing(current_);
    best_ = current_;
    keep_if_better(current_, current_standing_);
  }
  for (std::uint64_t i = 0; (iterations == 0 || i < iterations) && !limits.over(); ++i) {
    ++iterations_;
    RoutePlan plan = current_;
    plan.set_spread(kSpread * (0.5 + unit()));
    for (const std::uint32_t trip : ruined(plan)) plan.remove(trip);
    if (plan.missing().empty()) return;  // nothing can be moved
    recreate(plan, false);
    const Standing now = standing(plan);
    const double done = std::max(
        limits.used(), iterations == 0 ? 0.0 : static_cast<double>(i) / static_cast<double>(iterations));
    const double share = kHot * std::pow(kCold / kHot, done);
    keep_if_better(plan, now);
    if (!accept(now, share * static_cast<double>(best_standing_.value))) continue;
    current_ = std::move(plan);
    current_standing_ = now;
  }
}

NeighbourhoodSearch::Standing NeighbourhoodSearch::standing(const RoutePlan& plan) const {
  const std::int64_t value = plan.score().value(model_.problem().objective);
  std::int64_t finishes_ms = 0;
  for (std::uint32_t v = 0; v < model_.vehicles(); ++v) finishes_ms += plan.finish_ms(v);
  const double mean_ms = static_cast<double>(finishes_ms) / std::max(1U, model_.vehicles());
  const double smooth = kSmooth * model_.problem().objective.makespan * mean_ms;
  return {plan.missing().size(), value, value + static_cast<std::int64_t>(smooth)};
}

void NeighbourhoodSearch::keep_if_better(const RoutePlan& plan, const Standing& now) {
  if (now < best_standing_) {
    best_standing_ = now;
    best_ = plan;
  }
  // Posted insertions leave the ways they replace in the network, so that the value may be overestimated.
  if (now.missing > 0 || (found_ && now.value >= found_->value && !model_.coupled())) return;
  auto evaluation = evaluate(model_, plan.routes());
  if (!evaluation) return;
  const std::int64_t value = evaluation->score.value(model_.problem().objective);
  if (!found_ || value < found_->value) found_ = Found{plan.routes(), *std::move(evaluation), value};
}

bool NeighbourhoodSearch::accept(const Standing& now, double temperature) {
  if (now.missing < current_standing_.missing) return true;
  if (now.missing > current_standing_.missing) return false;
  const double worse = static_cast<double>(now.smooth - current_standing_.smooth);
  if (worse <= 0) return true;
  return temperature > 0 && unit() < std::exp(-worse / temperature);
}

NeighbourhoodSearch::Trips NeighbourhoodSearch::ruined(const RoutePlan& plan) {
  Trips among;
  for (std::uint32_t t = 0; t < model_.trips(); ++t) {
    if (plan.removable(t)) among.push_back(t);
  }
  if (among.empty()) return among;
  const std::uint64_t most = std::min<std::uint64_t>({among.size(), kMostRemoved, 8 + among.size() / 4});
  const std::size_t count = 1 + below(most);
  Trips out;
  const std::uint64_t way = below(8);
  if (way == 0) {
    out = among;
    shuffle(out);
  } else if (way <= 2) {
    out = of_last_vehicle(plan);
  } else {
    const Trips& missing = plan.missing();
    const bool about_missing = !missing.empty() && below(2) == 0;
    const std::uint32_t seed = about_missing ? missing[below(missing.size())] : among[below(among.size())];
    out = related_to(seed, among, plan);
  }
  if (out.size() > count) out.resize(count);
  return out;
}

// The nearest first; now and then one is left for later.
NeighbourhoodSearch::Trips NeighbourhoodSearch::related_to(std::uint32_t trip, const Trips& among,
                                                           const RoutePlan& plan) {
  std::vector<std::pair<double, std::uint32_t>> ranked;
  for (const std::uint32_t other : among) {
    ranked.emplace_back(distance(trip, other, plan) * (0.5 + unit()), other);
  }
  std::ranges::sort(ranked);
  Trips out;
  for (const auto& [far, other] : ranked) out.push_back(other);
  return out;
}

double NeighbourhoodSearch::distance(std::uint32_t a, std::uint32_t b, const RoutePlan& plan) const {
  const std::vector<std::uint32_t>& tied = coupled_with_[model_.trip(a).transport];
  if (a == b || std::ranges::find(tied, model_.trip(b).transport) != tied.end()) return 0.0;
  const auto way = [&](StopIndex from, StopIndex to) {
    // Any vehicle will do: near is near for all of them.
    const std::uint32_t v = plan.vehicle_of(b) == kNone ? 0 : plan.vehicle_of(b);
    return static_cast<double>(std::min(model_.least_way_ms(v, model_.place(from), model_.place(to)),
                                        model_.least_way_ms(v, model_.place(to), model_.place(from))));
  };
  const double apart = way(pick_up_of(a), pick_up_of(b)) + way(set_down_of(a), set_down_of(b));
  const bool both_in = plan.vehicle_of(a) != kNone && plan.vehicle_of(b) != kNone;
  if (!both_in) return apart;
  const double later =
      std::abs(static_cast<double>(plan.begin_ms(pick_up_of(a)) - plan.begin_ms(pick_up_of(b))));
  return apart + 0.2 * later;
}

// Trips of the vehicle that is ready last, then others, in any order.
NeighbourhoodSearch::Trips NeighbourhoodSearch::of_last_vehicle(const RoutePlan& plan) {
  std::uint32_t last = 0;
  for (std::uint32_t v = 1; v < model_.vehicles(); ++v) {
    if (plan.routes()[v].empty()) continue;
    if (plan.finish_ms(v) > plan.finish_ms(last) || plan.routes()[last].empty()) last = v;
  }
  Trips out, others;
  for (std::uint32_t t = 0; t < model_.trips(); ++t) {
    if (plan.removable(t)) (plan.vehicle_of(t) == last ? out : others).push_back(t);
  }
  shuffle(out);
  shuffle(others);
  if (out.size() > 3) out.resize(std::max<std::size_t>(3, out.size() / 2));
  out.insert(out.end(), others.begin(), others.end());
  return out;
}

void NeighbourhoodSearch::recreate(RoutePlan& plan, bool greedy) {
  if (model_.coupled()) {
    start_network(plan);
    if (!network_) return;
    plan.set_windows(*network_);
  }
  Trips trips = plan.missing();
  const std::uint64_t way = greedy ? (trips.size() <= kMostRegretted ? 0 : 1) : below(4);
  if (way == 0) {
    by_regret(plan, trips);
    return;
  }
  if (way == 1) {
    std::ranges::sort(trips, {}, [&](std::uint32_t t) { return model_.latest_ms(set_down_of(t)); });
  } else {
    shuffle(trips);
  }
  in_order(plan, std::move(trips));
}

void NeighbourhoodSearch::in_order(RoutePlan& plan, Trips order) {
  for (const std::uint32_t trip : order) {
    std::optional<Insertion> best;
    for (std::uint32_t v = 0; v < model_.vehicles(); ++v) {
      const auto at = plan.best_insertion(trip, v, [&] { return unit() < kBlink; });
      if (at && (!best || at->cost < best->cost)) best = at;
    }
    put_back(plan, trip, best);
  }
}

// The trip first that would lose most if it did not get its best vehicle.
void NeighbourhoodSearch::by_regret(RoutePlan& plan, const Trips& trips) {
  const auto never = [] { return false; };
  const std::uint32_t vehicles = model_.vehicles();
  std::vector<std::vector<Insertion>> best(trips.size(), std::vector<Insertion>(vehicles));
  const auto look = [&](std::size_t i, std::uint32_t v) {
    best[i][v] = plan.best_insertion(trips[i], v, never).value_or(Insertion{});
  };
  Trips left(trips.size());
  std::iota(left.begin(), left.end(), 0U);
  for (const std::uint32_t i : left) {
    for (std::uint32_t v = 0; v < vehicles; ++v) look(i, v);
  }
  while (!left.empty()) {
    std::uint32_t chosen = left.front();
    Insertion at;
    double most = -1.0;
    for (const std::uint32_t i : left) {
      Insertion first, second;
      for (const Insertion& insertion : best[i]) {
        if (insertion.cost < first.cost) {
          second = std::exchange(first, insertion);
        } else if (insertion.cost < second.cost) {
          second = insertion;
        }
      }
      const bool none = first.vehicle == kNone;
      const double regret = none ? 0.0 : second.cost - first.cost;
      const bool cheaper = regret == most && first.cost < at.cost;
      if (regret <= most && !cheaper) continue;
      most = regret;
      chosen = i;
      at = first;
    }
    std::erase(left, chosen);
    put_back(plan, trips[chosen], at.vehicle == kNone ? std::nullopt : std::optional(at));
    const std::uint32_t changed = plan.vehicle_of(trips[chosen]);
    for (const std::uint32_t i : left) {
      for (std::uint32_t v = 0; v < vehicles; ++v) {
        const bool ordered =
            !model_.trip(trips[i]).predecessors.empty() || !model_.trip(trips[i]).successors.empty();
        if (v == changed || model_.coupled() || ordered) look(i, v);
      }
    }
  }
}

void NeighbourhoodSearch::put_back(RoutePlan& plan, std::uint32_t trip,
                                   const std::optional<Insertion>& best) {
  if (!model_.coupled()) {
    if (best) plan.insert(trip, *best);
    return;
  }
  // What an insertion delays elsewhere only the network knows: a few are judged by what they come to.
  std::optional<Insertion> chosen;
  std::int64_t least = 0;
  std::size_t judged = 0;
  for (const Insertion& at : diverse(plan.insertions(trip))) {
    const Network::Mark mark = network_->mark();
    if (unit() < kBlink || !post(plan, trip, at)) continue;
    RoutePlan trial = plan;
    trial.insert(trip, at);
    trial.set_windows(*network_);
    const std::int64_t value = standing(trial).smooth;
    network_->undo(mark);
    if (!chosen || value < least) {
      chosen = at;
      least = value;
    }
    if (++judged == kMostJudged) break;
  }
  if (!chosen || !post(plan, trip, *chosen)) return;
  plan.insert(trip, *chosen);
  plan.set_windows(*network_);
}

std::vector<Insertion> NeighbourhoodSearch::diverse(std::span<const Insertion> all) const {
  std::vector<Insertion> sorted(all.begin(), all.end()), out, rest;
  std::ranges::stable_sort(sorted, {}, &Insertion::cost);
  std::vector<char> seen(model_.vehicles(), 0);
  for (const Insertion& insertion : sorted) {
    (seen[insertion.vehicle]++ == 0 ? out : rest).push_back(insertion);
  }
  const std::size_t step = std::max<std::size_t>(1, rest.size() / kMostTried);
  for (std::size_t i = 0; i < rest.size(); i += i < kMostTried ? 1 : step) out.push_back(rest[i]);
  return out;
}

void NeighbourhoodSearch::start_network(const RoutePlan& plan) {
  network_.emplace(model_.timepoints());
  bool consistent = network_->post(model_.constraints());
  network_->track_latest();
  for (std::uint32_t v = 0; v < model_.vehicles(); ++v) {
    Timepoint at = model_.start_of(v);
    std::uint32_t place = model_.driver(v).start;
    std::int32_t stay_ms = 0;
    for (const StopIndex stop : plan.routes()[v]) {
      const std::int32_t way_ms = model_.way_ms(v, place, model_.place(stop));
      consistent =
          consistent && way_ms < kNoWay && network_->post({at, TripModel::at(stop), way_ms + stay_ms, 0});
      at = TripModel::at(stop);
      place = model_.place(stop);
      stay_ms = model_.service_ms(stop);
    }
  }
  if (!consistent) network_.reset();  // what is fixed contradicts the constraints
}

bool NeighbourhoodSearch::post(const RoutePlan& plan, std::uint32_t trip, const Insertion& at) {
  const Route& old = plan.routes()[at.vehicle];
  Route route = old;
  route.insert(route.begin() + at.set_down, set_down_of(trip));
  if (at.pick_up != kNone) route.insert(route.begin() + at.pick_up, pick_up_of(trip));
  std::vector<Constraint> links;
  for (std::size_t k = 0; k < route.size(); ++k) {
    const bool is_new = trip_of(route[k]) == trip || (k > 0 && trip_of(route[k - 1]) == trip);
    if (!is_new) continue;
    const std::uint32_t before = k == 0 ? model_.driver(at.vehicle).start : model_.place(route[k - 1]);
    const std::int32_t stay_ms = k == 0 ? 0 : model_.service_ms(route[k - 1]);
    const std::int32_t way_ms = model_.way_ms(at.vehicle, before, model_.place(route[k]));
    links.push_back({k == 0 ? model_.start_of(at.vehicle) : TripModel::at(route[k - 1]),
                     TripModel::at(route[k]), way_ms + stay_ms, 0});
  }
  return network_->post(links);
}

void NeighbourhoodSearch::shuffle(Trips& trips) {
  for (std::size_t i = trips.size(); i > 1; --i) std::swap(trips[i - 1], trips[below(i)]);
}

}  // namespace stepwright::fleet::internal

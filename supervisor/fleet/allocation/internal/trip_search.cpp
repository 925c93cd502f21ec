#include "supervisor/fleet/allocation/internal/trip_search.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace stepwright::fleet::internal {

namespace {

constexpr TripMask bit(std::uint32_t trip) {
  return TripMask(1) << trip;
}

template <typename Visitor>
void each(TripMask mask, Visitor&& visitor) {
  for (; mask != 0; mask &= mask - 1) visitor(static_cast<std::uint32_t>(std::countr_zero(mask)));
}

// Whether a transport that can be late is divided: it is as late as its last trip, which a sum does not show.
bool divided_and_due(const TripModel& model) {
  std::vector<char> seen(model.problem().transports.size(), 0);
  for (std::uint32_t t = 0; t < model.trips(); ++t) {
    if (model.transport_of(t).due && seen[model.trip(t).transport]++ != 0) return true;
  }
  return false;
}

}  // namespace

TripSearch::TripSearch(const TripModel& model, const AllocationObjective& objective, const Limits& limits,
                       std::uint64_t nodes)
    : model_(model),
      objective_(objective),
      limits_(limits),
      most_nodes_(nodes),
      tables_(model),
      network_(model.timepoints()),
      any_(objective.makespan == 0 && objective.travel == 0 && objective.tardiness == 0),
      dominance_(!model.coupled() && (objective.tardiness == 0 || !divided_and_due(model))),
      routes_(model.vehicles()),
      late_ms_(model.problem().transports.size(), 0) {
  assert(!model.contradiction());
  const bool consistent = network_.post(model.constraints());
  assert(consistent);
  (void)consistent;
  for (StopIndex stop = 0; stop < model.stops(); ++stop) {
    last_end_ms_ =
        std::max<std::int64_t>(last_end_ms_, model.latest_ms(stop) + std::int64_t(model.service_ms(stop)));
  }
  for (std::uint32_t v = 0; v < model.vehicles(); ++v) {
    if (model.driver(v).finish != kNone) last_end_ms_ = kHorizon_ms;
  }
  pick_up_from_.assign(model.vehicles() + 1, std::vector<std::int64_t>(model.trips(), kNoWay));
  for (std::uint32_t v = model.vehicles(); v-- > 0;) {
    for (std::uint32_t t = 0; t < model.trips(); ++t) {
      std::int64_t& from = pick_up_from_[v][t];
      from = pick_up_from_[v + 1][t];
      if (model.trip(t).vehicles[v] == 0) continue;
      const std::int64_t way_ms = model.least_way_ms(v, model.driver(v).start, model.place(pick_up_of(t)));
      from = std::min(from, model.start_ms(v) + way_ms);
    }
  }
}

bool TripSearch::run(std::int64_t value) {
  best_ = value;
  Node root;
  root.to_do = static_cast<TripMask>((std::uint64_t(1) << model_.trips()) - 1);
  if (model_.vehicles() > 0) root.ready_ms = model_.start_ms(0);
  visit(root);
  return !stopped_;
}

std::int64_t TripSearch::root_bound() const {
  Node root;
  root.to_do = static_cast<TripMask>((std::uint64_t(1) << model_.trips()) - 1);
  if (model_.vehicles() > 0) root.ready_ms = model_.start_ms(0);
  return bound(root);
}

bool TripSearch::stop() {
  if (most_nodes_ > 0 && nodes_ >= most_nodes_) stopped_ = true;
  if (nodes_ % 256 == 0 && limits_.over()) stopped_ = true;
  return stopped_ || out_;
}

void TripSearch::visit(const Node& node) {
  if (stop()) return;
  ++nodes_;
  if (node.vehicle == model_.vehicles()) {
    if (node.to_do == 0) record();
    return;
  }
  if (bound(node) >= best_ || !in_time(node)) return;
  if (dominance_ && dominated(node)) return;
  branch(node);
}

void TripSearch::branch(const Node& node) {
  const Driver& driver = model_.driver(node.vehicle);
  const std::size_t made = routes_[node.vehicle].size();
  if (made < driver.fixed.size()) {
    const StopIndex stop = driver.fixed[made];
    if (!is_pick_up(stop) || may_pick_up(node, trip_of(stop))) append(node, stop);
    return;
  }
  if (!driver.whole) {
    std::vector<std::pair<std::int64_t, StopIndex>> stops;
    const auto add = [&](StopIndex stop) {
      const std::int32_t way_ms = model_.way_ms(node.vehicle, place_of(node), model_.place(stop));
      if (way_ms >= kNoWay) return;
      stops.emplace_back(std::max<std::int64_t>(model_.earliest_ms(stop), node.ready_ms + way_ms), stop);
    };
    each(node.aboard, [&](std::uint32_t t) { add(set_down_of(t)); });
    each(node.to_do, [&](std::uint32_t t) {
      if (may_pick_up(node, t)) add(pick_up_of(t));
    });
    std::ranges::sort(stops);
    for (const auto& [arrival_ms, stop] : stops) append(node, stop);
  }
  if (node.aboard == 0) close(node);
}

bool TripSearch::may_pick_up(const Node& node, std::uint32_t t) const {
  const Trip& trip = model_.trip(t);
  const Driver& driver = model_.driver(node.vehicle);
  if (trip.vehicles[node.vehicle] == 0 || node.load + trip.amount > driver.capacity) return false;
  if (trip.alike != kNone && (node.to_do & bit(trip.alike)) != 0) return false;
  if (driver.like_before && node.first == kNone) {
    if (node.first_before == kNone || t < node.first_before) return false;
  }
  // What is set down was so by this vehicle: `close` keeps what has to follow it.
  return std::ranges::all_of(trip.predecessors, [&](std::uint32_t before) {
    return ((node.to_do | node.aboard) & bit(before)) == 0;
  });
}

void TripSearch::append(const Node& node, StopIndex stop) {
  const std::uint32_t v = node.vehicle, t = trip_of(stop);
  const std::int32_t way_ms = model_.way_ms(v, place_of(node), model_.place(stop));
  if (way_ms >= kNoWay) return;
  Node next = node;
  std::int64_t begin_ms = std::max<std::int64_t>(model_.earliest_ms(stop), node.ready_ms + way_ms);
  if (begin_ms > model_.latest_ms(stop)) return;
  const Network::Mark mark = network_.mark();
  if (model_.coupled()) {
    const Timepoint from = node.last == kNone ? model_.start_of(v) : TripModel::at(node.last);
    const std::int32_t stay_ms = node.last == kNone ? 0 : model_.service_ms(node.last);
    if (!network_.post({from, TripModel::at(stop), way_ms + stay_ms, 0})) return;
    begin_ms = network_.earliest_ms(TripModel::at(stop));
  }
  next.last = stop;
  next.ready_ms = begin_ms + model_.service_ms(stop);
  next.travel_ms += way_ms;
  std::int64_t& late_ms = late_ms_[model_.trip(t).transport];
  const std::int64_t late_before_ms = late_ms;
  const Transport& transport = model_.transport_of(t);
  if (is_pick_up(stop)) {
    next.aboard |= bit(t);
    next.to_do &= ~bit(t);
    next.load += model_.trip(t).amount;
    if (next.first == kNone) next.first = t;
  } else {
    next.aboard &= ~bit(t);
    next.load -= model_.trip(t).amount;
    if (transport.due) late_ms = std::max<std::int64_t>(late_ms, next.ready_ms - transport.due->count());
    next.tardiness_ms += transport.weight * (late_ms - late_before_ms);
  }
  routes_[v].push_back(stop);
  if (model_.coupled()) {
    next.makespan_ms = made_makespan(v);
    next.tardiness_ms = made_tardiness();
  }
  visit(next);
  routes_[v].pop_back();
  late_ms = late_before_ms;
  if (model_.coupled()) network_.undo(mark);
}

void TripSearch::close(const Node& node) {
  const std::uint32_t v = node.vehicle;
  bool torn = false;  // from what must follow it on the same vehicle
  each(node.to_do, [&](std::uint32_t t) {
    for (const std::uint32_t before : model_.trip(t).predecessors) torn |= (node.to_do & bit(before)) == 0;
  });
  if (torn) return;
  Node next = node;
  const std::uint32_t finish = model_.driver(v).finish;
  const std::int32_t way_ms = finish == kNone ? 0 : model_.way_ms(v, place_of(node), finish);
  if (way_ms >= kNoWay || node.ready_ms + way_ms > kHorizon_ms) return;
  next.travel_ms += way_ms;
  if (finish != kNone || node.last != kNone) {
    next.makespan_ms = std::max(node.makespan_ms, node.ready_ms + way_ms);
  }
  const Network::Mark mark = network_.mark();
  if (model_.coupled()) {
    const Timepoint from = node.last == kNone ? model_.start_of(v) : TripModel::at(node.last);
    const std::int32_t stay_ms = node.last == kNone ? 0 : model_.service_ms(node.last);
    if (!network_.post({from, model_.finish_of(v), way_ms + stay_ms, 0})) return;
    next.makespan_ms = made_makespan(v + 1);
    next.tardiness_ms = made_tardiness();
  }
  next.vehicle = v + 1;
  next.last = kNone;
  next.first_before = node.first;
  next.first = kNone;
  if (next.vehicle < model_.vehicles()) {
    next.ready_ms = model_.coupled() ? network_.earliest_ms(model_.start_of(v + 1)) : model_.start_ms(v + 1);
  }
  visit(next);
  if (model_.coupled()) network_.undo(mark);
}

void TripSearch::record() {
  auto evaluation = evaluate(model_, routes_);
  assert(evaluation && "what the search built keeps every constraint");
  if (!evaluation) return;
  const std::int64_t value = evaluation->score.value(objective_);
  if (value >= best_) return;
  best_ = value;
  found_ = Found{routes_, *std::move(evaluation), value};
  out_ = any_;
}

std::int64_t TripSearch::bound(const Node& node) const {
  if (node.vehicle == model_.vehicles()) return 0;
  std::int64_t best = kNoValue;
  for (TripMask own = node.to_do;; own = (own - 1) & node.to_do) {
    Effort mine = node.last == kNone ? tables_.whole(node.vehicle, own)
                                     : tables_.rest(node.vehicle, node.last, node.aboard, own);
    const Effort others = tables_.shared(node.vehicle + 1, node.to_do & ~own);
    if (mine.travel_ms < kNoWay && others.travel_ms < kNoWay) {
      const std::int64_t end_ms = node.last == kNone ? mine.time_ms : node.ready_ms + mine.time_ms;
      const Score score{std::max({node.makespan_ms, end_ms, std::int64_t(others.time_ms)}),
                        node.travel_ms + mine.travel_ms + others.travel_ms, 0};
      if (score.makespan_ms <= last_end_ms_) best = std::min(best, score.value(objective_));
    }
    if (own == 0) break;
  }
  if (best == kNoValue || objective_.tardiness == 0) return best;
  return best + objective_.tardiness * least_tardiness(node);
}

std::int64_t TripSearch::least_tardiness(const Node& node) const {
  std::vector<std::int64_t> late = late_ms_;
  const std::uint32_t v = node.vehicle, here = place_of(node);
  each(node.aboard | node.to_do, [&](std::uint32_t t) {
    const Transport& transport = model_.transport_of(t);
    if (!transport.due) return;
    const StopIndex up = pick_up_of(t), down = set_down_of(t);
    std::int64_t begin_ms = node.ready_ms + model_.least_way_ms(v, here, model_.place(down));
    if ((node.to_do & bit(t)) != 0) {
      std::int64_t up_ms = pick_up_from_[v + 1][t];
      if (model_.trip(t).vehicles[v] != 0) {
        up_ms = std::min(up_ms, node.ready_ms + model_.least_way_ms(v, here, model_.place(up)));
      }
      begin_ms = up_ms + least_ride_ms(t);
    }
    begin_ms = std::max<std::int64_t>(begin_ms, model_.earliest_ms(down));
    const std::int64_t late_ms = begin_ms + model_.service_ms(down) - transport.due->count();
    late[model_.trip(t).transport] = std::max(late[model_.trip(t).transport], late_ms);
  });
  std::int64_t sum_ms = 0;
  for (std::size_t i = 0; i < late.size(); ++i) sum_ms += model_.problem().transports[i].weight * late[i];
  return sum_ms;
}

bool TripSearch::in_time(const Node& node) const {
  const std::uint32_t v = node.vehicle, here = place_of(node);
  bool all = true;
  each(node.aboard, [&](std::uint32_t t) {
    const StopIndex down = set_down_of(t);
    all &= node.ready_ms + model_.least_way_ms(v, here, model_.place(down)) <= model_.latest_ms(down);
  });
  each(node.to_do, [&](std::uint32_t t) {
    const StopIndex up = pick_up_of(t);
    std::int64_t up_ms = pick_up_from_[v + 1][t];
    if (model_.trip(t).vehicles[v] != 0) {
      up_ms = std::min(up_ms, node.ready_ms + model_.least_way_ms(v, here, model_.place(up)));
    }
    all &= up_ms <= model_.latest_ms(up);
  });
  return all;
}

bool TripSearch::dominated(const Node& node) {
  std::uint64_t key = node.vehicle;
  key = key << 6 | (node.last == kNone ? 63 : node.last);
  key = key << kMostTableTrips | node.aboard;
  key = key << kMostTableTrips | node.to_do;
  const bool next_alike = node.vehicle + 1 < model_.vehicles() && model_.driver(node.vehicle + 1).like_before;
  const bool choose_first = model_.driver(node.vehicle).like_before && node.first == kNone;
  key = key << 4 | (next_alike && node.first != kNone ? node.first : 15);
  key = key << 4 | (choose_first && node.first_before != kNone ? node.first_before : 15);
  return store_.dominated(
      key, {node.ready_ms, objective_.makespan > 0 ? node.makespan_ms : 0,
            objective_.travel > 0 ? node.travel_ms : 0, objective_.tardiness > 0 ? node.tardiness_ms : 0});
}

std::uint32_t TripSearch::place_of(const Node& node) const {
  return node.last == kNone ? model_.driver(node.vehicle).start : model_.place(node.last);
}

std::int32_t TripSearch::least_ride_ms(std::uint32_t t) const {
  std::int32_t ride_ms = kNoWay;
  const std::uint32_t from = model_.place(pick_up_of(t)), to = model_.place(set_down_of(t));
  for (std::uint32_t v = 0; v < model_.vehicles(); ++v) {
    if (model_.trip(t).vehicles[v] != 0) ride_ms = std::min(ride_ms, model_.least_way_ms(v, from, to));
  }
  return ride_ms + model_.service_ms(pick_up_of(t));
}

std::int64_t TripSearch::made_makespan(std::uint32_t vehicles) const {
  std::int64_t last_ms = 0;
  for (std::uint32_t v = 0; v < vehicles; ++v) {
    if (routes_[v].empty() && model_.driver(v).finish == kNone) continue;
    last_ms = std::max<std::int64_t>(last_ms, network_.earliest_ms(model_.finish_of(v)));
  }
  return last_ms;
}

std::int64_t TripSearch::made_tardiness() {
  std::ranges::fill(late_ms_, 0);
  for (const Route& route : routes_) {
    for (const StopIndex stop : route) {
      const Transport& transport = model_.transport_of(trip_of(stop));
      if (is_pick_up(stop) || !transport.due) continue;
      std::int64_t& late_ms = late_ms_[model_.trip(trip_of(stop)).transport];
      const std::int64_t end_ms = network_.earliest_ms(TripModel::at(stop)) + model_.service_ms(stop);
      late_ms = std::max<std::int64_t>(late_ms, end_ms - transport.due->count());
    }
  }
  std::int64_t sum_ms = 0;
  for (std::size_t i = 0; i < late_ms_.size(); ++i) {
    sum_ms += model_.problem().transports[i].weight * late_ms_[i];
  }
  return sum_ms;
}

}  // namespace stepwright::fleet::internal

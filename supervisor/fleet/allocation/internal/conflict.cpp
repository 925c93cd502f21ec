#include "supervisor/fleet/allocation/internal/conflict.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "supervisor/fleet/allocation/internal/trip_search.h"

namespace stepwright::fleet::internal {

namespace {

bool is_trip(const TransportTimepoint& t) {
  return t.moment == TransportMoment::TransportStart || t.moment == TransportMoment::TransportEnd;
}

// One part that can be left out: its mark in the selection.
using Part = char*;

class Filter {
 public:
  Filter(const AllocationProblem& problem, Selection selection, const Limits& limits)
      : problem_(problem), selection_(std::move(selection)), limits_(limits) {}

  AllocationConflict run() {
    leave_out_unused();
    for (std::size_t share = parts().size() / 2; share > 1; share /= 2) shrink(share);
    while (shrink(1)) {
    }
    leave_out_unused();
    return conflict();
  }

 private:
  // What names a transport that is left out says nothing.
  void leave_out_unused() {
    const auto out = [&](std::uint32_t transport) { return selection_.transports[transport] == 0; };
    for (std::size_t c = 0; c < problem_.constraints.size(); ++c) {
      for (const TransportTimepoint& end : {problem_.constraints[c].from, problem_.constraints[c].to}) {
        if (is_trip(end) && out(end.index)) selection_.constraints[c] = 0;
      }
    }
    for (std::size_t o = 0; o < problem_.orders.size(); ++o) {
      const FixedOrder& order = problem_.orders[o];
      if (out(order.before.value) || out(order.after.value)) selection_.orders[o] = 0;
    }
    for (std::uint32_t t = 0; t < problem_.transports.size(); ++t) {
      if (out(t) || !problem_.transports[t].vehicle) selection_.vehicles[t] = 0;
    }
  }

  std::vector<Part> parts() {
    std::vector<Part> all;
    for (auto* marks : {&selection_.transports, &selection_.constraints, &selection_.vehicles,
                        &selection_.orders, &selection_.routes}) {
      for (char& mark : *marks) {
        if (mark != 0) all.push_back(&mark);
      }
    }
    return all;
  }

  // Leaves out `share` parts at a time where nothing becomes possible by that; whether it did so.
  bool shrink(std::size_t share) {
    const std::vector<Part> all = parts();
    bool any = false;
    unknown_ = false;
    for (std::size_t i = 0; i < all.size(); i += share) {
      const auto some = std::span(all).subspan(i, std::min(share, all.size() - i));
      const Selection before = selection_;
      bool changes = false;
      for (char* const part : some) {
        changes |= *part != 0;
        *part = 0;
      }
      if (!changes) continue;
      leave_out_unused();
      const Judgement judgement = judge(problem_, selection_, Ways::AsGiven, limits_);
      unknown_ |= judgement == Judgement::Unknown;
      if (judgement == Judgement::Impossible) {
        any = true;
        continue;
      }
      restore(before);
    }
    return any;
  }

  // The marks stay where they are: parts point to them.
  void restore(const Selection& before) {
    std::ranges::copy(before.transports, selection_.transports.begin());
    std::ranges::copy(before.constraints, selection_.constraints.begin());
    std::ranges::copy(before.vehicles, selection_.vehicles.begin());
    std::ranges::copy(before.orders, selection_.orders.begin());
    std::ranges::copy(before.routes, selection_.routes.begin());
  }

  AllocationConflict conflict() const {
    AllocationConflict out;
    for (std::uint32_t t = 0; t < selection_.transports.size(); ++t) {
      if (selection_.transports[t] != 0) out.transports.emplace_back(t);
      if (selection_.vehicles[t] != 0) out.vehicles.emplace_back(t);
    }
    const auto indices = [](const std::vector<char>& marks) {
      std::vector<std::uint32_t> set;
      for (std::uint32_t i = 0; i < marks.size(); ++i) {
        if (marks[i] != 0) set.push_back(i);
      }
      return set;
    };
    out.constraints = indices(selection_.constraints);
    out.orders = indices(selection_.orders);
    out.routes = indices(selection_.routes);
    out.minimal = !unknown_;
    return out;
  }

  const AllocationProblem& problem_;
  Selection selection_;
  const Limits& limits_;
  bool unknown_ = false;  // in the last pass
};

Selection nothing_of(const AllocationProblem& problem) {
  Selection selection(problem);
  std::ranges::fill(selection.transports, 0);
  return selection;
}

// By transport: which others a constraint, an order, a fixed vehicle or a fixed route ties it to.
std::vector<std::vector<std::uint32_t>> ties(const AllocationProblem& problem) {
  std::vector<std::vector<std::uint32_t>> out(problem.transports.size());
  const auto tie = [&](std::uint32_t a, std::uint32_t b) {
    if (a == b) return;
    out[a].push_back(b);
    out[b].push_back(a);
  };
  for (const TransportConstraint& c : problem.constraints) {
    if (is_trip(c.from) && is_trip(c.to)) tie(c.from.index, c.to.index);
  }
  for (const FixedOrder& order : problem.orders) tie(order.before.value, order.after.value);
  for (const FixedRoute& route : problem.routes) {
    for (std::size_t i = 1; i < route.stops.size(); ++i) {
      tie(route.stops[i - 1].transport.value, route.stops[i].transport.value);
    }
  }
  for (std::uint32_t a = 0; a < problem.transports.size(); ++a) {
    for (std::uint32_t b = 0; b < a; ++b) {
      const std::optional<VehicleId>&one = problem.transports[a].vehicle,
            &other = problem.transports[b].vehicle;
      if (one && other && *one == *other) tie(a, b);
    }
  }
  return out;
}

}  // namespace

Judgement judge(const AllocationProblem& problem, const Selection& selection, Ways ways,
                const Limits& limits) {
  const JointDivisions joint = joint_divisions(problem, selection, kMostTableTrips);
  bool known = joint.complete;
  for (const Division& division : joint.all) {
    const TripModel model = make_model(problem, selection, division, ways);
    if (model.contradiction()) continue;
    if (!tables_fit(model)) {
      known = false;
      continue;
    }
    TripSearch search(model, {.makespan = 0, .travel = 0, .tardiness = 0}, limits, 0);
    if (!search.run(kNoValue)) return Judgement::Unknown;
    if (search.found()) return Judgement::Possible;
  }
  return known ? Judgement::Impossible : Judgement::Unknown;
}

std::optional<Selection> impossible_part(const AllocationProblem& problem,
                                         const std::vector<std::uint32_t>& missing, const Limits& limits) {
  const auto impossible = [&](const Selection& part) {
    return judge(problem, part, Ways::Closed, limits) == Judgement::Impossible;
  };
  Selection part = nothing_of(problem);
  if (impossible(part)) return part;
  for (std::uint32_t t = 0; t < problem.transports.size() && !limits.over(); ++t) {
    part = nothing_of(problem);
    part.transports[t] = 1;
    if (impossible(part)) return part;
  }
  const auto tied = ties(problem);
  for (const std::uint32_t seed : missing) {
    part = nothing_of(problem);
    part.transports[seed] = 1;
    std::vector<std::uint32_t> reached = {seed};
    for (std::size_t i = 0; i < reached.size() && reached.size() < kMostTableTrips; ++i) {
      for (const std::uint32_t next : tied[reached[i]]) {
        if (part.transports[next] != 0 || limits.over()) continue;
        part.transports[next] = 1;
        reached.push_back(next);
        if (impossible(part)) return part;
        if (reached.size() >= kMostTableTrips) break;
      }
    }
  }
  return std::nullopt;
}

AllocationConflict conflict_within(const AllocationProblem& problem, Selection selection,
                                   const Limits& limits) {
  return Filter(problem, std::move(selection), limits).run();
}

}  // namespace stepwright::fleet::internal

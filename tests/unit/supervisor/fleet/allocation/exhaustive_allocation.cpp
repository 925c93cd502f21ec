#include "tests/unit/supervisor/fleet/allocation/exhaustive_allocation.h"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <vector>

namespace stepwright::fleet {

namespace {

constexpr std::int64_t kHorizonHere_ms = 100'000'000;

struct Piece {
  std::uint32_t transport = 0;
  std::uint32_t amount = 0;
  int fixed_vehicle = -1;
};
struct Move {
  std::size_t piece = 0;
  bool up = true;
};
struct Edge {
  std::size_t from = 0, to = 0;
  std::int64_t least = 0;
};

class Enumeration {
 public:
  explicit Enumeration(const AllocationProblem& problem) : problem_(problem) {}

  std::optional<std::int64_t> run() {
    if (!read_fixed()) return std::nullopt;
    divide(0);
    return best_;
  }

 private:
  bool read_fixed() {
    prefixes_.resize(problem_.vehicles.size());
    whole_.resize(problem_.vehicles.size(), false);
    left_.clear();
    for (const Transport& t : problem_.transports) left_.push_back(t.amount);
    for (const FixedRoute& route : problem_.routes) {
      const std::uint32_t v = route.vehicle.value;
      whole_[v] = route.whole;
      std::vector<std::size_t> aboard;
      for (const FixedStop& stop : route.stops) {
        if (stop.action == LoadAction::PickUp) {
          left_[stop.transport.value] -= stop.amount;
          pieces_.push_back({stop.transport.value, stop.amount, static_cast<int>(v)});
          aboard.push_back(pieces_.size() - 1);
          prefixes_[v].push_back({pieces_.size() - 1, true});
          continue;
        }
        const auto piece = std::ranges::find_if(aboard, [&](std::size_t p) {
          return pieces_[p].transport == stop.transport.value && pieces_[p].amount == stop.amount;
        });
        if (piece == aboard.end()) return false;
        prefixes_[v].push_back({*piece, false});
        aboard.erase(piece);
      }
    }
    return std::ranges::all_of(left_, [](std::int64_t amount) { return amount >= 0; });
  }

  // All multisets of parts of each transport in which all but one part fill a vehicle.
  void divide(std::uint32_t t) {
    if (t == problem_.transports.size()) {
      build();
      return;
    }
    if (left_[t] == 0) {
      divide(t + 1);
      return;
    }
    const Transport& transport = problem_.transports[t];
    std::set<std::int64_t> full;
    for (std::uint32_t v = 0; v < problem_.vehicles.size(); ++v) {
      if (!whole_[v] && (!transport.vehicle || transport.vehicle->value == v)) {
        full.insert(problem_.vehicles[v].capacity);
      }
    }
    if (!transport.divisible) {
      const bool begun = std::ranges::any_of(pieces_, [t](const Piece& p) { return p.transport == t; });
      if (begun) return;
      pieces_.push_back({t, static_cast<std::uint32_t>(left_[t])});
      divide(t + 1);
      pieces_.pop_back();
      return;
    }
    partition(t, left_[t], left_[t], full, 0);
  }

  void partition(std::uint32_t t, std::int64_t left, std::int64_t most, const std::set<std::int64_t>& full,
                 int rests) {
    if (left == 0) {
      divide(t + 1);
      return;
    }
    for (std::int64_t part = std::min(left, most); part > 0; --part) {
      const int more = full.contains(part) ? 0 : 1;
      if (rests + more > 1) continue;
      pieces_.push_back({t, static_cast<std::uint32_t>(part)});
      partition(t, left - part, part, full, rests + more);
      pieces_.pop_back();
    }
  }

  void build() {
    state_.assign(pieces_.size(), 0);
    owner_.assign(pieces_.size(), -1);
    routes_.assign(problem_.vehicles.size(), {});
    extend(0, 0);
  }

  // state: 0 to be picked up, 1 aboard, 2 set down.
  void extend(std::size_t v, std::uint32_t load) {
    if (v == routes_.size()) {
      if (std::ranges::all_of(state_, [](int s) { return s == 2; })) judge();
      return;
    }
    const std::size_t at = routes_[v].size();
    const bool forced = at < prefixes_[v].size();
    for (std::size_t p = 0; p < pieces_.size(); ++p) {
      for (const bool up : {true, false}) {
        if (forced && (prefixes_[v][at].piece != p || prefixes_[v][at].up != up)) continue;
        if (!forced && (whole_[v] || (up && pieces_[p].fixed_vehicle >= 0))) continue;
        make(v, load, p, up);
      }
    }
    if (!forced && load == 0) extend(v + 1, 0);
  }

  void make(std::size_t v, std::uint32_t load, std::size_t p, bool up) {
    const Piece& piece = pieces_[p];
    const Transport& transport = problem_.transports[piece.transport];
    if (up) {
      if (state_[p] != 0 || load + piece.amount > problem_.vehicles[v].capacity) return;
      if (transport.vehicle && transport.vehicle->value != v) return;
    } else if (state_[p] != 1 || owner_[p] != static_cast<int>(v)) {
      return;
    }
    routes_[v].push_back({p, up});
    state_[p] = up ? 1 : 2;
    owner_[p] = static_cast<int>(v);
    extend(v, up ? load + piece.amount : load - piece.amount);
    state_[p] = up ? 0 : 1;
    if (up) owner_[p] = -1;
    routes_[v].pop_back();
  }

  // Timepoints: 0 zero, then starts of vehicles, then pick-up and set-down of each piece (begin of service).
  std::size_t start(std::size_t v) const { return 1 + v; }
  std::size_t point(std::size_t piece, bool up) const {
    return 1 + problem_.vehicles.size() + 2 * piece + (up ? 0 : 1);
  }
  std::int64_t service(const Move& move) const {
    const Transport& t = problem_.transports[pieces_[move.piece].transport];
    return (move.up ? t.pick_up_service : t.set_down_service).count();
  }

  bool orders_kept() const {
    for (const FixedOrder& order : problem_.orders) {
      for (std::size_t a = 0; a < pieces_.size(); ++a) {
        for (std::size_t b = 0; b < pieces_.size(); ++b) {
          if (pieces_[a].transport != order.before.value) continue;
          if (pieces_[b].transport != order.after.value) continue;
          if (owner_[a] != owner_[b]) return false;
          const auto& route = routes_[static_cast<std::size_t>(owner_[a])];
          const auto find = [&](std::size_t p, bool up) {
            return std::ranges::find_if(route, [&](const Move& m) { return m.piece == p && m.up == up; });
          };
          if (find(a, false) > find(b, true)) return false;
        }
      }
    }
    return true;
  }

  void add_constraints(std::vector<Edge>& edges) const {
    struct At {
      std::size_t point;
      std::int64_t after;
      std::size_t piece;
    };
    const auto all = [&](const TransportTimepoint& t) {
      std::vector<At> out;
      if (t.moment == TransportMoment::TimeZero) out.push_back({0, 0, SIZE_MAX});
      if (t.moment == TransportMoment::VehicleStart) out.push_back({start(t.index), 0, SIZE_MAX});
      for (std::size_t p = 0; p < pieces_.size(); ++p) {
        if (pieces_[p].transport != t.index) continue;
        if (t.moment == TransportMoment::TransportStart) out.push_back({point(p, true), 0, p});
        if (t.moment == TransportMoment::TransportEnd) {
          out.push_back({point(p, false), service({p, false}), p});
        }
      }
      return out;
    };
    for (const TransportConstraint& c : problem_.constraints) {
      for (const At& from : all(c.from)) {
        for (const At& to : all(c.to)) {
          const bool same = from.piece != SIZE_MAX && to.piece != SIZE_MAX &&
                            pieces_[from.piece].transport == pieces_[to.piece].transport;
          if (same && from.piece != to.piece) continue;
          const std::int64_t shift = from.after - to.after;
          if (std::abs(c.distance.least.count()) < kHorizonHere_ms) {
            edges.push_back({from.point, to.point, c.distance.least.count() + shift});
          }
          if (std::abs(c.distance.most.count()) < kHorizonHere_ms) {
            edges.push_back({to.point, from.point, -(c.distance.most.count() + shift)});
          }
        }
      }
    }
  }

  void judge() {
    if (!orders_kept()) return;
    std::vector<Edge> edges;
    std::int64_t travel = 0;
    for (std::size_t v = 0; v < routes_.size(); ++v) {
      const TransportVehicle& vehicle = problem_.vehicles[v];
      edges.push_back({0, start(v), vehicle.available.count()});
      LocationId place = vehicle.start;
      std::size_t last = start(v);
      std::int64_t stay = 0;
      for (const Move& move : routes_[v]) {
        const Transport& t = problem_.transports[pieces_[move.piece].transport];
        const auto way = problem_.classes[vehicle.vehicle_class](place, move.up ? t.from : t.to);
        if (!way) return;
        travel += way->count();
        edges.push_back({last, point(move.piece, move.up), stay + way->count()});
        last = point(move.piece, move.up);
        place = move.up ? t.from : t.to;
        stay = service(move);
      }
      if (vehicle.finish) {
        const auto way = problem_.classes[vehicle.vehicle_class](place, *vehicle.finish);
        if (!way) return;
        travel += way->count();
      }
    }
    add_constraints(edges);
    const auto times = earliest(edges);
    if (times) keep(*times, travel);
  }

  std::optional<std::vector<std::int64_t>> earliest(const std::vector<Edge>& edges) const {
    std::vector<std::int64_t> times(1 + problem_.vehicles.size() + 2 * pieces_.size(), 0);
    for (std::size_t round = 0; round <= times.size(); ++round) {
      bool changed = false;
      for (const Edge& edge : edges) {
        const std::int64_t least = times[edge.from] + edge.least;
        if (least <= times[edge.to]) continue;
        if (edge.to == 0) return std::nullopt;
        times[edge.to] = least;
        changed = true;
      }
      if (!changed) return times;
    }
    return std::nullopt;
  }

  void keep(const std::vector<std::int64_t>& times, std::int64_t travel) {
    std::int64_t makespan = 0;
    std::vector<std::int64_t> late(problem_.transports.size(), 0);
    for (std::size_t v = 0; v < routes_.size(); ++v) {
      const TransportVehicle& vehicle = problem_.vehicles[v];
      std::int64_t end = times[start(v)];
      LocationId place = vehicle.start;
      for (const Move& move : routes_[v]) {
        const Transport& t = problem_.transports[pieces_[move.piece].transport];
        end = times[point(move.piece, move.up)] + service(move);
        place = move.up ? t.from : t.to;
        if (move.up || !t.due) continue;
        std::int64_t& of = late[pieces_[move.piece].transport];
        of = std::max(of, end - t.due->count());
      }
      if (vehicle.finish) end += problem_.classes[vehicle.vehicle_class](place, *vehicle.finish)->count();
      if (vehicle.finish || !routes_[v].empty()) makespan = std::max(makespan, end);
    }
    std::int64_t tardiness = 0;
    for (std::size_t t = 0; t < late.size(); ++t) tardiness += problem_.transports[t].weight * late[t];
    const AllocationObjective& weights = problem_.objective;
    const std::int64_t value =
        weights.makespan * makespan + weights.travel * travel + weights.tardiness * tardiness;
    if (!best_ || value < *best_) best_ = value;
  }

  const AllocationProblem& problem_;
  std::vector<Piece> pieces_;
  std::vector<std::vector<Move>> prefixes_;
  std::vector<bool> whole_;
  std::vector<std::int64_t> left_;
  std::vector<int> state_;
  std::vector<int> owner_;
  std::vector<std::vector<Move>> routes_;
  std::optional<std::int64_t> best_;
};

// The parts of a conflict in the order in which they are counted.
class Reduction {
 public:
  Reduction(const AllocationProblem& problem, std::size_t without) : problem_(problem), without_(without) {}

  AllocationProblem reduce(const AllocationConflict& conflict) {
    AllocationProblem out = problem_;
    out.transports.clear();
    out.constraints.clear();
    out.orders.clear();
    out.routes.clear();
    for (const TransportId t : conflict.transports) {
      if (!keep()) continue;
      index_[t.value] = static_cast<std::uint32_t>(out.transports.size());
      out.transports.push_back(problem_.transports[t.value]);
      out.transports.back().vehicle.reset();
    }
    for (const std::uint32_t c : conflict.constraints) {
      TransportConstraint constraint = problem_.constraints[c];
      if (keep() && map(constraint.from) && map(constraint.to)) out.constraints.push_back(constraint);
    }
    for (const TransportId t : conflict.vehicles) {
      if (keep() && index_.contains(t.value)) {
        out.transports[index_[t.value]].vehicle = problem_.transports[t.value].vehicle;
      }
    }
    for (const std::uint32_t o : conflict.orders) {
      const FixedOrder& order = problem_.orders[o];
      if (!keep() || !index_.contains(order.before.value) || !index_.contains(order.after.value)) continue;
      out.orders.push_back({TransportId(index_[order.before.value]), TransportId(index_[order.after.value])});
    }
    for (const std::uint32_t r : conflict.routes) {
      if (!keep()) continue;
      FixedRoute route = problem_.routes[r];
      std::erase_if(route.stops, [&](const FixedStop& s) { return !index_.contains(s.transport.value); });
      for (FixedStop& stop : route.stops) stop.transport = TransportId(index_[stop.transport.value]);
      out.routes.push_back(route);
    }
    return out;
  }

 private:
  bool keep() { return counted_++ != without_; }
  bool map(TransportTimepoint& t) {
    if (t.moment == TransportMoment::TimeZero || t.moment == TransportMoment::VehicleStart) return true;
    if (!index_.contains(t.index)) return false;
    t.index = index_[t.index];
    return true;
  }

  const AllocationProblem& problem_;
  std::size_t without_;
  std::size_t counted_ = 0;
  std::map<std::uint32_t, std::uint32_t> index_;
};

}  // namespace

std::optional<std::int64_t> best_by_enumeration(const AllocationProblem& problem) {
  return Enumeration(problem).run();
}

AllocationProblem reduced_to(const AllocationConflict& conflict, const AllocationProblem& problem,
                             std::size_t without) {
  return Reduction(problem, without).reduce(conflict);
}

}  // namespace stepwright::fleet

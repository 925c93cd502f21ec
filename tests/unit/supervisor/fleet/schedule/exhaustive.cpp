#include "tests/unit/supervisor/fleet/schedule/exhaustive.h"

#include <algorithm>
#include <chrono>
#include <limits>
#include <utility>

#include "tests/unit/supervisor/fleet/network/all_pairs.h"

namespace stepwright::fleet {

namespace {

using std::chrono::milliseconds;

class Orders {
 public:
  Orders(const Problem& problem, Mode mode, std::int64_t due_ms, const std::vector<SpatialPair>* only)
      : problem_(problem), mode_(mode), due_ms_(due_ms) {
    for (const TrajectoryEnvelope& e : problem.envelopes) first_.push_back(first_.back() + e.polygons.size());
    for (std::uint32_t v = 0; v < problem.envelopes.size(); ++v) vehicle(v);
    for (const TemporalConstraint& c : problem.constraints) {
      const Timepoint from = c.from ? at(c.from->at, c.from->side == Side::Exit) : kOrigin;
      between(from, at(c.to.at, c.to.side == Side::Exit), c.distance);
    }
    for (std::uint32_t v = 0; v < problem.envelopes.size(); ++v) {
      for (std::uint32_t w = v + 1; w < problem.envelopes.size(); ++w) meet(v, w);
    }
    if (only) {
      std::erase_if(pairs_, [&](const auto& p) {
        return std::ranges::find(*only, SpatialPair{p.first, p.second}) == only->end();
      });
    }
    found_.pairs = pairs_.size();
    found_.makespan_ms = found_.tardiness_ms = std::numeric_limits<std::int64_t>::max();
  }

  Exhaustive run() {
    descend(0);
    return found_;
  }

 private:
  Timepoint at(PolygonRef p, bool exit) const {
    return Timepoint(static_cast<std::uint32_t>(1 + 2 * (first_[p.vehicle] + p.polygon) + (exit ? 1 : 0)));
  }
  std::size_t timepoints() const { return 1 + 2 * first_.back(); }
  void least(Timepoint from, Timepoint to, std::int64_t ms) {
    constraints_.push_back({from, to, static_cast<std::int32_t>(ms), 0});
  }
  void between(Timepoint from, Timepoint to, const Bounds& bounds) {
    least(from, to, bounds.least.count());
    least(to, from, -bounds.most.count());
  }

  void vehicle(std::uint32_t v) {
    const auto& polygons = problem_.envelopes[v].polygons;
    for (std::uint32_t k = 0; k < polygons.size(); ++k) {
      between(at({v, k}, false), at({v, k}, true), polygons[k].stay);
      if (k + 1 == polygons.size()) break;
      between(at({v, k + 1}, false), at({v, k}, true), polygons[k].overlap);
      if (polygons[k].left_into == 2 && k + 2 < polygons.size())
        least(at({v, k + 2}, false), at({v, k}, true), 1);
      const auto overlap = polygons[k].overlap.least;
      const auto drive = [&](const Bounds& stay) {
        return std::max(milliseconds{0}, stay.least - overlap).count();
      };
      least(at({v, k}, false), at({v, k + 1}, false), drive(polygons[k].stay));
      least(at({v, k}, true), at({v, k + 1}, true), drive(polygons[k + 1].stay));
    }
  }

  void meet(std::uint32_t v, std::uint32_t w) {
    const auto& a = problem_.envelopes[v].polygons;
    const auto& b = problem_.envelopes[w].polygons;
    for (std::uint32_t i = 0; i < a.size(); ++i) {
      for (std::uint32_t k = 0; k < b.size(); ++k) {
        if (geometry::overlaps(a[i].area, b[k].area)) pairs_.push_back({{v, i}, {w, k}});
      }
    }
  }

  // The constraint of `first` before `second`; nothing where `first` is parked for ever, or `second` from
  // time zero.
  std::optional<Constraint> before(PolygonRef first, PolygonRef second) const {
    const bool for_ever = first.polygon + 1 == problem_.envelopes[first.vehicle].polygons.size();
    if (mode_ == Mode::Strict && (for_ever || second.polygon == 0)) return std::nullopt;
    return Constraint{at(first, true), at(second, false), 0, 0};
  }

  void descend(std::size_t pair) {
    const auto times = earliest_by_rounds(timepoints(), constraints_);
    if (!times) return;
    if (pair == pairs_.size()) {
      found_.feasible = true;
      std::int64_t makespan = 0, tardiness = 0;
      for (std::uint32_t v = 0; v < problem_.envelopes.size(); ++v) {
        const auto last = static_cast<std::uint32_t>(problem_.envelopes[v].polygons.size() - 1);
        const std::int64_t end = (*times)[at({v, last}, true).value];
        makespan = std::max(makespan, end);
        tardiness += std::max<std::int64_t>(0, end - due_ms_);
      }
      found_.makespan_ms = std::min(found_.makespan_ms, makespan);
      found_.tardiness_ms = std::min(found_.tardiness_ms, tardiness);
      return;
    }
    const auto [a, b] = pairs_[pair];
    for (const auto& order : {before(a, b), before(b, a)}) {
      if (!order) continue;
      constraints_.push_back(*order);
      descend(pair + 1);
      constraints_.pop_back();
    }
  }

  const Problem& problem_;
  Mode mode_;
  std::int64_t due_ms_;
  std::vector<std::size_t> first_ = {0};
  std::vector<Constraint> constraints_;
  std::vector<std::pair<PolygonRef, PolygonRef>> pairs_;
  Exhaustive found_;
};

}  // namespace

Exhaustive try_all_orders(const Problem& problem, Mode mode, std::int64_t due_ms,
                          const std::vector<SpatialPair>* only) {
  return Orders(problem, mode, due_ms, only).run();
}

}  // namespace stepwright::fleet

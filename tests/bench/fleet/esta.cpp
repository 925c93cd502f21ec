#include "tests/bench/fleet/esta.h"

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

#include "supervisor/fleet/schedule/motion.h"
#include "supervisor/fleet/schedule/sections.h"

namespace stepwright::bench::fleet {

namespace {

using namespace stepwright::fleet;
using std::chrono::milliseconds;

constexpr std::uint64_t kNodesBetweenLooks = 16;  // at the clock, which is not free

// distance(i, j): how much later than i timepoint j can be at most.
class Matrix {
 public:
  explicit Matrix(std::size_t size) : size_(size), most_(size * size, kHorizon_ms) {
    for (std::size_t t = 0; t < size; ++t) {
      at(t, 0) = 0;
      at(t, t) = 0;
    }
  }

  std::int32_t operator()(Timepoint from, Timepoint to) const { return most_[from.value * size_ + to.value]; }

  void tighten(const Constraint& c) {
    std::int32_t& cell = at(c.to.value, c.from.value);
    cell = std::min(cell, -c.least_ms);
  }
  // False: contradiction.
  bool close() {
    for (std::size_t k = 0; k < size_; ++k) {
      for (std::size_t i = 0; i < size_; ++i) relax(i, at(i, k), &at(k, 0));
    }
    for (std::size_t t = 0; t < size_; ++t) {
      if (at(t, t) < 0) return false;
    }
    return true;
  }
  bool post_afresh(const Constraint& c) {
    tighten(c);
    return close();
  }
  // One more constraint on a closed matrix.
  bool post(const Constraint& c) {
    const std::size_t u = c.to.value, v = c.from.value;
    const std::int32_t most = -c.least_ms;
    if (at(v, u) + most < 0) return false;
    if (at(u, v) <= most) return true;
    const std::vector<std::int32_t> from_v(&at(v, 0), &at(v, 0) + size_);
    for (std::size_t i = 0; i < size_; ++i) {
      const std::int32_t through = at(i, u) + most;
      if (through < at(i, v)) relax(i, through, from_v.data());
    }
    return true;
  }

 private:
  std::int32_t& at(std::size_t i, std::size_t j) { return most_[i * size_ + j]; }
  void relax(std::size_t row, std::int32_t to_middle, const std::int32_t* from_middle) {
    std::int32_t* cells = &at(row, 0);
    for (std::size_t j = 0; j < size_; ++j) cells[j] = std::min(cells[j], to_middle + from_middle[j]);
  }

  std::size_t size_;
  std::vector<std::int32_t> most_;
};

class Esta {
 public:
  Esta(const Instance& instance, Closure closure, const Cap& cap)
      : motion_(instance.envelopes, instance.constraints),
        closure_(closure),
        cap_(cap),
        until_s_(now_s() + cap.seconds),
        matrix_(motion_.timepoints()) {
    for (const SpatialPair& pair : overlapping_pairs(instance.envelopes)) {
      const auto centre = [&](PolygonRef p) {
        return instance.envelopes[p.vehicle].polygons[p.polygon].area.centroid();
      };
      pairs_.push_back({pair, 0.5 * (centre(pair.a) + centre(pair.b))});
    }
  }

  EstaResult run() {
    for (const Constraint& c : motion_.constraints()) matrix_.tighten(c);
    result_.found = matrix_.close() ? solve() : Found::None;
    if (result_.found == Found::Schedule) write_times();
    return result_;
  }

 private:
  struct Pair {
    SpatialPair polygons;
    geometry::Point middle;
  };

  double now_s() const {
    timespec time{};
    clock_gettime(cap_.clock, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
  }
  Timepoint at(PolygonRef p, Side side) const { return motion_.timepoint(p, side); }
  std::int32_t earliest(Timepoint t) const { return -matrix_(t, kOrigin); }

  std::vector<const Pair*> conflicts() const {
    std::vector<const Pair*> found;
    for (const Pair& pair : pairs_) {
      const auto [a, b] = pair.polygons;
      if (earliest(at(a, Side::Exit)) > earliest(at(b, Side::Entry)) &&
          earliest(at(b, Side::Exit)) > earliest(at(a, Side::Entry))) {
        found.push_back(&pair);
      }
    }
    return found;
  }

  static const Pair* choose(const std::vector<const Pair*>& conflicts) {
    const Pair* best = nullptr;
    double least_m = std::numeric_limits<double>::max();
    for (const Pair* one : conflicts) {
      double sum_m = 0.0;
      for (const Pair* other : conflicts) sum_m += geometry::distance(one->middle, other->middle);
      if (sum_m < least_m) best = one;
      least_m = std::min(least_m, sum_m);
    }
    return best;
  }

  Found solve() {
    const auto open = conflicts();
    if (open.empty()) return Found::Schedule;
    const auto [a, b] = choose(open)->polygons;
    std::pair<PolygonRef, PolygonRef> orders[2] = {{a, b}, {b, a}};
    const auto slack = [&](const auto& order) {
      return matrix_(at(order.first, Side::Exit), at(order.second, Side::Entry));
    };
    if (slack(orders[1]) > slack(orders[0])) std::swap(orders[0], orders[1]);
    const Matrix saved = matrix_;
    for (const auto& [first, second] : orders) {
      if (++result_.nodes % kNodesBetweenLooks == 0 && now_s() >= until_s_) return Found::TimeOut;
      const Constraint resolver{at(first, Side::Exit), at(second, Side::Entry), 0, 0};
      if (closure_ == Closure::Incremental ? matrix_.post(resolver) : matrix_.post_afresh(resolver)) {
        ++result_.resolvers;
        const Found found = solve();
        if (found != Found::None) return found;
        --result_.resolvers;
      }
      matrix_ = saved;
    }
    return Found::None;
  }

  void write_times() {
    for (std::uint32_t v = 0; v < motion_.vehicles(); ++v) {
      result_.earliest.emplace_back();
      for (std::uint32_t k = 0; k < motion_.polygons(v); ++k) {
        result_.earliest.back().push_back({milliseconds(earliest(at({v, k}, Side::Entry))),
                                           milliseconds(earliest(at({v, k}, Side::Exit)))});
      }
    }
  }

  Motion motion_;
  Closure closure_;
  Cap cap_;
  double until_s_;
  Matrix matrix_;
  std::vector<Pair> pairs_;
  EstaResult result_;
};

}  // namespace

EstaResult solve_esta(const Instance& instance, Closure closure, const Cap& cap) {
  return Esta(instance, closure, cap).run();
}

}  // namespace stepwright::bench::fleet

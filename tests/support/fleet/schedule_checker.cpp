#include "tests/support/fleet/schedule_checker.h"

#include <algorithm>
#include <chrono>
#include <random>
#include <utility>

#include "supervisor/fleet/network/network.h"
#include "supervisor/fleet/schedule/motion.h"

namespace stepwright::fleet {

namespace {

using std::chrono::milliseconds;

constexpr milliseconds kEver{kHorizon_ms};

class Judge {
 public:
  Judge(const std::vector<VehicleTimes>& times, std::span<const TrajectoryEnvelope> envelopes, Mode mode)
      : times_(times), envelopes_(envelopes), mode_(mode) {}

  void envelopes() {
    for (std::uint32_t v = 0; v < envelopes_.size(); ++v) {
      for (std::uint32_t k = 0; k < envelopes_[v].polygons.size(); ++k) polygon({v, k});
    }
  }

  void constraints(std::span<const TemporalConstraint> constraints) {
    for (const TemporalConstraint& c : constraints) {
      const milliseconds from = c.from ? at(*c.from) : milliseconds{0};
      expect(within(at(c.to) - from, c.distance), "constraint '" + c.name + "' is broken");
    }
  }

  void collisions() {
    for (std::uint32_t v = 0; v < envelopes_.size(); ++v) {
      for (std::uint32_t w = v + 1; w < envelopes_.size(); ++w) {
        for (std::uint32_t i = 0; i < envelopes_[v].polygons.size(); ++i) {
          for (std::uint32_t k = 0; k < envelopes_[w].polygons.size(); ++k) pair({v, i}, {w, k});
        }
      }
    }
  }

  std::vector<std::string> faults;

 private:
  const PolygonTimes& of(PolygonRef p) const { return times_[p.vehicle][p.polygon]; }
  milliseconds at(TimepointRef t) const { return t.side == Side::Entry ? of(t.at).entry : of(t.at).exit; }
  static bool within(milliseconds span, const Bounds& bounds) {
    return span >= bounds.least && (span <= bounds.most || bounds.most >= kEver);
  }
  void expect(bool holds, const std::string& fault) {
    if (!holds) faults.push_back(fault);
  }
  std::string name(PolygonRef p) const {
    return envelopes_[p.vehicle].vehicle + "[" + std::to_string(p.polygon) + "]";
  }

  void polygon(PolygonRef p) {
    const EnvelopePolygon& polygon = envelopes_[p.vehicle].polygons[p.polygon];
    expect(of(p).entry >= milliseconds{0} && of(p).exit <= kEver, name(p) + ": out of the horizon");
    expect(within(of(p).exit - of(p).entry, polygon.stay), name(p) + ": stay");
    if (p.polygon + 1 == envelopes_[p.vehicle].polygons.size()) return;
    const PolygonRef next{p.vehicle, p.polygon + 1};
    expect(within(of(p).exit - of(next).entry, polygon.overlap), name(p) + ": overlap");
    const auto last = static_cast<std::uint32_t>(envelopes_[p.vehicle].polygons.size() - 1);
    const PolygonRef into{p.vehicle, std::min(last, p.polygon + polygon.left_into)};
    expect(polygon.left_into == 1 || of(p).exit > of(into).entry || into == next,
           name(p) + ": left too soon");
    expect(of(p).entry <= of(next).entry && of(p).exit <= of(next).exit, name(p) + ": order");
  }

  void pair(PolygonRef p, PolygonRef q) {
    PolygonTimes a = of(p), b = of(q);
    if (mode_ == Mode::Strict) {
      for (auto [where, occupied] : {std::pair(p, &a), std::pair(q, &b)}) {
        if (where.polygon == 0) occupied->entry = milliseconds{-1};
        if (where.polygon + 1 == envelopes_[where.vehicle].polygons.size()) occupied->exit = 2 * kEver;
      }
    }
    if (a.exit <= b.entry || b.exit <= a.entry) return;
    const auto& area = [&](PolygonRef r) { return envelopes_[r.vehicle].polygons[r.polygon].area; };
    expect(!geometry::overlaps(area(p), area(q)), name(p) + " and " + name(q) + ": both at once");
  }

  const std::vector<VehicleTimes>& times_;
  std::span<const TrajectoryEnvelope> envelopes_;
  Mode mode_;
};

}  // namespace

std::vector<std::string> faults_of(const std::vector<VehicleTimes>& times,
                                   std::span<const TrajectoryEnvelope> envelopes,
                                   std::span<const TemporalConstraint> constraints, Mode mode) {
  Judge judge(times, envelopes, mode);
  judge.envelopes();
  judge.constraints(constraints);
  judge.collisions();
  return judge.faults;
}

std::vector<VehicleTimes> random_times(const Schedule& made, std::span<const TrajectoryEnvelope> envelopes,
                                       std::span<const TemporalConstraint> constraints, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const Motion motion(envelopes, constraints);
  Network network(motion.timepoints());
  bool consistent = network.post(motion.constraints());
  for (const Precedence& p : made.precedences) {
    consistent = consistent && network.post({motion.timepoint(p.first, Side::Exit),
                                             motion.timepoint(p.second, Side::Entry), 0, 0});
  }
  network.track_latest();
  std::vector<std::uint32_t> order;
  for (std::uint32_t t = 1; t < motion.timepoints(); ++t) order.push_back(t);
  std::ranges::shuffle(order, random);
  for (const std::uint32_t t : order) {
    const Timepoint point(t);
    std::int32_t least = network.earliest_ms(point), most = network.latest_ms(point);
    // Without this nearly all would stand still for a day.
    most = std::min(most, least + 60'000);
    const std::int32_t time = std::uniform_int_distribution<std::int32_t>(least, most)(random);
    consistent =
        consistent && network.post({kOrigin, point, time, 0}) && network.post({point, kOrigin, -time, 0});
  }
  std::vector<VehicleTimes> times;
  if (!consistent) return times;
  for (std::uint32_t v = 0; v < motion.vehicles(); ++v) {
    times.emplace_back();
    for (std::uint32_t k = 0; k < motion.polygons(v); ++k) {
      times.back().push_back({milliseconds(network.earliest_ms(motion.timepoint({v, k}, Side::Entry))),
                              milliseconds(network.earliest_ms(motion.timepoint({v, k}, Side::Exit)))});
    }
  }
  return times;
}

}  // namespace stepwright::fleet

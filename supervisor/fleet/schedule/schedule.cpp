#include "supervisor/fleet/schedule/schedule.h"

#include <cassert>
#include <numeric>
#include <utility>

#include "supervisor/fleet/schedule/internal/explain.h"
#include "supervisor/fleet/schedule/internal/model.h"
#include "supervisor/fleet/schedule/internal/search.h"

namespace stepwright::fleet {

namespace {

using std::chrono::milliseconds;
using WallClock = std::chrono::steady_clock;

class Stopwatch {
 public:
  double lap_ms() {
    const auto now = WallClock::now();
    const double passed = std::chrono::duration<double, std::milli>(now - since_).count();
    since_ = now;
    return passed;
  }

 private:
  WallClock::time_point since_ = WallClock::now();
};

class Scheduler {
 public:
  // `watch` has run since the question came.
  Scheduler(std::span<const TrajectoryEnvelope> envelopes, std::span<const TemporalConstraint> constraints,
            std::vector<SpatialPair> overlaps, const ScheduleOptions& options, const Stopwatch& watch)
      : watch_(watch),
        constraints_(constraints),
        options_(options),
        motion_(envelopes, constraints),
        sections_(merge_sections(std::move(overlaps), envelopes)) {
    if (options.time.count() > 0) limits_.until = WallClock::now() + options.time;
    limits_.cancel = options.cancel;
    limits_.conflicts = options.conflicts;
    made_.figures.polygons = motion_.polygons();
    made_.figures.spatial_pairs = sections_.pairs.size();
    made_.figures.sections = sections_.sections.size();
    made_.figures.geometry_ms = watch_.lap_ms();
  }

  Schedule run() {
    const std::vector<char> all_labels(motion_.labels().precedences(), 1);
    std::vector<std::uint32_t> all_sections(sections_.sections.size());
    std::iota(all_sections.begin(), all_sections.end(), 0U);
    const auto model = internal::make_model(motion_, sections_, options_.mode, all_labels, all_sections);
    const auto objective = internal::make_objective(motion_, options_);
    internal::Search search(model, objective, limits_);
    internal::Answer answer = search.next();
    made_.figures.search_ms = watch_.lap_ms();
    if (answer == internal::Answer::Yes) {
      improve(search, objective);
      write_down(model, search.orders());
    } else if (answer == internal::Answer::No) {
      made_.verdict = Verdict::Infeasible;
      if (options_.explain) {
        made_.core = internal::explain(motion_, sections_, constraints_, options_.mode, limits_,
                                       made_.figures.explain_conflicts);
      }
      made_.figures.explain_ms = watch_.lap_ms();
    } else {
      made_.verdict = answer == internal::Answer::Cancelled ? Verdict::Cancelled : Verdict::Exhausted;
    }
    made_.figures.decisions = search.figures().decisions;
    made_.figures.conflicts = search.figures().conflicts;
    made_.figures.restarts = search.figures().restarts;
    return std::move(made_);
  }

 private:
  // Better orders until there are none or the budget ends.
  void improve(internal::Search& search, const internal::SearchObjective& objective) {
    made_.verdict = Verdict::Scheduled;
    if (objective.measure == internal::Measure::None) return;
    auto answer = internal::Answer::Yes;
    while (answer == internal::Answer::Yes) answer = search.next();
    made_.proved_optimal = answer == internal::Answer::No;
    made_.objective = milliseconds(search.objective_ms());
    made_.lower_bound = milliseconds(search.lower_bound_ms());
    made_.figures.improve_ms = watch_.lap_ms();
  }

  void write_down(const internal::SearchModel& model, const std::vector<std::uint8_t>& orders) {
    Network network(motion_.timepoints());
    bool consistent = network.load(model.base);
    find_conflicts(network);
    consistent = consistent && (options_.mode == Mode::EarliestTimes ? order_overlaps(model, orders, network)
                                                                     : order_all(model, orders, network));
    assert(consistent && "the search has posted the same constraints");
    network.track_latest();
    made_.earliest = times([&](Timepoint t) { return network.earliest_ms(t); });
    made_.latest = times([&](Timepoint t) { return network.latest_ms(t); });
    made_.figures.times_ms = watch_.lap_ms();
  }

  void find_conflicts(const Network& network) {
    for (const SpatialPair& pair : sections_.pairs) {
      if (internal::overlap_in_time(motion_, network, pair)) made_.conflicts.push_back(pair);
    }
  }

  bool order(const internal::SearchModel& model, internal::Literal literal, Network& network) {
    for (const Constraint& c : model.edges_of(literal)) {
      if (!network.post(c)) return false;
      made_.precedences.push_back({motion_.polygon_of(c.from), motion_.polygon_of(c.to)});
    }
    return true;
  }

  bool order_all(const internal::SearchModel& model, const std::vector<std::uint8_t>& orders,
                 Network& network) {
    std::vector<Constraint> posted;
    for (std::uint32_t s = 0; s < sections_.sections.size(); ++s) {
      for (const Constraint& c : model.edges_of(internal::Literal::of(s, orders[s]))) {
        posted.push_back(c);
        made_.precedences.push_back({motion_.polygon_of(c.from), motion_.polygon_of(c.to)});
      }
    }
    return network.load(posted);
  }

  // Of the orders found, those alone without which earliest times would overlap.
  bool order_overlaps(const internal::SearchModel& model, const std::vector<std::uint8_t>& orders,
                      Network& network) {
    std::vector<std::uint32_t> open(sections_.sections.size());
    std::iota(open.begin(), open.end(), 0U);
    for (bool changed = true; changed;) {
      changed = false;
      std::vector<std::uint32_t> still_open;
      for (const std::uint32_t s : open) {
        bool overlap = false;
        for (const SpatialPair& pair : sections_.of(sections_.sections[s])) {
          overlap = overlap || internal::overlap_in_time(motion_, network, pair);
        }
        if (!overlap) still_open.push_back(s);
        if (overlap && !order(model, internal::Literal::of(s, orders[s]), network)) return false;
        changed = changed || overlap;
      }
      open = std::move(still_open);
    }
    return true;
  }

  template <typename At>
  std::vector<VehicleTimes> times(At&& at) const {
    std::vector<VehicleTimes> all(motion_.vehicles());
    for (std::uint32_t v = 0; v < motion_.vehicles(); ++v) {
      all[v].reserve(motion_.polygons(v));
      for (std::uint32_t k = 0; k < motion_.polygons(v); ++k) {
        all[v].push_back({milliseconds(at(motion_.timepoint({v, k}, Side::Entry))),
                          milliseconds(at(motion_.timepoint({v, k}, Side::Exit)))});
      }
    }
    return all;
  }

  Stopwatch watch_;
  std::span<const TemporalConstraint> constraints_;
  const ScheduleOptions& options_;
  Motion motion_;
  Sections sections_;
  internal::SearchLimits limits_;
  Schedule made_;
};

std::string place(PolygonRef at, std::span<const TrajectoryEnvelope> envelopes) {
  return envelopes[at.vehicle].vehicle + "[" + std::to_string(at.polygon) + "]";
}

}  // namespace

Schedule schedule(std::span<const TrajectoryEnvelope> envelopes,
                  std::span<const TemporalConstraint> constraints, const ScheduleOptions& options) {
  const Stopwatch watch;
  return Scheduler(envelopes, constraints, overlapping_pairs(envelopes), options, watch).run();
}

Schedule schedule(std::span<const TrajectoryEnvelope> envelopes,
                  std::span<const TemporalConstraint> constraints, std::vector<SpatialPair> overlaps,
                  const ScheduleOptions& options) {
  return Scheduler(envelopes, constraints, std::move(overlaps), options, Stopwatch()).run();
}

std::string to_string(const Core& core, std::span<const TrajectoryEnvelope> envelopes,
                      std::span<const TemporalConstraint> constraints) {
  std::string text;
  for (const auto& section : core.sections) {
    const SpatialPair& first = section.front();
    const SpatialPair& last = section.back();
    text += "one of " + envelopes[first.a.vehicle].vehicle + " and " + envelopes[first.b.vehicle].vehicle +
            " must come first where " + place(first.a, envelopes) + " meets " + place(first.b, envelopes);
    if (section.size() > 1) text += " up to " + place(last.a, envelopes) + " and " + place(last.b, envelopes);
    text += "\n";
  }
  for (const std::uint32_t vehicle : core.slowest) {
    text += envelopes[vehicle].vehicle + " may not drive slower than its envelope says\n";
  }
  for (const std::uint32_t constraint : core.constraints) {
    text += "constraint '" + constraints[constraint].name + "'\n";
  }
  if (text.empty() && !core.vehicles.empty()) {
    for (const std::uint32_t v : core.vehicles) text += envelopes[v].vehicle + " contradicts itself\n";
  }
  return text;
}

}  // namespace stepwright::fleet

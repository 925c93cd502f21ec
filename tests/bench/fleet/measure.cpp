#include "tests/bench/fleet/measure.h"

#include <fmt/format.h>
#include <time.h>

#include <algorithm>
#include <numeric>
#include <optional>
#include <utility>

#include "supervisor/fleet/schedule/problem_file.h"
#include "supervisor/fleet/schedule/retiming.h"
#include "supervisor/fleet/schedule/schedule.h"
#include "tests/bench/fleet/esta.h"
#include "tests/bench/fleet/referee.h"
#include "tests/support/fleet/schedule_checker.h"

namespace stepwright::bench::fleet {

namespace {

using namespace stepwright::fleet;
using WallClock = std::chrono::steady_clock;

template <typename Work>
double timed_ms(const Settings& settings, Work&& work) {
  const auto now_ms = [&] {
    timespec time{};
    clock_gettime(settings.cpu_time ? CLOCK_THREAD_CPUTIME_ID : CLOCK_MONOTONIC, &time);
    return 1e3 * static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_nsec);
  };
  const double start = now_ms();
  work();
  return now_ms() - start;
}

Cap cap_of(const Settings& settings) {
  return {settings.cpu_time ? CLOCK_THREAD_CPUTIME_ID : CLOCK_MONOTONIC, settings.cap_s};
}

struct Judged {
  std::vector<std::string> problems;
  std::vector<bool> scheduled;
};

// The answer of a baseline; what is kept is taken over where the instance is the same to the last character.
std::optional<Measured> measured_baseline(const Instance& instance, Closure closure, const Settings& settings,
                                          Kept* kept) {
  std::string key;
  if (kept != nullptr) {
    const std::string text = write_problem({instance.envelopes, instance.constraints});
    std::uint64_t hash = 0xcbf29ce484222325U;
    for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3U;
    key = fmt::format("{}-{:016x}-{}-{}", closure == Closure::Incremental ? "fair" : "literal", hash,
                      settings.cap_s, settings.cpu_time ? "cpu" : "wall");
    if (auto before = kept->find(key)) return before;
    if (settings.kept_only) return std::nullopt;
  }
  EstaResult result;
  Measured measured;
  measured.ms = timed_ms(settings, [&] { result = solve_esta(instance, closure, cap_of(settings)); });
  measured.nodes = result.nodes;
  measured.found = result.found == Found::TimeOut    ? "timeout"
                   : result.found == Found::Schedule ? "schedule"
                                                     : "none";
  measured.sound =
      result.found != Found::Schedule ||
      faults_of(result.earliest, instance.envelopes, instance.constraints, Mode::EarliestTimes).empty();
  if (kept != nullptr) kept->add(key, measured);
  return measured;
}

void run_baseline(const Instance& instance, Closure closure, const Settings& settings, bool scheduled,
                  Times& times, CircleRow& row) {
  const std::optional<Measured> answer = measured_baseline(
      instance, closure, settings, closure == Closure::FloydWarshall ? settings.kept : nullptr);
  if (!answer) return;
  const Measured& measured = *answer;
  times.nodes += measured.nodes;
  if (measured.found == "timeout") {
    ++times.timeouts;
    times.ms.push_back(std::max(measured.ms, 1000.0 * settings.cap_s));
    return;
  }
  times.ms.push_back(measured.ms);
  if ((measured.found == "schedule") != scheduled || !measured.sound) ++row.baseline_disagreements;
}

void judge(const Judged& judged, const Settings& settings, CircleRow& row, std::string& error) {
  const auto rulings = decide(judged.problems, settings.folder, 60);
  if (!rulings) {
    error = "z3 gave no answers";
    return;
  }
  for (std::size_t k = 0; k < rulings->size(); ++k) {
    if ((*rulings)[k] == Ruling::Unknown) {
      ++row.unjudged;
    } else if (((*rulings)[k] == Ruling::Schedule) != judged.scheduled[k]) {
      ++row.disagreements;
    }
  }
}

// Whether the checker finds something; in strict mode at earliest, latest and 100 random times.
std::uint32_t faulty(const Schedule& made, const Instance& instance, Mode mode) {
  std::vector<std::vector<VehicleTimes>> all = {made.earliest};
  if (mode == Mode::Strict) {
    all.push_back(made.latest);
    for (std::uint64_t seed = 0; seed < 100; ++seed) {
      all.push_back(random_times(made, instance.envelopes, instance.constraints, seed));
    }
  }
  const auto wrong = [&](const std::vector<VehicleTimes>& times) {
    return times.empty() || !faults_of(times, instance.envelopes, instance.constraints, mode).empty();
  };
  return std::ranges::any_of(all, wrong) ? 1 : 0;
}

// Ends of random polygons, each 5 s late, one after the other.
void measure_retiming(const Instance& instance, const Schedule& made, const Settings& settings,
                      WarehouseRow& row) {
  Retiming retiming(instance.envelopes, instance.constraints, made);
  constexpr std::uint32_t kDelays = 50;
  std::uint64_t random = 1;
  for (std::uint32_t k = 0; k < kDelays; ++k) {
    random = random * 6364136223846793005U + 1442695040888963407U;
    const auto vehicle = static_cast<std::uint32_t>((random >> 33) % instance.envelopes.size());
    const auto polygons = static_cast<std::uint32_t>(instance.envelopes[vehicle].polygons.size());
    const TimepointRef late{{vehicle, static_cast<std::uint32_t>((random >> 17) % polygons)}, Side::Exit};
    const auto time = retiming.earliest(late) + std::chrono::seconds(5);
    bool met = false;
    const double ms = timed_ms(settings, [&] { met = retiming.not_before(late, time); });
    if (!met) ++row.faults;
    row.retime_ms += ms / kDelays;
    row.retime_worst_ms = std::max(row.retime_worst_ms, ms);
  }
  if (instance.envelopes.size() <= 100 &&
      !faults_of(retiming.earliest(), instance.envelopes, instance.constraints, Mode::Strict).empty()) {
    ++row.faults;
  }
}

}  // namespace

double Times::mean() const {
  return ms.empty() ? 0.0 : std::accumulate(ms.begin(), ms.end(), 0.0) / static_cast<double>(ms.size());
}

double Times::quantile(double share) const {
  if (ms.empty()) return 0.0;
  std::vector<double> sorted = ms;
  std::ranges::sort(sorted);
  const auto place = static_cast<std::size_t>(share * static_cast<double>(sorted.size() - 1) + 0.5);
  return sorted[place];
}

CircleRow measure_circle(CircleSource& source, std::uint32_t vehicles, const Settings& settings,
                         std::string& error) {
  CircleRow row{.vehicles = vehicles, .ours = {}, .fair = {}, .literal = {}};
  Judged judged;
  for (std::uint32_t run = 0; run < settings.runs; ++run) {
    const Instance instance = source.instance(vehicles, run, settings.v_max_mps);
    row.most_polygons = std::max(row.most_polygons, instance.polygons());
    const ScheduleOptions options{.mode = Mode::EarliestTimes, .explain = false};
    Schedule made;
    row.ours.ms.push_back(
        timed_ms(settings, [&] { made = schedule(instance.envelopes, instance.constraints, options); }));
    const bool scheduled = made.verdict == Verdict::Scheduled;
    (scheduled ? row.scheduled : row.infeasible) += 1;
    row.ours.nodes += made.figures.decisions;
    row.conflicts += made.conflicts.size();
    if (scheduled) row.faults += faulty(made, instance, Mode::EarliestTimes);
    run_baseline(instance, Closure::Incremental, settings, scheduled, row.fair, row);
    if (settings.literal && run < settings.literal_runs) {
      run_baseline(instance, Closure::FloydWarshall, settings, scheduled, row.literal, row);
    }
    judged.scheduled.push_back(scheduled);
    made = schedule(instance.envelopes, instance.constraints, {.explain = false});
    const bool strictly = made.verdict == Verdict::Scheduled;
    judged.scheduled.push_back(strictly);
    if (strictly) {
      ++row.strictly_scheduled;
      row.faults += faulty(made, instance, Mode::Strict);
    }
    if (!settings.referee) continue;
    judged.problems.push_back(smt_text(instance, Mode::EarliestTimes));
    judged.problems.push_back(smt_text(instance, Mode::Strict));
  }
  if (settings.referee) judge(judged, settings, row, error);
  return row;
}

WarehouseRow measure_warehouse(std::uint32_t vehicles, const Settings& settings) {
  Vehicle vehicle;
  vehicle.v_min_mps = 0.0;  // it may stop
  vehicle.growth_m = 1.0;
  vehicle.goal_polygon = true;
  const Instance instance = warehouse(vehicles, 0, vehicle);
  WarehouseRow row{.vehicles = static_cast<std::uint32_t>(instance.envelopes.size())};
  row.polygons = instance.polygons();
  std::vector<std::pair<double, Schedule>> made;
  for (int round = 0; round < 3; ++round) {
    Schedule one;
    const ScheduleOptions options{.mode = Mode::Strict, .time = std::chrono::seconds(20), .explain = false};
    const double ms =
        timed_ms(settings, [&] { one = schedule(instance.envelopes, instance.constraints, options); });
    made.emplace_back(ms, std::move(one));
  }
  std::ranges::sort(made, {}, [](const auto& m) { return m.first; });
  const auto& [ms, one] = made[1];
  if (instance.envelopes.size() <= 200 && one.verdict == Verdict::Scheduled) {
    for (const auto& times : {one.earliest, one.latest}) {
      if (!faults_of(times, instance.envelopes, instance.constraints, Mode::Strict).empty()) ++row.faults;
    }
  }
  row.schedule_ms = ms;
  row.geometry_ms = one.figures.geometry_ms;
  row.search_ms = one.figures.search_ms;
  row.pairs = one.figures.spatial_pairs;
  row.sections = one.figures.sections;
  row.conflicts = one.figures.conflicts;
  row.scheduled = one.verdict == Verdict::Scheduled;
  if (row.scheduled) measure_retiming(instance, one, settings, row);
  return row;
}

}  // namespace stepwright::bench::fleet

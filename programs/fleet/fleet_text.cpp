#include "programs/fleet/fleet_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "supervisor/fleet/mission/explain_schedule.h"

namespace stepwright::fleet {

namespace {

using std::chrono::milliseconds;

// "2:07.4"
std::string clock_time(milliseconds time) {
  const auto tenths = (time.count() + 50) / 100;
  return fmt::format("{}:{:02}.{}", tenths / 600, tenths / 10 % 60, tenths % 10);
}

double seconds(milliseconds time) {
  return static_cast<double>(time.count()) / 1000.0;
}

class Text {
 public:
  explicit Text(const FleetAnswer& answer) : answer_(answer), plan_(answer.plan) {}

  std::string scheduled(const std::string& problem) {
    print_head(problem);
    print_vehicles();
    print_changes();
    print_ways_given();
    print_waits();
    print_figures();
    return std::move(text_);
  }

 private:
  template <typename... T>
  void print(fmt::format_string<T...> format, T&&... values) {
    fmt::format_to(std::back_inserter(text_), format, std::forward<T>(values)...);
  }

  void print_head(const std::string& problem) {
    const Schedule& made = plan_.schedule;
    milliseconds end{0};
    for (const VehicleTimes& times : made.earliest) end = std::max(end, times.back().exit);
    print("{}: {} vehicle{}, done after {}", problem, plan_.missions.size(),
          plan_.missions.size() == 1 ? "" : "s", clock_time(end));
    if (made.proved_optimal) {
      print(" (optimal for these paths, proved)");
    } else if (made.lower_bound.count() > 0) {
      print(" (at least {} for these paths)", clock_time(made.lower_bound));
    }
    if (answer_.allocation) {
      print("; loads: {}", answer_.allocation->verdict == AllocationVerdict::Optimal
                               ? "best allocation, proved for lone vehicles"
                               : "best allocation found");
    }
    print("\n");
  }

  void print_vehicles() {
    std::size_t wide = 7;
    for (const VehicleMission& mission : plan_.missions) wide = std::max(wide, mission.vehicle.size());
    print("\n{:<{}}  {:>8}  {:>8}  {:>8}\n", "vehicle", wide, "polygons", "path m", "arrives");
    for (std::size_t v = 0; v < plan_.missions.size(); ++v) {
      const VehicleMission& mission = plan_.missions[v];
      const VehicleTimes& times = plan_.schedule.earliest[v];
      print("{:<{}}  {:>8}  {:>8.1f}  {:>8}\n", mission.vehicle, wide, times.size(),
            mission.path.empty() ? 0.0 : mission.path.back().arc_m, clock_time(times.back().exit));
      for (std::size_t k = 0; k < mission.stops.size(); ++k) print_stop(v, k);
    }
  }

  void print_stop(std::size_t v, std::size_t k) {
    const VehicleMission& mission = plan_.missions[v];
    const Stop& stop = mission.stops[k];
    const milliseconds end = plan_.schedule.earliest[v][mission.grown.stands[k]].exit;
    std::string does = "stops";
    if (stop.kind == StopKind::PickUp) does = fmt::format("picks up {} of {}", stop.amount, stop.goal);
    if (stop.kind == StopKind::SetDown) does = fmt::format("sets down {} of {}", stop.amount, stop.goal);
    if (stop.kind == StopKind::GiveWay) does = "gives way";
    print("  {:>8}  {} at {}{}\n", clock_time(end), does, stop.location,
          stop.aboard > 0 ? fmt::format(", {} aboard", stop.aboard) : std::string());
  }

  void print_changes() {
    if (answer_.changes.empty()) return;
    print("\nThe first paths leave no schedule:\n");
    for (const PathChange& change : answer_.changes) {
      std::string around;
      for (const std::uint32_t v : change.around)
        around += (around.empty() ? "" : ", ") + plan_.missions[v].vehicle;
      print("  {} drives around {}, {:.1f} m {}\n", plan_.missions[change.vehicle].vehicle, around,
            std::abs(change.longer_m), change.longer_m < 0.0 ? "less" : "more");
    }
  }

  void print_ways_given() {
    if (answer_.gave_way.empty()) return;
    print("\nNo paths from where they stand leave a schedule:\n");
    for (const GaveWay& move : answer_.gave_way) {
      print("  {} gives way to others first, at ({:.1f} m, {:.1f} m)\n", plan_.missions[move.vehicle].vehicle,
            move.place.x_m, move.place.y_m);
    }
  }

  void print_waits() {
    const auto waits = waits_of(plan_);
    if (waits.empty()) {
      print("\nnobody waits\n");
      return;
    }
    print("\nwaits\n");
    for (const Wait& wait : waits) {
      print("  {:>8}  {} waits {:.1f} s for {} at ({:.1f} m, {:.1f} m)\n", clock_time(wait.from),
            plan_.missions[wait.waiting].vehicle, seconds(wait.until - wait.from),
            plan_.missions[wait.first].vehicle, wait.place.x_m, wait.place.y_m);
    }
  }

  void print_figures() {
    const FleetFigures& f = answer_.figures;
    const Schedule& made = plan_.schedule;
    print("\n{} conflicts, {} precedences in {} critical sections\n", made.conflicts.size(),
          made.precedences.size(), made.figures.sections);
    print("{:.0f} ms: allocation {:.0f}, paths {:.0f}, envelopes {:.0f}, schedule {:.1f}", f.total_ms,
          f.allocation_ms, f.paths_ms, f.envelopes_ms, f.schedule_ms);
    if (f.repair_ms > 0.0) print(", other paths {:.0f}", f.repair_ms);
    print(", improving {:.0f}\n", f.improve_ms);
  }

  const FleetAnswer& answer_;
  const FleetPlan& plan_;
  std::string text_;
};

const char* none_is_proved(Proof proof) {
  switch (proof) {
    case Proof::ThisAllocation:
      return "no schedule was found; that there is none is proved for these paths only, with loads shared "
             "out "
             "as they are";
    case Proof::PathsFound:
      return "no schedule was found; that there is none is proved for the paths found, not for all";
    default:
      return "there is no schedule, proved";
  }
}

}  // namespace

std::string fleet_text(const FleetAnswer& answer, const std::string& problem) {
  if (answer.verdict == Verdict::Scheduled) return Text(answer).scheduled(problem);
  switch (answer.verdict) {
    case Verdict::Infeasible:
      return fmt::format("{}: {}:\n{}", problem, none_is_proved(answer.proof), answer.reason);
    case Verdict::Cancelled:
      return fmt::format("{}: cancelled before there was a schedule\n", problem);
    default:
      return fmt::format("{}: {}", problem,
                         answer.reason.empty() ? "the budget ended first\n" : answer.reason);
  }
}

}  // namespace stepwright::fleet

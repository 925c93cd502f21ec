#include "supervisor/fleet/program/mission_chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "supervisor/vehicle/chart_builder.h"
#include "supervisor/vehicle/literals.h"

namespace stepwright::fleet {
namespace {

using graphic::all;
using graphic::compare;
using graphic::CompareOp;
using graphic::Condition;
using graphic::contact;
using graphic::Qualifier;
using graphic::StepId;
using vehicle::real_literal;
using vehicle::time_literal;

constexpr double kArrived_m = 0.06;
constexpr std::chrono::milliseconds kNoLoad{2'000};  // behind the end of a lift
constexpr double kNever = std::numeric_limits<double>::infinity();

const char* word(StopKind kind) {
  switch (kind) {
    case StopKind::PickUp:
      return "PICK_UP";
    case StopKind::SetDown:
      return "SET_DOWN";
    case StopKind::GiveWay:
      return "GIVE_WAY";
    case StopKind::Park:
      break;
  }
  return "PARK";
}

class Writer {
 public:
  Writer(const FleetPlan& plan, const std::vector<std::string>& names, const Interlocks& interlocks,
         std::uint32_t vehicle, const ProgramOptions& options)
      : plan_(plan),
        mission_(plan.missions[vehicle]),
        names_(names),
        name_(names[vehicle]),
        interlocks_(interlocks),
        vehicle_(vehicle),
        options_(options) {
    const double v = mission_.speed.max_mps;
    // So early that a vehicle that may go on does not brake.
    reach_m_ = v * v / (2.0 * options.drive.brake_m_s2) + v + options.margins.halt_before_m;
  }

  MissionChart build() {
    const StepId start = step({"START", MissionStepKind::Start}, "the way begins");
    chart_.action(
        "BEGIN",
        fmt::format("vehicle_{0}.Arc := 0.0;\nvehicle_{0}.Point := 0;\nvehicle_{0}.Area := 0;\n"
                    "vehicle_{0}.Areas := 0;\npermitted_{0} := 0.0;\nlate_{0} := FALSE;\nlate_for_{0} := 0;\n"
                    "fleet_epoch := fleet_clock;\nfleet_time := T#0s;\n",
                    name_) +
            forgotten_events(),
        Qualifier::P1);
    std::vector<Condition> conditions;
    std::string comment;
    add_times(ChartPlace::Start, 0, conditions, comment);
    // The clock was set by the step itself.
    if (!conditions.empty()) conditions.push_back(compare("START.T", CompareOp::GreaterEqual, "T#1ms"));
    StepId at = polygon_step();
    happened(EventKind::Begun, 0);
    chart_.transition(start, at, conditions.empty() ? graphic::always() : all(std::move(conditions)),
                      comment);
    while (true) {
      const double stop_m = stop_ < mission_.stops.size() ? mission_.stops[stop_].arc_m : kNever;
      if (stop_m < next_halt_m()) {
        at = stop_step(at);
      } else if (polygon_ + 1 < polygons()) {
        at = enter_next(at);
      } else {
        break;
      }
    }
    finish(at);
    return {chart_.take(), std::move(steps_)};
  }

 private:
  std::size_t polygons() const { return mission_.grown.visits.size(); }
  double end_m() const { return mission_.path.back().arc_m; }
  double next_halt_m() const {
    return polygon_ + 1 < polygons() ? interlocks_.places[vehicle_].halt_m[polygon_ + 1] : kNever;
  }

  StepId step(MissionStep info, std::string comment) {
    const StepId made = chart_.step(info.name, std::move(comment));
    steps_.push_back(std::move(info));
    return made;
  }

  Condition beyond(double arc_m) const {
    return compare("arc_" + name_, CompareOp::GreaterEqual, real_literal(arc_m));
  }

  // A step that lets the vehicle drive as far as it may within its polygon.
  StepId polygon_step() {
    const double stop_m = stop_ < mission_.stops.size() ? mission_.stops[stop_].arc_m : kNever;
    const double permitted = std::max(0.0, std::min({stop_m, next_halt_m(), end_m()}));
    std::string name = fmt::format("P{:03}", polygon_);
    if (part_ > 1) name += fmt::format("_{}", part_);
    const StepId made = step({name, MissionStepKind::Polygon, polygon_, 0, permitted},
                             fmt::format("may be in polygon {}, up to {:.2f} m", polygon_, permitted));
    chart_.action(name + "_GO", fmt::format("permitted_{} := {};\n", name_, real_literal(permitted)));
    return made;
  }

  StepId enter_next(StepId from) {
    ++polygon_;
    part_ = 1;
    std::vector<Condition> conditions = {beyond(interlocks_.places[vehicle_].halt_m[polygon_] - reach_m_)};
    std::string comment;
    for (const Interlock& wait : interlocks_.before[vehicle_][polygon_]) {
      conditions.push_back(compare("areas_" + names_[wait.vehicle], CompareOp::GreaterEqual,
                                   std::to_string(wait.polygon + 1)));
      comment += fmt::format("{}{} has left polygon {}", comment.empty() ? "" : ", ",
                             plan_.missions[wait.vehicle].vehicle, wait.polygon);
    }
    add_times(ChartPlace::Polygon, polygon_, conditions, comment);
    const StepId to = polygon_step();
    chart_.transition(from, to, all(std::move(conditions)), comment);
    return to;
  }

  // What temporal constraints ask for at this place.
  void add_times(ChartPlace place, std::size_t index, std::vector<Condition>& conditions,
                 std::string& comment) const {
    const auto& waits = interlocks_.times.waits;
    for (std::size_t k = 0; k < waits.size(); ++k) {
      const TimeWait& wait = waits[k];
      if (wait.vehicle != vehicle_ || wait.place != place || wait.index != index) continue;
      const std::string& name = plan_.constraints[wait.constraint].name;
      const std::string time = time_literal(wait.delay);
      const std::string since = wait.event ? " after " + event_name(*wait.event) : "";
      if (!wait.event) {
        conditions.push_back(compare("fleet_time", CompareOp::GreaterEqual, time));
      } else {
        conditions.push_back(contact(wait.delay.count() > 0 ? waited_name(k) : event_name(*wait.event)));
      }
      comment += fmt::format("{}not before {}{} ({})", comment.empty() ? "" : ", ", time, since, name);
    }
  }

  // Of the step that was written last: that the vehicle has come to it is what others wait for.
  void happened(EventKind kind, std::size_t index) {
    const auto& events = interlocks_.times.events;
    for (std::uint32_t k = 0; k < events.size(); ++k) {
      if (events[k] != MissionEvent{kind, vehicle_, static_cast<std::uint32_t>(index)}) continue;
      chart_.action(steps_.back().name + "_EVENT", event_name(k) + " := TRUE;\n", Qualifier::P1);
    }
  }

  std::string forgotten_events() const {
    std::string text;
    const auto& events = interlocks_.times.events;
    for (std::uint32_t k = 0; k < events.size(); ++k) {
      if (events[k].vehicle == vehicle_ && set_by_chart(events[k])) text += event_name(k) + " := FALSE;\n";
    }
    return text;
  }

  StepId stop_step(StepId from) {
    const Stop& stop = mission_.stops[stop_];
    const std::string name = fmt::format("S{:02}_{}", stop_ + 1, word(stop.kind));
    const StepId at = step({name, MissionStepKind::Stop, polygon_, stop_, stop.arc_m},
                           fmt::format("{} at {}", stop.goal.empty() ? "stop" : stop.goal, stop.location));
    const bool forks = moves_load(stop.kind);
    if (forks) {
      chart_.drives("move_forks_" + name_);
      chart_.drives("raise_" + name_, stop.kind == StopKind::PickUp ? Qualifier::S : Qualifier::R);
    }
    std::vector<Condition> begin = {beyond(stop.arc_m - kArrived_m), contact("standing_" + name_)};
    std::string begin_comment;
    add_times(ChartPlace::StopBegin, stop_, begin, begin_comment);
    chart_.transition(from, at, all(std::move(begin)), begin_comment);
    std::vector<Condition> conditions = {
        compare(name + ".T", CompareOp::GreaterEqual, time_literal(stop.service))};
    std::string comment;
    add_times(ChartPlace::StopEnd, stop_, conditions, comment);
    if (forks) conditions.push_back(contact("forks_done_" + name_));
    const bool checks = stop.kind == StopKind::PickUp && options_.load_switches;
    if (checks) conditions.push_back(contact("loaded_" + name_));
    const std::size_t stop_index = stop_++;
    ++part_;
    const StepId next = polygon_step();
    happened(EventKind::StopDone, stop_index);
    chart_.transition(at, next, all(std::move(conditions)), comment);
    if (checks) add_failure(at, name, stop, stop_index);
    return next;
  }

  void add_failure(StepId at, const std::string& name, const Stop& stop, std::size_t stop_index) {
    const StepId failed = step({"FAILED_" + name, MissionStepKind::Failed, polygon_, stop_index, stop.arc_m},
                               "no load on the forks");
    chart_.drives("no_load_" + name_);
    chart_.transition(
        at, failed,
        all({contact("forks_done_" + name_), contact("loaded_" + name_, true),
             compare(name + ".T", CompareOp::GreaterEqual, time_literal(stop.service + kNoLoad))}),
        "no load on the forks");
  }

  void finish(StepId from) {
    const StepId done = step({"DONE", MissionStepKind::Done, polygon_, 0, end_m()}, "the way ends");
    chart_.drives("done_" + name_);
    std::vector<Condition> conditions = {beyond(end_m() - kArrived_m), contact("standing_" + name_)};
    std::string comment;
    add_times(ChartPlace::End, 0, conditions, comment);
    chart_.transition(from, done, all(std::move(conditions)), comment);
  }

  const FleetPlan& plan_;
  const VehicleMission& mission_;
  const std::vector<std::string>& names_;
  const std::string& name_;
  const Interlocks& interlocks_;
  std::uint32_t vehicle_;
  const ProgramOptions& options_;
  double reach_m_ = 0.0;
  std::size_t polygon_ = 0;
  std::size_t stop_ = 0;
  int part_ = 1;  // of the polygon, between its stops
  vehicle::ChartBuilder chart_;
  std::vector<MissionStep> steps_;
};

}  // namespace

MissionChart mission_chart(const FleetPlan& plan, const std::vector<std::string>& names,
                           const Interlocks& interlocks, std::uint32_t vehicle,
                           const ProgramOptions& options) {
  return Writer(plan, names, interlocks, vehicle, options).build();
}

std::string event_name(std::size_t event) {
  return fmt::format("event_{}", event + 1);
}

std::string waited_name(std::size_t wait) {
  return fmt::format("waited_{}", wait + 1);
}

bool set_by_chart(const MissionEvent& event) {
  return event.kind == EventKind::Begun || event.kind == EventKind::StopDone;
}

}  // namespace stepwright::fleet

#include "supervisor/fleet/program/fleet_program.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>
#include <stdexcept>

#include "ladder/driver/compile.h"
#include "ladder/driver/sheets.h"
#include "ladder/exchange/plcopen_reader.h"
#include "ladder/exchange/plcopen_writer.h"
#include "ladder/graphic/sfc_drawing.h"
#include "ladder/graphic/sfc_hazards.h"
#include "supervisor/fleet/program/driving_times.h"
#include "supervisor/fleet/program/interlocks.h"
#include "tests/support/fleet_program/planned_fleet.h"
#include "tests/unit/supervisor/fleet/control/made_path.h"

namespace stepwright::fleet {
namespace {

using namespace std::chrono_literals;
using geometry::Point;

FleetProgram program_of(const FleetPlan& plan) {
  auto made = fleet_program(plan, terminals_in_a_row(plan.missions.size()), {});
  if (!made) throw std::runtime_error(result::to_string(made.error()));
  return std::move(*made);
}

std::string code_of(const FleetPlan& plan, const ProgramOptions& options = {}) {
  const auto made = fleet_program(plan, terminals_in_a_row(plan.missions.size()), options);
  return made ? "" : made.error().front().code;
}

const graphic::SfcChart& chart_of(const FleetProgram& program, std::size_t mission) {
  for (const graphic::Pou& pou : program.project.pous) {
    if (pou.name == program.missions[mission].program) return std::get<graphic::SfcChart>(pou.body);
  }
  throw std::runtime_error("no chart");
}

bool mentions(const graphic::Condition& condition, const std::string& name, const std::string& operand) {
  if (condition.kind == graphic::ConditionKind::Comparison && condition.name == name &&
      condition.operand == operand) {
    return true;
  }
  return std::ranges::any_of(condition.children,
                             [&](const graphic::Condition& each) { return mentions(each, name, operand); });
}

geometry::ConvexPolygon box(double low_x, double low_y, double high_x, double high_y) {
  const std::array<Point, 4> corners = {
      Point{low_x, low_y}, {high_x, low_y}, {high_x, high_y}, {low_x, high_y}};
  return *geometry::ConvexPolygon::hull(corners);
}

// Straight along a line of y, in polygons that begin every `step_m` of the way.
VehicleMission straight(const std::string& name, Point from, double heading, double length_m, double step_m) {
  VehicleMission mission;
  mission.vehicle = name;
  mission.path = MadePath({from.x_m, from.y_m, heading}).drive(length_m).path();
  const double way_x = std::cos(heading), way_y = std::sin(heading);
  for (double entry = 0.0; entry < length_m - 1e-9; entry += step_m) {
    const double leaves = std::min(length_m, entry + step_m + 0.3);
    const Point a{from.x_m + way_x * (entry - 3.0), from.y_m + way_y * (entry - 3.0)};
    const Point b{from.x_m + way_x * (leaves + 3.0), from.y_m + way_y * (leaves + 3.0)};
    mission.grown.envelope.polygons.push_back(
        {box(std::min(a.x_m, b.x_m) - 1.0, std::min(a.y_m, b.y_m) - 1.0, std::max(a.x_m, b.x_m) + 1.0,
             std::max(a.y_m, b.y_m) + 1.0),
         {},
         {}});
    mission.grown.visits.push_back({0, 0, entry, leaves});
  }
  mission.grown.envelope.vehicle = name;
  set_times(mission.grown, {.min_mps = 0.0});
  return mission;
}

// Two ways that cross.
FleetPlan crossing(double step_m = 2.0, Mode mode = Mode::Strict) {
  FleetPlan plan;
  plan.missions = {straight("a", {0, 20}, 0.0, 40.0, step_m),
                   straight("b", {20, 0}, std::numbers::pi / 2, 40.0, step_m)};
  plan.schedule = schedule(envelopes_of(plan), {}, {.mode = mode});
  EXPECT_EQ(plan.schedule.verdict, Verdict::Scheduled);
  return plan;
}

TEST(FleetProgram, WhenMade_ThenStepsArePolygonsAndStopsAndEveryPrecedenceIsAContactOfATransition) {
  const FleetPlan plan = plan_warehouse(5);
  const FleetProgram program = program_of(plan);
  ASSERT_EQ(program.missions.size(), 5U);
  for (std::size_t v = 0; v < 5; ++v) {
    const graphic::SfcChart& chart = chart_of(program, v);
    EXPECT_TRUE(graphic::check(chart).empty());
    EXPECT_TRUE(graphic::find_hazards(chart).empty());
    std::set<std::size_t> polygons;
    std::size_t stops = 0;
    double permitted = 0.0;
    for (const MissionStep& step : program.missions[v].steps) {
      if (step.kind == MissionStepKind::Polygon) polygons.insert(step.polygon);
      if (step.kind == MissionStepKind::Stop) ++stops;
      EXPECT_GE(step.permitted_m, permitted);
      permitted = step.permitted_m;
    }
    EXPECT_EQ(polygons.size(), plan.missions[v].grown.visits.size());
    EXPECT_EQ(stops, plan.missions[v].stops.size());
    EXPECT_EQ(chart.steps.size(), program.missions[v].steps.size());
  }
  EXPECT_EQ(program.figures.interlocks, plan.schedule.precedences.size());
  for (const Precedence& wait : plan.schedule.precedences) {
    const graphic::SfcChart& chart = chart_of(program, wait.second.vehicle);
    const auto& steps = program.missions[wait.second.vehicle].steps;
    bool found = false;
    for (const graphic::Transition& transition : chart.transitions) {
      const MissionStep& to = steps[transition.targets.front().value];
      found |= to.kind == MissionStepKind::Polygon && to.polygon == wait.second.polygon &&
               mentions(transition.condition, "areas_" + program.missions[wait.first.vehicle].name,
                        std::to_string(wait.first.polygon + 1));
    }
    EXPECT_TRUE(found) << wait.second.vehicle << " " << wait.second.polygon;
  }
}

TEST(FleetProgram, WhenWrittenAsPlcopen_ThenItReadsBackAndBothCompileWithoutWarning) {
  const FleetProgram program = program_of(crossing());
  driver::CompileInput input;
  input.projects = {&program.project};
  input.lint = lint::Level::Default;
  const auto compiled = driver::compile(input);
  ASSERT_TRUE(compiled) << result::to_string(compiled.error());
  EXPECT_TRUE(compiled->warnings.empty()) << result::to_string(compiled->warnings);
  EXPECT_EQ(driver::compile(input)->container, compiled->container);
  const auto xml = exchange::write_plcopen(program.project);
  ASSERT_TRUE(xml) << result::to_string(xml.error());
  auto back = exchange::read_plcopen("fleet.xml", *xml);
  ASSERT_TRUE(back) << result::to_string(back.error());
  input.projects = {&*back};
  const auto again = driver::compile(input);
  ASSERT_TRUE(again) << result::to_string(again.error());
  EXPECT_TRUE(again->warnings.empty()) << result::to_string(again->warnings);
  const auto sheets = driver::sheets_of({.texts = {}, .projects = {&program.project}});
  ASSERT_TRUE(sheets) << result::to_string(sheets.error());
  EXPECT_GE(sheets->size(), 4U);
  for (std::size_t v = 0; v < 2; ++v) {
    EXPECT_TRUE(graphic::draw_sfc_text(chart_of(program, v)));
    const auto svg = graphic::draw_sfc_svg(chart_of(program, v));
    ASSERT_TRUE(svg);
    EXPECT_NE(svg->find("data-step=\"P003\""), std::string::npos);
  }
}

TEST(FleetProgram, WhenThePlanChanges_ThenItsTablesHaveOtherNames) {
  const auto names = [](const FleetPlan& plan) {
    std::vector<std::string> tables;
    for (const graphic::Variable& each : program_of(plan).project.globals) {
      if (each.type.starts_with("ARRAY")) tables.push_back(each.name);
    }
    return tables;
  };
  FleetPlan plan = crossing();
  const auto before = names(plan);
  EXPECT_EQ(before, names(plan));
  ASSERT_EQ(before.size(), 6U);
  // By a millimetre, of one vehicle.
  plan.missions[0].path[8].pose.y_m += 0.001;
  const auto after = names(plan);
  EXPECT_NE(before[0], after[0]);
  EXPECT_EQ(before[3], after[3]);
}

TEST(FleetProgram, WhenVehiclesHaveNamesThatAreNone_ThenVariablesHaveLegalOnesAndAllDiffer) {
  FleetPlan plan = crossing();
  plan.missions[0].vehicle = "Stapler 1";
  plan.missions[1].vehicle = "stapler-1";
  const FleetProgram program = program_of(plan);
  EXPECT_NE(program.missions[0].name, program.missions[1].name);
  EXPECT_TRUE(driver::compile({.texts = {}, .projects = {&program.project}}));
}

TEST(FleetProgram, WhenAVehicleHasNothingToDo_ThenItsChartIsDoneAtOnce) {
  FleetPlan plan = crossing();
  VehicleMission& idle = plan.missions[0];
  idle.path.resize(1);
  idle.grown.visits = {{0, 0, 0.0, 0.0}};
  auto& polygons = idle.grown.envelope.polygons;
  polygons.erase(polygons.begin() + 1, polygons.end());
  plan.schedule = schedule(envelopes_of(plan), {}, {});
  const FleetProgram program = program_of(plan);
  EXPECT_EQ(program.missions[0].steps.size(), 3U);
  EXPECT_TRUE(driver::compile({.texts = {}, .projects = {&program.project}}));
}

TEST(FleetProgram, WhenThePlanIsNoneThatCanBeRun_ThenThePartIsNamed) {
  FleetPlan plan = crossing();
  plan.schedule.verdict = Verdict::Exhausted;
  EXPECT_EQ(code_of(plan), "F1101");
  plan = crossing();
  plan.missions[1].grown.visits.pop_back();
  EXPECT_EQ(code_of(plan), "F1101");
  plan = crossing();
  plan.schedule.precedences.push_back({{7, 0}, {0, 1}});
  EXPECT_EQ(code_of(plan), "F1101");
  plan = crossing();
  plan.missions[1].stops.resize(2);
  plan.missions[1].stops[0].arc_m = 30.0;
  EXPECT_EQ(code_of(plan), "F1101");
  plan = crossing();
  plan.missions[0].path[7].arc_m = 0.01;
  EXPECT_EQ(code_of(plan), "F1101");
  plan = crossing();
  plan.missions[0].model.wheelbase_m = -1.0;
  EXPECT_EQ(code_of(plan), "F0201");
  plan = crossing();
  plan.missions[0].speed.max_mps = 0.0;
  EXPECT_EQ(code_of(plan), "F0502");
  // An order is missing: with a delay the two could meet.
  plan = crossing();
  ASSERT_FALSE(plan.schedule.precedences.empty());
  plan.schedule.precedences.pop_back();
  EXPECT_EQ(code_of(plan), "F1102");
  // Polygons without a place between them to wait at.
  plan = crossing();
  plan.schedule.precedences.push_back({{0, 12}, {1, 3}});
  plan.schedule.precedences.push_back({{1, 12}, {0, 3}});
  const auto made = fleet_program(plan, terminals_in_a_row(2), {});
  ASSERT_FALSE(made);
  EXPECT_EQ(made.error().front().code, "F1103");
  EXPECT_NE(made.error().front().message.find("'a' could never enter its polygon 3"), std::string::npos);
}

// Each of the two takes the place that the other one leaves; between both it is 0.2 m in a polygon of its
// own, too short to wait there.
FleetPlan changing_places() {
  const auto place = [](double x) { return box(x, 0.0, x + 2.0, 2.0); };
  FleetPlan plan;
  plan.missions = {straight("a", {0, 20}, 0.0, 20.0, 2.0), straight("b", {0, 40}, 0.0, 20.0, 2.0)};
  double apart_m = 100.0;
  for (VehicleMission& mission : plan.missions) {
    auto& polygons = mission.grown.envelope.polygons;
    for (EnvelopePolygon& polygon : polygons) polygon.area = place(apart_m += 5.0);
    polygons[4].area = place(mission.vehicle == "a" ? 0.0 : 10.0);
    polygons[6].area = place(mission.vehicle == "a" ? 10.0 : 0.0);
    auto& visits = mission.grown.visits;
    visits[3].exit_m = 8.1;
    visits[4] = {0, 0, 8.0, 8.3};
    visits[5] = {0, 0, 8.2, 8.5};
    visits[6].entry_m = 8.4;
    set_times(mission.grown, {.min_mps = 0.0});
  }
  return plan;
}

TEST(FleetProgram, WhenVehiclesCannotWaitWhereTheyWouldChangePlaces_ThenTheScheduleLetsOneGoThroughFirst) {
  FleetPlan plan = changing_places();
  plan.schedule = schedule(envelopes_of(plan), {}, {.mode = Mode::Strict});
  ASSERT_EQ(plan.schedule.verdict, Verdict::Scheduled);
  EXPECT_EQ(code_of(plan), "F1103") << "whoever knows only the polygons has them change places";
  for (VehicleMission& mission : plan.missions) set_driving_times(mission, {});
  EXPECT_EQ(plan.missions[0].grown.envelope.polygons[4].left_into, 2U);
  EXPECT_EQ(plan.missions[0].grown.envelope.polygons[1].left_into, 1U);
  plan.schedule = schedule(envelopes_of(plan), {}, {.mode = Mode::Strict});
  ASSERT_EQ(plan.schedule.verdict, Verdict::Scheduled);
  const auto made = find_interlocks(plan, {});
  EXPECT_TRUE(made) << result::to_string(made.error());
}

TEST(FleetProgram, WhenTheScheduleLooksAtEarliestTimesOnly_ThenItIsRefused) {
  FleetPlan plan;
  plan.missions = {straight("a", {0, 20}, 0.0, 60.0, 2.0),
                   straight("b", {50, 0}, std::numbers::pi / 2, 40.0, 2.0)};
  plan.schedule = schedule(envelopes_of(plan), {}, {.mode = Mode::EarliestTimes});
  ASSERT_EQ(plan.schedule.verdict, Verdict::Scheduled);
  EXPECT_EQ(code_of(plan), "F1102");
}

TEST(FleetProgram, WhenFiguresOrTerminalsAreWrong_ThenTheyAreNamed) {
  FleetPlan plan = crossing();
  plan.missions[0].path[9].pose.x_m = 400.0;
  EXPECT_EQ(code_of(plan), "F1104");
  plan.missions[0].path[9].pose.x_m = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(code_of(plan), "F1104");
  plan = crossing();
  ProgramOptions options;
  options.drive.brake_m_s2 = 0.0;
  EXPECT_EQ(code_of(plan, options), "F1105");
  EXPECT_EQ(fleet_program(plan, terminals_in_a_row(3), {}).error().front().code, "F1105");
  FleetTerminals terminals = terminals_in_a_row(2);
  terminals.vehicles[1].heading.clear();
  const auto made = fleet_program(plan, terminals, {});
  ASSERT_FALSE(made);
  EXPECT_NE(made.error().front().message.find("'b' has no terminal for heading"), std::string::npos);
}

constexpr std::chrono::milliseconds kNever{100'000'000};

bool mentions_contact(const graphic::Condition& condition, const std::string& name) {
  if (condition.kind == graphic::ConditionKind::Contact && condition.name == name) return true;
  return std::ranges::any_of(condition.children,
                             [&](const graphic::Condition& each) { return mentions_contact(each, name); });
}

// The condition under which a step is entered.
const graphic::Condition& condition_into(const FleetProgram& program, std::size_t mission, const char* step) {
  const graphic::SfcChart& chart = chart_of(program, mission);
  for (const graphic::Transition& transition : chart.transitions) {
    if (chart.steps[transition.targets.front().value].name == step) return transition.condition;
  }
  throw std::runtime_error("no such step");
}

const std::string& sensing_of(const FleetProgram& program) {
  return std::get<graphic::StBody>(program.project.pous.front().body).text;
}

void expect_compiles(const FleetProgram& program) {
  driver::CompileInput input;
  input.projects = {&program.project};
  input.lint = lint::Level::Default;
  const auto compiled = driver::compile(input);
  ASSERT_TRUE(compiled) << result::to_string(compiled.error());
  EXPECT_TRUE(compiled->warnings.empty()) << result::to_string(compiled->warnings);
}

TEST(FleetProgram, WhenAConstraintSaysNotBefore_ThenATransitionWaits) {
  FleetPlan plan = crossing();
  plan.constraints = {{"gate opens", std::nullopt, {{0, 3}, Side::Entry}, {90s, kNever}},
                      {"is available", std::nullopt, {{1, 0}, Side::Entry}, {7s, kNever}},
                      {"not home too soon", std::nullopt, {{1, 19}, Side::Exit}, {200s, kNever}},
                      {"leaves late", std::nullopt, {{1, 0}, Side::Exit}, {11s, kNever}}};
  const FleetProgram program = program_of(plan);
  EXPECT_TRUE(program.warnings.empty());
  EXPECT_TRUE(program.limits.empty());
  EXPECT_TRUE(mentions(condition_into(program, 0, "P003"), "fleet_time", "T#90s"));
  EXPECT_FALSE(mentions(condition_into(program, 0, "P002"), "fleet_time", "T#90s"));
  EXPECT_TRUE(mentions(condition_into(program, 1, "P000"), "fleet_time", "T#7s"));
  EXPECT_TRUE(mentions(condition_into(program, 1, "P001"), "fleet_time", "T#11s"));
  EXPECT_TRUE(mentions(condition_into(program, 1, "DONE"), "fleet_time", "T#200s"));
  expect_compiles(program);
}

TEST(FleetProgram, WhenConstraintsRelateVehicles_ThenOneWaitsForTheOtherAndForTheTimeBetween) {
  FleetPlan plan = crossing();
  const std::uint32_t early = plan.schedule.precedences.front().first.vehicle;
  const std::uint32_t late = 1 - early;
  plan.constraints = {
      {"five seconds behind", TimepointRef{{early, 2}, Side::Exit}, {{late, 3}, Side::Entry}, {5s, kNever}},
      {"at once", TimepointRef{{early, 4}, Side::Entry}, {{late, 5}, Side::Entry}, {0ms, kNever}},
      // The other way round: the first comes 2 s before the second at least.
      {"before", TimepointRef{{late, 6}, Side::Entry}, {{early, 5}, Side::Entry}, {-kNever, -2s}}};
  const FleetProgram program = program_of(plan);
  EXPECT_TRUE(program.warnings.empty()) << result::to_string(program.warnings);
  EXPECT_TRUE(mentions_contact(condition_into(program, late, "P003"), "waited_1"));
  EXPECT_NE(sensing_of(program).find("PT := T#5s"), std::string::npos);
  const std::string left = "event_1 := areas_" + program.missions[early].name + " >= 3;";
  EXPECT_NE(sensing_of(program).find(left), std::string::npos);
  EXPECT_TRUE(mentions_contact(condition_into(program, late, "P006"), "waited_3"));
  expect_compiles(program);
}

TEST(FleetProgram, WhenAConstraintSaysNotAfter_ThenItIsWatchedAndWhoMissesItIsLate) {
  FleetPlan plan = crossing();
  plan.constraints = {
      {"deadline", std::nullopt, {{1, 3}, Side::Exit}, {{}, 500s}},
      {"soon", TimepointRef{{0, 2}, Side::Entry}, {{0, 9}, Side::Entry}, {-kNever, 60s}},
      {"not long before", TimepointRef{{0, 6}, Side::Entry}, {{1, 6}, Side::Entry}, {-9s, kNever}}};
  const FleetProgram program = program_of(plan);
  EXPECT_TRUE(program.warnings.empty());
  ASSERT_EQ(program.limits.size(), 3U);
  EXPECT_EQ(program.limits[0].vehicle, 1U);
  EXPECT_EQ(program.limits[0].within, 500s);
  EXPECT_EQ(program.limits[1].vehicle, 0U);
  // At most 9 s after the second one the first one has to come.
  EXPECT_EQ(program.limits[2].vehicle, 0U);
  EXPECT_EQ(program.limits[2].constraint, 2U);
  EXPECT_NE(sensing_of(program).find("fleet_time > T#500s"), std::string::npos);
  EXPECT_NE(sensing_of(program).find("late_for_a := 3;"), std::string::npos);
  expect_compiles(program);
}

// The end of a stop is the end of its service, not the way behind it; what cannot wait before, waits at the
// stop.
TEST(FleetProgram, WhenAConstraintIsOfStops_ThenTheStopWaitsAndItsEndIsWaitedFor) {
  FleetPlan plan = crossing();
  const std::uint32_t early = plan.schedule.precedences.front().first.vehicle;
  const std::uint32_t late = 1 - early;
  for (const std::uint32_t v : {early, late}) {
    Stop stop;
    stop.location = "here";
    stop.arc_m = 4.2;
    stop.service = 2s;
    plan.missions[v].stops = {stop};
    plan.missions[v].grown.stands = {1};
  }
  plan.constraints = {
      {"end to end", TimepointRef{{early, 1}, Side::Exit}, {{late, 1}, Side::Exit}, {3s, kNever}},
      {"start to start", TimepointRef{{early, 1}, Side::Entry}, {{late, 1}, Side::Entry}, {-1s, kNever}}};
  const FleetProgram program = program_of(plan);
  EXPECT_TRUE(program.warnings.empty()) << result::to_string(program.warnings);
  EXPECT_TRUE(program.limits.empty());
  EXPECT_TRUE(mentions_contact(condition_into(program, late, "S01_PARK"), "waited_2"));
  const graphic::SfcChart& chart = chart_of(program, late);
  bool ends = false;
  for (const graphic::Transition& transition : chart.transitions) {
    const std::string& from = chart.steps[transition.sources.front().value].name;
    ends |= from == "S01_PARK" && mentions_contact(transition.condition, "waited_1");
  }
  EXPECT_TRUE(ends);
  bool sets = false;
  for (const graphic::Action& action : chart_of(program, early).actions) {
    sets |= action.st_body == "event_1 := TRUE;\n" && action.name.starts_with("P00");
  }
  EXPECT_TRUE(sets);
  expect_compiles(program);
}

// Waiting for what comes only behind it would never end: that part is left out, and said.
TEST(FleetProgram, WhenAConstraintAsksToWaitForWhatComesBehind_ThenItIsWarnedAbout) {
  FleetPlan plan = crossing();
  const Precedence order = plan.schedule.precedences.front();
  plan.constraints = {{"against the order",
                       TimepointRef{order.second, Side::Exit},
                       {order.first, Side::Entry},
                       {0ms, kNever}}};
  const FleetProgram program = program_of(plan);
  ASSERT_EQ(program.warnings.size(), 1U);
  EXPECT_EQ(program.warnings[0].code, "F1106");
  EXPECT_NE(program.warnings[0].message.find("'against the order'"), std::string::npos);
  plan.constraints[0].to.at.polygon = 1000;
  EXPECT_EQ(code_of(plan), "F1101");
}

}  // namespace
}  // namespace stepwright::fleet

#include "tests/bench/campaign/arms.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <utility>

#include "cell/campaign/spread.h"
#include "cell/missions/tamp/arms_cell.h"
#include "cell/runtime/robot_cell_plant.h"
#include "plant_models/assemblies/robot_cell.h"
#include "plant_models/core/counter_random.h"
#include "runtime/ground/result/value_or_throw.h"

namespace stepwright::campaign {
namespace {

using nlohmann::json;
using run::Phase;
using support::PlantFault;
using support::SimulatedController;

constexpr std::array<const char*, 3> kOrders = {"P1", "P5", "cups apart"};
constexpr std::array<const char*, 8> kKinds = {"none",  "drop", "slip",   "move",
                                               "stuck", "trip", "camera", "block"};
// An arm cannot be stopped sooner before what is put into its way: two pictures, and the way to rest.
constexpr double kUnavoidable_s = 2.5;
constexpr double kSeen_m = 0.01;   // of where a thing is: what the camera and a grasp may be off
constexpr double kUnseen_s = 0.5;  // before the end: less than two pictures, which have to agree

struct ArmsOrderCell {
  explicit ArmsOrderCell(const char* order)
      : config(result::value_or_throw(config::load_cell_config(
            STEPWRIGHT_SOURCE_DIR "/tests/cells/robot_cell/cell.toml",
            {std::string("tamp.order=\"") + order + "\"", "tamp.attended=false", "tamp.time_s=3600"}))),
        planning(result::value_or_throw(missions::open_arms_planning(config))) {}

  config::CellConfig config;
  tamp::mission::ArmsPlanning planning;
};

const ArmsOrderCell& cell_of(std::size_t order) {
  static const std::array<ArmsOrderCell, 3> cells = {ArmsOrderCell(kOrders[0]), ArmsOrderCell(kOrders[1]),
                                                     ArmsOrderCell(kOrders[2])};
  return cells.at(order);
}

std::vector<PlantFault> faults_of(const std::string& kind, const core::CounterRandom& random) {
  std::uint64_t draw = 10;
  const auto pick = [&](std::uint64_t count) { return random.bits(draw++) % count; };
  const double at_s = 1.5 + 0.1 * static_cast<double>(pick(150));
  const double until_s = at_s + 0.3 + 0.1 * static_cast<double>(pick(20));
  const std::string arm = pick(2) == 0 ? "left" : "right";
  const auto joint = std::to_string(1 + pick(7));
  if (kind == "drop") return {{at_s, "drop_" + arm, 1.0}, {until_s, "drop_" + arm, 0.0, true}};
  if (kind == "slip") return {{at_s, "slip_" + arm, 0.95}, {until_s, "slip_" + arm, 0.0, true}};
  if (kind == "move") {
    constexpr std::array<const char*, 4> kThings = {"cup1", "cup2", "can1", "can2"};
    const std::string axis = pick(2) == 0 ? "x" : "y";
    const double by_mm = (pick(2) == 0 ? -1.0 : 1.0) * static_cast<double>(15 + pick(45));
    return {{at_s, "shift_" + axis + "_" + kThings.at(pick(4)), by_mm}};
  }
  if (kind == "stuck") return {{at_s, "stuck_" + arm + "_" + joint, 1.0}};
  if (kind == "trip") return {{at_s, "overcurrent_" + arm + "_" + joint, 1.0}};
  if (kind == "block") {
    std::vector<PlantFault> faults = {{at_s, "block_1", 1.0}};
    if (pick(2) == 0) faults.push_back({at_s + 6.0, "block_1", 0.0, true});
    return faults;
  }
  if (kind == "camera") return {{at_s, "camera_loss", 0.3}, {at_s, "camera_ghosts", 2.0}};
  return {};
}

// The thing that was moved so late that no two pictures show it; empty: none was.
std::string moved_unseen(const std::vector<PlantFault>& faults, double end_s) {
  for (const PlantFault& each : faults)
    if (each.name.starts_with("shift_") && each.at_s > end_s - kUnseen_s)
      return each.name.substr(each.name.rfind('_') + 1);
  return {};
}

// Whether the plant's things are where the order wants them, but for one that nobody can know of.
std::string not_there(const ArmsOrderCell& cell, const SimulatedController& controller,
                      const std::string& unseen) {
  const tamp::scene::RobotCell& scene = cell.planning.cell();
  for (const tamp::mission::Wanted& each : cell.planning.first_order().wanted) {
    const tamp::scene::Thing& thing = scene.things[static_cast<std::size_t>(each.thing)];
    if (thing.name == unseen) continue;
    const tamp::scene::Pose pose{controller.plant_value("x_" + thing.name),
                                 controller.plant_value("y_" + thing.name),
                                 controller.plant_value("z_" + thing.name), 0.0};
    const tamp::scene::Surface& surface = scene.surfaces[static_cast<std::size_t>(each.surface)];
    if (!lies_within(surface, thing.form, pose, kSeen_m) || std::abs(pose.z_m - surface.middle.z_m) > 0.002)
      return fmt::format("{} is at {:.3f} {:.3f} {:.3f}", thing.name, pose.x_m, pose.y_m, pose.z_m);
  }
  return {};
}

// Somewhere on the table.
void place_blockage(const core::CounterRandom& random, assemblies::RobotCellParameters& parameters) {
  const double along = 0.5 * (1.0 + random.symmetric(50)), across = random.symmetric(51);
  parameters.blockages.front().frame.place = {0.42 + 0.4 * along, 0.6 * across, 0.8};
}

// Who touched what, if an arm did that should not. The post stands since `stands_s`.
std::string touched(const ArmsRun& run, const assemblies::RobotCell& plant, double stands_s) {
  using assemblies::IncidentKind;
  const bool pushed = run.kind == "drop" || run.kind == "slip" || run.kind == "move";
  for (const assemblies::Incident& each : plant.judge().incidents()) {
    const bool arms = each.kind == IncidentKind::ArmArm || each.kind == IncidentKind::ArmFixed ||
                      (each.kind == IncidentKind::ArmObject && !pushed);
    const bool unavoidable = plant.judge().name(each.b) == "post" && each.at_s < stands_s + kUnavoidable_s;
    if (arms && !unavoidable) return plant.judge().text(each);
  }
  return {};
}

// What a report has to say of a joint that is stuck: "joint 4 of the right arm does not move", of
// "stuck_right_4".
std::string named_joint(const std::string& fault) {
  const std::size_t joint = fault.rfind('_'), arm = fault.find('_') + 1;
  return fmt::format("joint {} of the {} arm does not move", fault.substr(joint + 1),
                     fault.substr(arm, joint - arm));
}

// Likewise of a drive that trips: "a drive of the right arm has tripped", of "overcurrent_right_4".
std::string named_drive(const std::string& fault) {
  const std::size_t joint = fault.rfind('_'), arm = fault.find('_') + 1;
  return fmt::format("a drive of the {} arm has tripped", fault.substr(arm, joint - arm));
}

// Empty if the disturbance can give that reason.
std::string wrong_stop(const ArmsRun& run) {
  const std::string& message = run.record.message;
  const auto says = [&](const std::string& words) { return message.find(words) != std::string::npos; };
  if (run.record.incidents.empty() || message.empty()) return "given up without a reason";
  if (run.kind == "stuck") return says(named_joint(run.fault)) ? "" : "stopped for: " + message;
  if (run.kind == "trip") return says(named_drive(run.fault)) ? "" : "stopped for: " + message;
  if (run.kind == "block") return says("in the way") || says("is blocked") ? "" : "stopped for: " + message;
  // What lies on the floor, or was moved out of reach, has no plan.
  if (run.kind == "camera" && (says("is not seen") || says("does not show"))) return {};
  const bool may = run.kind == "drop" || run.kind == "slip" || run.kind == "move";
  return may && (says("no plan") || says("is not seen") || says("time with")) ? ""
                                                                              : "stopped for: " + message;
}

void judge(const ArmsOrderCell& cell, const SimulatedController& controller,
           const assemblies::RobotCell& plant, const std::vector<PlantFault>& faults, double stands_s,
           ArmsRun& run) {
  const double end_s = 1e-9 * static_cast<double>(plant.now().count());
  const bool done = run.record.phase == Phase::Done;
  // Things that fall or that somebody moves may touch others; arms never do.
  run.why = touched(run, plant, stands_s);
  if (run.why.empty()) run.why = wrong_end(run.record, controller);
  if (!run.why.empty()) return;
  run.why = done ? not_there(cell, controller, moved_unseen(faults, end_s)) : wrong_stop(run);
  if (run.why.empty()) run.verdict = done ? Verdict::GoalReached : Verdict::SafeStop;
}

void add(const ArmsRun& run, ArmsClass& figures) {
  ++figures.runs;
  if (run.verdict == Verdict::GoalReached) ++figures.goals;
  if (run.verdict == Verdict::SafeStop) ++figures.safe_stops;
  if (run.verdict == Verdict::Lost) ++figures.lost;
  figures.replans += run.record.replans.size();
  figures.worst_replans = std::max<std::uint64_t>(figures.worst_replans, run.record.replans.size());
}

double mean(std::uint64_t sum, std::uint64_t count) {
  return count == 0 ? 0.0 : static_cast<double>(sum) / static_cast<double>(count);
}

}  // namespace

ArmsRun run_arms(std::uint64_t seed) {
  const core::CounterRandom random(seed, 901);
  ArmsRun run;
  run.seed = seed;
  run.kind = kKinds.at(seed % kKinds.size());
  const std::size_t order = random.bits(0) % kOrders.size();
  run.order = kOrders.at(order);
  const std::vector<PlantFault> faults = faults_of(run.kind, random);
  run.story = run.order;
  if (!faults.empty()) run.fault = faults.front().name;
  for (const PlantFault& fault : faults)
    fmt::format_to(std::back_inserter(run.story), ", {} = {:g} at {:g} s", fault.name, fault.value,
                   fault.at_s);
  const ArmsOrderCell& cell = cell_of(order);
  config::PlantConfig plant = cell.config.plant;
  plant.seed = seed + 1;
  auto parameters = result::value_or_throw(cell_runtime::robot_cell_parameters(plant));
  place_blockage(random, parameters);
  auto simulated = result::value_or_throw(assemblies::RobotCell::create(parameters));
  const assemblies::RobotCell& truth = *simulated;  // of the controller from here on
  SimulatedController controller(std::move(simulated), cell_runtime::robot_cell_wires(plant),
                                 {cell.config.image.input_bytes, cell.config.image.output_bytes}, faults);
  double stands_s = -1.0;  // it may have to wait until there is room
  controller.on_scan = [&](std::span<const std::byte>) {
    if (run.kind == "block" && stands_s < 0.0 && controller.plant_value("blocked_1") != 0.0)
      stands_s = 1e-9 * static_cast<double>(truth.now().count());
  };
  auto options = result::value_or_throw(missions::arms_options(cell.config, cell.planning));
  options.journal.clear();
  try {
    run.record = tamp::mission::ArmsMission(cell.planning, controller, std::move(options), {}).run();
    judge(cell, controller, truth, faults, stands_s, run);
  } catch (const std::exception& problem) {  // a run that hangs
    run.why = problem.what();
  }
  return run;
}

std::uint64_t ArmsFigures::runs() const {
  const auto all = of.find("all");
  return all == of.end() ? 0 : all->second.runs;
}

ArmsFigures arms_campaign(std::uint64_t first, std::uint64_t runs, unsigned threads,
                          const std::function<void(std::uint64_t done)>& told,
                          const std::atomic<bool>* cancel) {
  ArmsFigures figures;
  const auto run = [&](std::uint64_t i) { return run_arms(first + i); };
  const auto take = [&](ArmsRun result) {
    add(result, figures.of[result.kind]);
    add(result, figures.of["all"]);
    if (result.verdict == Verdict::Lost) figures.lost.push_back(std::move(result));
  };
  figures.wall_s = spread(runs, threads, told, cancel, run, take);
  std::ranges::sort(figures.lost, {}, &ArmsRun::seed);
  return figures;
}

std::string table(const ArmsFigures& figures) {
  std::string text = fmt::format("{:<10} {:>6} {:>6} {:>6} {:>5} {:>8} {:>5}\n", "kind", "runs", "goal",
                                 "safe", "lost", "replans", "most");
  const auto out = std::back_inserter(text);
  for (const auto& [kind, f] : figures.of)
    fmt::format_to(out, "{:<10} {:>6} {:>6} {:>6} {:>5} {:>8.2f} {:>5}\n", kind, f.runs, f.goals,
                   f.safe_stops, f.lost, mean(f.replans, f.runs), f.worst_replans);
  fmt::format_to(out, "{:.1f} s\n", figures.wall_s);
  for (const ArmsRun& lost : figures.lost) {
    fmt::format_to(out, "LOST seed {} ({}): {}\n", lost.seed, lost.story, lost.why);
    for (const run::Replan& replan : lost.record.replans)
      fmt::format_to(out, "  {:.2f} s: {}\n", replan.time_s, replan.cause);
  }
  return text;
}

std::string to_json(const ArmsFigures& figures, std::uint64_t first, unsigned threads) {
  json document = {
      {"cell", "robot_cell"}, {"first_seed", first}, {"threads", threads}, {"wall_s", figures.wall_s}};
  document["classes"] = json::array();
  for (const auto& [kind, f] : figures.of) {
    json entry = {{"class", kind},
                  {"runs", f.runs},
                  {"goals_reached", f.goals},
                  {"safe_stops", f.safe_stops},
                  {"lost", f.lost},
                  {"replans_mean", mean(f.replans, f.runs)},
                  {"replans_max", f.worst_replans}};
    if (kind == "all")
      document.update(entry);
    else
      document["classes"].push_back(std::move(entry));
  }
  document["lost_seeds"] = json::array();
  for (const ArmsRun& run : figures.lost)
    document["lost_seeds"].push_back({{"seed", run.seed}, {"story", run.story}, {"why", run.why}});
  return document.dump(2);
}

}  // namespace stepwright::campaign

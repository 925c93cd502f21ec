#include "tests/unit/supervisor/tamp/mission/arms_cell.h"

#include <utility>

#include "plant_models/assemblies/robot_cell.h"
#include "runtime/ground/files/files.h"
#include "runtime/ground/result/value_or_throw.h"
#include "tests/support/arms_program/arms_rig.h"
#include "tests/support/tamp_cells/paper_cells.h"

namespace stepwright::tamp::mission::testing {
namespace {

constexpr std::size_t kSlots = 4;

ArmsPlanning open(const std::string& goal, double following_rad) {
  ArmsPlanningOptions options;
  options.cell = paper_cell();
  const std::string domain = STEPWRIGHT_SOURCE_DIR "/tests/cells/robot_cell/stacking_arms.pddl";
  options.domain = {domain, result::value_or_throw(files::read_file(domain))};
  options.orders = {
      result::value_or_throw(read_order(options.cell, goal, goal, "test")),
      result::value_or_throw(read_order(options.cell, "across", "(in cup1 red-region)", "test"))};
  options.terminals = program::cell_terminals_in_a_row(options.cell.arms.size(), kSlots);
  options.program.following_rad = following_rad;
  options.most_s = 600.0;
  return result::value_or_throw(ArmsPlanning::open(std::move(options)));
}

std::unique_ptr<core::Plant> plant_of(std::uint64_t seed, std::vector<assemblies::FixedBody> blockages) {
  return result::value_or_throw(assemblies::RobotCell::create(
      test::plant_of(paper_cell(), {.seed = seed, .slots = kSlots, .blockages = std::move(blockages)})));
}

std::vector<std::string> arms() {
  std::vector<std::string> names;
  for (const scene::ArmModel& each : paper_cell().arms) names.push_back(each.name);
  return names;
}

}  // namespace

const scene::RobotCell& paper_cell() {
  static const scene::RobotCell cell = test::paper_problem("p1").value().cell;
  return cell;
}

ArmsCell::ArmsCell(const std::string& goal, std::vector<support::PlantFault> faults, std::uint64_t seed,
                   std::vector<assemblies::FixedBody> blockages, double following_rad)
    : planning_(open(goal, following_rad)),
      controller_(plant_of(seed, std::move(blockages)), bridge::default_robot_cell_wires(arms(), kSlots),
                  {program::input_bytes_in_a_row(2, kSlots), program::output_bytes_in_a_row(2)},
                  std::move(faults)) {}

run::RunRecord ArmsCell::run(ArmsMissionOptions options, ArmsMission::Observer observer) {
  return ArmsMission(planning_, controller_, std::move(options), std::move(observer)).run();
}

double ArmsCell::contacts() const {
  return truth("contacts_arm_arm") + truth("contacts_arm_fixed") + truth("contacts_arm_object") +
         truth("contacts_object_object") + truth("contacts_object_fixed");
}

std::string story(const run::RunRecord& record) {
  std::string text = std::string(run::to_string(record.phase)) + ": " + record.message;
  for (const run::Incident& incident : record.incidents)
    text += "\n  " + std::to_string(incident.time_s) + " s, " + run::to_string(incident.kind) + ": " +
            run::sentence_of(incident.evidence) + " -> " + run::to_string(incident.response);
  return text;
}

}  // namespace stepwright::tamp::mission::testing

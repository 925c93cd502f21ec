// What a program of arms is made of, and what is refused.

#include "supervisor/tamp/program/arms_program.h"

#include <gtest/gtest.h>

#include <map>

#include "ladder/graphic/externals.h"
#include "plant_models/bridge/plant_driver.h"
#include "tests/support/arms_program/planned_arms.h"

namespace stepwright::tamp::program {
namespace {

const test::PlannedArms& planned() {
  return test::planned_once("p1");
}

std::string text_of_all(const graphic::Project& project) {
  std::string text;
  for (const graphic::Variable& each : project.globals)
    text += each.name + ":" + each.type + "@" + each.address + "=" + each.initial + "\n";
  for (const graphic::Pou& pou : project.pous) {
    text += pou.name + "\n";
    if (const auto* body = std::get_if<graphic::StBody>(&pou.body)) text += body->text;
    if (const auto* chart = std::get_if<graphic::SfcChart>(&pou.body)) {
      for (const graphic::Step& each : chart->steps) text += each.name + "\n";
      text += graphic::text_of(*chart);
    }
  }
  return text;
}

TEST(ArmsProgram, WhenThePlanIsTheSame_ThenTheTextIsTheSame) {
  const test::PlannedArms again = test::planned_arms("p1");
  std::string texts[2];
  int k = 0;
  for (const test::PlannedArms* each : {&planned(), &again}) {
    const auto made =
        arms_program({.kind = ArmsProgramKind::Follow, .cell = &each->cell, .schedule = &each->schedule},
                     cell_terminals_in_a_row(2, 4));
    ASSERT_TRUE(made) << result::to_string(made.error());
    texts[k++] = text_of_all(made->project);
    EXPECT_LT(made->size.data_bytes, 400'000u);
    EXPECT_LE(made->size.most_rows, 400u);
  }
  EXPECT_EQ(texts[0], texts[1]);
}

TEST(ArmsProgram, WhenStepsAreListed_ThenEachOfThePlansActionsHasItsOwn) {
  const auto made = arms_program(
      {.kind = ArmsProgramKind::Follow, .cell = &planned().cell, .schedule = &planned().schedule},
      cell_terminals_in_a_row(2, 4));
  ASSERT_TRUE(made);
  std::map<std::string, int> count;
  for (const ArmsStep& each : made->steps) {
    if (each.arm < 0 || each.kind == ArmsStepKind::Start || each.kind == ArmsStepKind::Done) continue;
    const auto& step = planned().schedule.arms[static_cast<std::size_t>(each.arm)].steps[each.step];
    EXPECT_EQ(each.action, step.action) << each.name;
    ++count[name_of(step.kind)];
  }
  for (const char* kind : {"approach", "linear", "grip", "lift", "transfer", "lower", "release"})
    EXPECT_GE(count[kind], 2) << kind;
}

TEST(CellTerminals, WhenTheyAreInARow_ThenTheyAreWhereThePlantHasThem) {
  const std::vector<std::string> arms = {"left", "right"};
  const CellTerminals terminals = cell_terminals_in_a_row(2, 3);
  std::map<std::string, std::string> wires;
  for (const bridge::PortWire& each : bridge::default_robot_cell_wires(arms, 3))
    wires[each.port] = each.address;
  std::size_t seen = 0;
  const auto expect = [&](const std::string& port, const std::string& address) {
    EXPECT_EQ(wires[port], address) << port;
    ++seen;
  };
  for (std::size_t arm = 0; arm < 2; ++arm) {
    const ArmTerminals& each = terminals.arms[arm];
    for (std::size_t k = 0; k < 7; ++k) {
      expect("pos_" + arms[arm] + "_" + std::to_string(k + 1), each.pos[k]);
      expect("set_" + arms[arm] + "_" + std::to_string(k + 1), each.set[k]);
    }
    expect("width_" + arms[arm], each.width);
    expect("grip_" + arms[arm], each.grip);
    expect("enable_" + arms[arm], each.enable);
    expect("ready_" + arms[arm], each.ready);
    expect("trip_" + arms[arm], each.trip);
    expect("grasp_" + arms[arm], each.grasp);
  }
  expect("estop_ok", terminals.estop_ok);
  expect("camera_trigger", terminals.camera_trigger);
  expect("camera_pictures", terminals.camera_pictures);
  expect("camera_seen", terminals.camera_seen);
  for (std::size_t s = 0; s < 3; ++s) {
    const std::string slot = "seen_" + std::to_string(s + 1) + "_";
    expect(slot + "kind", terminals.slots[s].kind);
    expect(slot + "x", terminals.slots[s].x);
    expect(slot + "y", terminals.slots[s].y);
    expect(slot + "z", terminals.slots[s].z);
    expect(slot + "yaw", terminals.slots[s].yaw);
  }
  EXPECT_EQ(seen, wires.size());
}

TEST(ArmsProgram, WhenItCannotBeMade_ThenThatIsSaid) {
  const ArmsProgramInput input{
      .kind = ArmsProgramKind::Follow, .cell = &planned().cell, .schedule = &planned().schedule};
  const auto code = [&](const ArmsProgramInput& what, const CellTerminals& terminals,
                        const ArmsProgramOptions& options) {
    const auto made = arms_program(what, terminals, options);
    return made ? std::string() : made.error().front().code;
  };
  CellTerminals terminals = cell_terminals_in_a_row(2, 4);
  EXPECT_EQ(code(input, terminals, {}), "");
  EXPECT_EQ(code(input, cell_terminals_in_a_row(1, 4), {}), "G0301");
  EXPECT_EQ(code(input, cell_terminals_in_a_row(2, 0), {}), "G0301");
  terminals.arms[1].grasp.clear();
  EXPECT_EQ(code(input, terminals, {}), "G0301");
  terminals = cell_terminals_in_a_row(2, 4);
  EXPECT_EQ(code(input, terminals, {.following_rad = 0.0}), "G0302");
  EXPECT_EQ(code(input, terminals, {.reports = 0}), "G0302");
  EXPECT_EQ(code(input, terminals, {.lead_s = -1.0}), "G0302");
  schedule::CellSchedule other = planned().schedule;
  other.arms.pop_back();
  EXPECT_EQ(
      code({.kind = ArmsProgramKind::Follow, .cell = &planned().cell, .schedule = &other}, terminals, {}),
      "G0302");
  other = planned().schedule;
  other.nearest_m = 0.015;
  EXPECT_EQ(
      code({.kind = ArmsProgramKind::Follow, .cell = &planned().cell, .schedule = &other}, terminals, {}),
      "G0303");
}

}  // namespace
}  // namespace stepwright::tamp::program

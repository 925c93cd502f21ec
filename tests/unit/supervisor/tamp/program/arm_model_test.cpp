// The exporter of ARM_MODEL beside the model of the tree's robot that is written by hand, and the capsules in
// the controller beside the planner's.

#include <gtest/gtest.h>

#include <fmt/format.h>

#include "supervisor/motion/spatial/random.h"
#include "supervisor/tamp/program/arm_data.h"
#include "tests/support/compiled_program.h"
#include "tests/support/tamp_cells/arm_points.h"
#include "tests/support/tamp_cells/paper_cells.h"
#include "tests/unit/ladder/driver/two_arms.h"

namespace stepwright::tamp::program {
namespace {

double real(const support::CompiledProgram& program, const std::string& path) {
  return std::get<double>(program.value(path));
}

// As the controller has it.
schedule::ArmCapsules model_of(const support::CompiledProgram& program, const std::string& name,
                               schedule::ArmCapsules joints) {
  joints.capsules.clear();
  const auto count = program.get("main." + name + ".Capsules");
  for (std::int64_t k = 1; k <= count; ++k) {
    const std::string at = fmt::format("main.{}.Capsule[{}].", name, k);
    const auto point = [&](int end) {
      return motion::Vector3{real(program, fmt::format("{}X{}", at, end)),
                             real(program, fmt::format("{}Y{}", at, end)),
                             real(program, fmt::format("{}Z{}", at, end))};
    };
    joints.capsules.push_back(
        {static_cast<int>(program.get(at + "Joint")), point(1), point(2), real(program, at + "Radius")});
  }
  return joints;
}

TEST(ArmModel, WhenItIsExported_ThenJointsAreThoseWrittenByHandAndDistancesThoseOfThePlanner) {
  const auto problem = test::paper_problem("p1");
  ASSERT_TRUE(problem);
  const schedule::ArmCapsules arms[] = {schedule::arm_capsules(problem->cell, 0),
                                        schedule::arm_capsules(problem->cell, 1)};
  const std::string text = fmt::format(
      "PROGRAM main\nVAR\n{}  left : ARM_MODEL := {};\n  right : ARM_MODEL := {};\n  q1, q2 : MC_JOINTS;\n"
      "  measure : ARM_DISTANCE;\nEND_VAR\n{}  measure(FirstArm := left, SecondArm := right, FirstPosition "
      ":= "
      "q1, SecondPosition := q2);\nEND_PROGRAM\n",
      driver_test::kTwoArms, arm_model_literal(arms[0]), arm_model_literal(arms[1]), driver_test::kRightArm);
  driver::CompileInput input;
  input.texts = {{"model.st", text}};
  support::CompiledProgram program(input);
  program.scan();
  for (const auto& [made, by_hand] : {std::pair("left", "leftArm"), {"right", "rightArm"}})
    for (int k = 1; k <= 7; ++k) {
      for (int n = 0; n < 9; ++n)
        EXPECT_NEAR(real(program, fmt::format("main.{}.Joint[{}].R[{}]", made, k, n)),
                    real(program, fmt::format("main.{}.Joint[{}].R[{}]", by_hand, k, n)), 1e-12)
            << made << k << n;
      for (const char* axis : {"X", "Y", "Z"})
        EXPECT_NEAR(real(program, fmt::format("main.{}.Joint[{}].{}", made, k, axis)),
                    real(program, fmt::format("main.{}.Joint[{}].{}", by_hand, k, axis)), 1e-12);
    }
  motion::Random random(9);
  for (std::size_t arm = 0; arm < 2; ++arm) {
    const schedule::ArmCapsules by_hand = model_of(program, arm == 0 ? "leftArm" : "rightArm", arms[arm]);
    EXPECT_EQ(by_hand.capsules.size(), 7u);
    EXPECT_LE(test::farthest_outside(problem->cell, arm, by_hand, random, {.places = 40, .points = 100}),
              1e-9);
  }
  for (int round = 0; round < 20; ++round) {
    std::vector<double> q[2];
    for (int arm = 0; arm < 2; ++arm)
      for (int k = 1; k <= 7; ++k) {
        q[arm].push_back(random.between(-1.0, 1.5));
        program.set(fmt::format("main.q{}[{}]", arm + 1, k), std::bit_cast<std::int64_t>(q[arm].back()));
      }
    program.scan();
    EXPECT_NEAR(
        real(program, "main.measure.Distance"),
        schedule::distance_of(schedule::capsules_at(arms[0], q[0]), schedule::capsules_at(arms[1], q[1])),
        1e-9);
  }
}

}  // namespace
}  // namespace stepwright::tamp::program

#pragma once

// Checks a cell without running it: its configuration with all tables, the wires of its plant, its safe
// outputs and scheduled faults, what its Modbus processes would refuse, the program that it runs with the
// register map and the tags that are about it, and, where it plans, its planning files and plan.
//
//   const CheckReport report = check_cell("cell.toml", {"plant.seed=7"});
//   report.exit();                    // Done if it is sound
//
// One run finds all problems: what is wrong takes its default and the check goes on. Nothing is opened for
// writing, and no process of the cell is disturbed.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "runtime/ground/result/diagnostic.h"
#include "runtime/ground/result/exit_code.h"

namespace stepwright::check {

// Figures of the cell's own plan.
struct PlanFigures {
  std::size_t actions = 0;
  double cost = 0.0;
  std::size_t program_bytes = 0;
};

struct CheckReport {
  std::filesystem::path file;
  result::Diagnostics problems;
  std::string program;              // that the cell was checked against; empty: none is known
  std::optional<PlanFigures> plan;  // only of a cell that plans, without problems
  std::string no_plan;              // why there is none, although nothing is wrong with the files
  result::ExitCode plan_exit = result::ExitCode::Done;

  // Nothing is wrong with it; there may be warnings.
  bool sound() const { return !result::has_errors(problems) && no_plan.empty(); }
  std::size_t warnings() const;
  result::ExitCode exit() const;
};

// `image`: the program that the cell is to run; empty: the one that its start loads, or its plan makes.
CheckReport check_cell(const std::filesystem::path& file, const std::vector<std::string>& overrides,
                       const std::filesystem::path& image = {});

// One object: file, sound, warnings (how many), diagnostics, program, and of the plan plan_steps, plan_cost,
// program_bytes or no_plan.
std::string to_json(const CheckReport& report);

}  // namespace stepwright::check

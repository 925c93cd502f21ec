#pragma once

// [planning]: a PDDL problem and how it is planned for.
//
//   [planning]
//   domain = "domain.pddl"
//   problem = "problem.pddl"
//   binding = "binding.toml"        # supervisor/doc/binding_file.md
//   programs = ["safety.xml"]       # PLCopen XML, hand-written; run behind the plan in its task
//   dialect = "standard"            # of these, and of sources that the page brings
//   optimal = true
//   sequential = false
//   initial = "problem"             # or "observed", where the I/O is real
//   monitors = true
//   time_ms = 10_000

#include <chrono>
#include <cstdint>
#include <span>

#include "cell/missions/table/mission_table.h"
#include "runtime/ground/settings/key_words.h"

namespace stepwright::missions {

// Where the first plan starts: as the problem says, or where sensors show something, as they show it.
enum class InitialState : std::uint8_t { Problem, Observed };

struct PlanningTable final : MissionTable {
  std::filesystem::path domain;
  std::filesystem::path problem;
  std::filesystem::path binding;
  std::vector<std::filesystem::path> programs;
  bool optimal = true;                     // prove the optimum before the start (within `time`)
  std::chrono::milliseconds time{10'000};  // budget of one planning or replanning
  bool sequential = false;                 // strictly sequential chart, as in the paper
  InitialState initial = InitialState::Problem;
  bool monitors = true;  // rungs that watch the plan in the scan; false for small controllers
  const source::Dialect* written_in = &source::standard_dialect();

  const source::Dialect& dialect() const override { return *written_in; }
  bool has_monitors() const override { return monitors; }
  bool takes_demands() const override { return true; }
  std::string in_sequence() const override { return "planning.sequential=true"; }
};

std::shared_ptr<const MissionTable> read_planning_table(const settings::TomlTable& table,
                                                        const TablePlace& place);

// What people are told of its keys.
std::span<const settings::KeyWords> planning_keys();

}  // namespace stepwright::missions

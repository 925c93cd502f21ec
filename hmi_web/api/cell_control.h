#pragma once

// Interface of the routes to the cell: requests to its supervisor, values, forces, the stop. The program
// implements it over Fast DDS, tests with a cell of their own.
//
// Threads: every function from any; each blocks for some seconds at most. Fails with D0001 where nobody
// answers, with other codes where it is refused: D0002 and R0009 say that another program has just come, and
// that nothing has been changed.

#include <chrono>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "hmi_web/tags/known_tags.h"
#include "runtime/bytecode/reader/program_info.h"
#include "runtime/ground/result/result.h"
#include "runtime/host/plant_fault.h"

namespace stepwright::api {

// A place of the running program's memory that is forced, and to what; both as the program spells them.
struct ForcedPlace {
  std::string name;
  std::string value;
  bool ends = false;  // by itself, after the time that it was given

  friend bool operator==(const ForcedPlace&, const ForcedPlace&) = default;
};

class CellControl {
 public:
  virtual ~CellControl() = default;

  // Asks the supervisor (supervisor/doc/plan_document.md) and waits for its answer: accepted, or why not.
  // D0007: none came.
  [[nodiscard]] virtual result::Result<void> ask_supervisor(const std::string& request) = 0;
  // The newest of what the supervisor says goals can be made of, and of where a plan would begin
  // (supervisor/doc/goals.md), as it came; empty before the first arrived.
  virtual std::string goal_form() = 0;
  virtual std::string outlook() = 0;
  // Outputs to their safe state.
  [[nodiscard]] virtual result::Result<void> stop_runtime(const std::string& reason) = 0;
  // Waits for a runtime that is busy or is being started again: what is read after it is what a write then
  // replaces. D0001: none has answered; nothing was asked of any.
  [[nodiscard]] virtual result::Result<void> reach() { return {}; }

  // Variables of the running program by their paths or addresses; values are literals of IEC 61131-3. What is
  // returned is the value as the program spells it.
  [[nodiscard]] virtual result::Result<std::string> read(const std::string& name) = 0;
  // The program that runs, as far as it is known here; null: none is.
  virtual std::shared_ptr<const reader::ProgramInfo> program() = 0;
  // What the cell and its sources say of its tags; null: no program is known.
  virtual std::shared_ptr<const tags::KnownTags> known_tags() { return nullptr; }
  // The value as `write` would return it; nothing is written.
  [[nodiscard]] virtual result::Result<std::string> spell(const std::string& name,
                                                          const std::string& value) = 0;
  [[nodiscard]] virtual result::Result<std::string> write(const std::string& name,
                                                          const std::string& value) = 0;
  // The runtime releases it after `duration`, whatever becomes of this process.
  [[nodiscard]] virtual result::Result<std::string> force(const std::string& name, const std::string& value,
                                                          std::chrono::milliseconds duration) = 0;
  [[nodiscard]] virtual result::Result<void> unforce(const std::string& name) = 0;
  // Values by names of variables, all of them between the same two scans or none. D0004 if they are more than
  // the runtime takes at once; what is refused is refused before anything is written.
  [[nodiscard]] virtual result::Result<void> write_together(
      const std::map<std::string, std::string, std::less<>>& values) = 0;

  // Faults of the simulated plant, with what holds now; none of a plant that is real.
  [[nodiscard]] virtual result::Result<std::vector<host::PlantFault>> faults() = 0;
  // Makes one hold with a value in its unit, or without a value ends it.
  [[nodiscard]] virtual result::Result<void> set_fault(const std::string& name,
                                                       std::optional<double> value) = 0;

  // Everything that is forced in the runtime, whoever has forced it. D0008: its link cannot tell.
  [[nodiscard]] virtual result::Result<std::vector<ForcedPlace>> forced() = 0;
  // The entry of `forced` if that variable were forced to that value for a time.
  [[nodiscard]] virtual result::Result<ForcedPlace> as_forced(const std::string& name,
                                                              const std::string& value) = 0;
};

}  // namespace stepwright::api

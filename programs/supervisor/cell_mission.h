#pragma once

// Mission of a cell's supervisor, of either kind: a PDDL problem ([planning]) or a fleet's ([fleet]).
//
// Threads: `run` belongs to one; every other function but `begin` may be called from another one meanwhile.
//
//   auto mission = CellMission::open(config);
//   (*mission)->begin(controller, publish);
//   run::RunRecord record = (*mission)->run();
//   while ((*mission)->wait_start(1s)) record = (*mission)->run();

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "programs/config/cell_config.h"
#include "programs/supervisor/operator_request.h"
#include "supervisor/run/controller.h"
#include "supervisor/run/run_record.h"

namespace stepwright::supervisor_program {

class CellMission {
 public:
  using Observer =
      std::function<void(const run::RunRecord&)>;  // after every change, from the thread of `run`

  virtual ~CellMission() = default;
  // Whether the cell has anything for a supervisor to do.
  static bool is_wanted(const config::CellConfig& config);
  // Reads all files; what is wrong with them. Requires that it is wanted.
  [[nodiscard]] static result::Result<std::unique_ptr<CellMission>> open(const config::CellConfig& config);

  // Once, before the others; the controller must outlive this.
  virtual void begin(run::Controller& controller, Observer observer) = 0;
  virtual run::RunRecord run() = 0;
  // Waits until somebody wants another run after one that has ended; false after `timeout`.
  virtual bool wait_start(std::chrono::milliseconds timeout) = 0;
  // X0003 and others where the request cannot be meant, X0008 where not now.
  [[nodiscard]] virtual result::Result<void> obey(const OperatorRequest& request) = 0;

  // Form for goals on the page (supervisor/doc/goals.md), JSON; constant.
  virtual std::string goal_form() const = 0;
  // Where a plan would begin and what a what-if has come to, JSON; nothing if that is as it was at the last
  // call. One thread at a time.
  virtual std::optional<std::string> new_outlook() = 0;
};

// X0003: a request that another kind of cell takes.
[[nodiscard]] result::Result<void> not_of_this_cell(const char* hint);

}  // namespace stepwright::supervisor_program

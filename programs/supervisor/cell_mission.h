#pragma once

// What a cell's supervisor has its runtime do, whichever kind it is: a PDDL problem ([planning]) or a fleet's
// ([fleet]).
//
// Threads: `run` belongs to one; `obey` may be called from another one meanwhile.
//
//   auto mission = CellMission::open(config);
//   (*mission)->begin(controller, publish);
//   const executive::RunRecord record = (*mission)->run();

#include <functional>
#include <memory>

#include "programs/config/cell_config.h"
#include "programs/supervisor/operator_request.h"
#include "supervisor/executive/controller.h"
#include "supervisor/executive/run_record.h"

namespace stepwright::supervisor_program {

class CellMission {
 public:
  using Observer =
      std::function<void(const executive::RunRecord&)>;  // after every change, from the thread of `run`

  virtual ~CellMission() = default;
  // Reads all files; what is wrong with them.
  [[nodiscard]] static result::Result<std::unique_ptr<CellMission>> open(const config::CellConfig& config);

  // Once, before the others; the controller must outlive this.
  virtual void begin(executive::Controller& controller, Observer observer) = 0;
  virtual executive::RunRecord run() = 0;
  // X0003 and others where the request cannot be meant, X0008 where not now.
  [[nodiscard]] virtual result::Result<void> obey(const OperatorRequest& request) = 0;
};

}  // namespace stepwright::supervisor_program

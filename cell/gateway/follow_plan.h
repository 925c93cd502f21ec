#pragma once

// A plan on a controller whose program was loaded by hand, followed to its end in the log.

#include <cstddef>
#include <functional>

#include "cell/config/cell_config.h"
#include "cell/gateway/hand_plan.h"
#include "runtime/ground/log/logger.h"
#include "runtime/ground/process/stop_signal.h"
#include "runtime/ground/result/exit_code.h"
#include "runtime/remote/register_line.h"

namespace stepwright::gateway {

struct FollowStatus {
  bool answers = false;     // the controller
  std::size_t started = 0;  // actions
};

// Blocks until the plan has come to an end (Done; RuntimeFault if it failed or the controller contradicts) or
// a stop is asked for; then nothing is granted any more. `meanwhile` is called between two looks.
result::ExitCode follow_plan(const config::CellConfig& config, const HandPlan& plan,
                             remote::RegisterLine& line, log::Logger& log, const process::StopSignal& stop,
                             const std::function<void(const FollowStatus&)>& meanwhile);

}  // namespace stepwright::gateway

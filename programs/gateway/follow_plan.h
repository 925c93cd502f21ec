#pragma once

// A plan on a controller whose program was loaded by hand, followed to its end in the log.

#include <filesystem>
#include <vector>

#include "programs/config/cell_config.h"
#include "programs/log/logger.h"
#include "programs/process/stop_signal.h"
#include "runtime/remote/hand_loaded.h"
#include "runtime/result/exit_code.h"
#include "runtime/result/result.h"

namespace stepwright::gateway {

struct HandPlan {
  std::uint16_t registers = 0;  // of HS_ENABLE
  std::vector<remote::HandAction> actions;
};

// Reads what `translate --handshake` wrote. C0545 with the file's name for anything else.
[[nodiscard]] result::Result<HandPlan> read_hand_plan(const std::filesystem::path& file);

// Blocks until the plan has come to an end (Done; RuntimeFault if it failed or the controller contradicts) or
// a stop is asked for; then nothing is granted any more.
result::ExitCode follow_plan(const config::CellConfig& config, const HandPlan& plan,
                             remote::RegisterLine& line, log::Logger& log, const process::StopSignal& stop);

}  // namespace stepwright::gateway

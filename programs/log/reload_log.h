#pragma once

// What a process that only logs does when it is told to read its configuration again (SIGHUP): its log
// changes, everything else waits for a restart and is named.

#include "programs/config/cell_config.h"
#include "programs/log/logger.h"
#include "programs/process/notify_socket.h"

namespace stepwright::log {

// A wrong file is refused with its places; `running` and the log stay as they were. Tells the init system.
void reload_log(config::CellConfig& running, Logger& log, process::NotifySocket& init);

}  // namespace stepwright::log

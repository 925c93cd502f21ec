#pragma once

// Reload of a process's configuration (SIGHUP): its log changes, and what it says that it can take over;
// everything else waits for a restart and is named. Threads: that of the process's loop.

#include <functional>
#include <string_view>
#include <vector>

#include "cell/config/cell_config.h"
#include "runtime/ground/log/logger.h"
#include "runtime/ground/process/notify_socket.h"

namespace stepwright::config {

// Part of the configuration that a process reloads beside its log.
struct ReloadPart {
  std::vector<std::string_view> keys;  // as reload_cell takes them
  // Whether the file still has what the part is about; if not, its keys wait for a restart as all others do.
  std::function<bool(const CellConfig& wanted)> applies;
  // Tries what the file wants without changing anything, and returns what is to be done once all the rest is
  // right, too. An error refuses the whole file.
  std::function<result::Result<std::function<void()>>(const CellConfig& wanted)> prepare;
};

// A wrong file is refused with its places; `running` and the log stay as they were. Tells the init system.
void reload_log(CellConfig& running, log::Logger& log, process::NotifySocket& init,
                const ReloadPart& part = {});

}  // namespace stepwright::config

#include "programs/log/reload_log.h"

#include <utility>

#include "programs/config/reload.h"

namespace stepwright::log {

void reload_log(config::CellConfig& running, Logger& log, process::NotifySocket& init) {
  init.reloading();
  auto again = config::reload_cell(running, {"log."});
  result::Result<void> opened;
  if (again) opened = log.reopen(again->config.log);
  if (!again || !opened) {
    const result::Diagnostics& why = again ? opened.error() : again.error();
    log.error("reload", "the configuration was refused, the previous one holds: " + result::to_string(why));
  } else {
    running = std::move(again->config);
    log.info("reload", again->notes.empty()
                           ? "the configuration was read again: nothing has changed"
                           : "the configuration was read again: " + result::to_string(again->notes));
  }
  init.ready("the configuration was read again");
}

}  // namespace stepwright::log

#include "cell/config/reload_log.h"

#include <utility>

#include "cell/config/reload.h"

namespace stepwright::config {

void reload_log(CellConfig& running, log::Logger& log, process::NotifySocket& init, const ReloadPart& part) {
  init.reloading();
  std::vector<std::string_view> keys = part.keys;
  keys.emplace_back("log.");
  auto again = reload_cell(running, keys);
  const bool applies = again && part.prepare && (!part.applies || part.applies(again->wanted));
  if (again && !applies && !part.keys.empty()) again = reload_cell(running, {"log."});
  result::Diagnostics why;
  std::function<void()> take_over;
  if (!again) why = std::move(again.error());
  if (why.empty() && applies) {
    auto prepared = part.prepare(again->wanted);
    if (prepared) {
      take_over = std::move(*prepared);
    } else {
      why = std::move(prepared.error());
    }
  }
  if (why.empty()) {
    // Also when it is the same: its file may have been moved away.
    if (auto opened = log.reopen(again->config.log); !opened) why = std::move(opened.error());
  }
  if (!why.empty()) {
    log.error("reload", "the configuration was refused, the previous one holds: " + result::to_string(why));
  } else {
    if (take_over) take_over();
    running = std::move(again->config);
    log.info("reload", again->notes.empty()
                           ? "the configuration was read again: nothing has changed"
                           : "the configuration was read again: " + result::to_string(again->notes));
  }
  init.ready("the configuration was read again");
}

}  // namespace stepwright::config

#pragma once

// Live state of a sheet in one of its instances, as a page draws it: power flow, wires, conditions. The sheet
// is read once and looked at scan by scan (hmi_web/doc/program.md).
//
//   SheetMonitor monitor(names, read_sheet(json), "Main");
//   json blocks = monitor.look(types, image, {{0, 3}});
//
// Immutable but for what is cached of a look; one thread. The names outlive it.

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "hmi_web/monitor/body_places.h"
#include "hmi_web/monitor/rung_flow.h"
#include "hmi_web/monitor/scope.h"
#include "hmi_web/monitor/sheet.h"
#include "hmi_web/protocol/viewer_message.h"

namespace stepwright::monitor {

class SheetMonitor {
 public:
  SheetMonitor(const ProgramNames& names, Sheet sheet, std::string instance);
  SheetMonitor(const SheetMonitor&) = delete;
  SheetMonitor& operator=(const SheetMonitor&) = delete;

  // Of the blocks that are asked for, by their numbers.
  nlohmann::json look(const semantics::TypeTable& types, std::span<const std::byte> image,
                      const std::vector<protocol::TagRange>& blocks) const;

 private:
  Sheet sheet_;
  Scope scope_;
  std::vector<const Rung*> rungs_;
  std::vector<std::size_t> rung_of_;  // by block
  std::vector<BodyPlaces> bodies_;    // by block
};

}  // namespace stepwright::monitor

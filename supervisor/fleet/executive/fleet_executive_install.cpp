// Bringing a program to run: by an online change from the one that runs, or by download and start.

#include <utility>

#include "supervisor/fleet/executive/fleet_executive.h"

namespace stepwright::fleet {

// False if the runtime is lost (phase unchanged) or refuses (phase Safe).
bool FleetExecutive::install(const PreparedFleet& prepared) {
  auto reader = FleetReader::create(prepared.container, *prepared.program);
  if (!reader) return give_up("the program cannot be read", reader.error());
  if (reader_ && runs()) {
    if (change(prepared.container)) {
      reader_ = std::move(*reader);
      return await_event(host::EventKind::Changed);
    }
    // Without a program the forks go down: a load that is aboard would be left where the vehicle stands.
    if (const auto loaded = carrier()) {
      return give_up("the online change was refused, and " + *loaded +
                     " has a load aboard that a download would drop");
    }
    (void)controller_.stop("the next program cannot take over");
  }
  reader_ = std::move(*reader);
  return download(prepared.container) && start();
}

// A vehicle that has a load aboard, if any takes part.
std::optional<std::string> FleetExecutive::carrier() const {
  for (std::size_t v = 0; v < ledger_.vehicles().size(); ++v) {
    const VehicleEntry& entry = ledger_.vehicles()[v];
    if (!entry.aboard.empty() && !entry.lost) return planning_.problem().vehicles[v].name;
  }
  return std::nullopt;
}

}  // namespace stepwright::fleet

#include "firmware/app/firmware.h"

namespace stepwright::app {

void Firmware::boot() {
  controller_.boot();
  board_.watchdog.start(kWatchdogMs);
}

// Scans run in this loop: the watchdog is fed only if they come to an end.
void Firmware::turn() {
  const bool heard = line_.work(slave_);
  const bool worked = controller_.work();
  board_.watchdog.feed();
  if (!heard && !worked) board_.tick.rest();
}

}  // namespace stepwright::app

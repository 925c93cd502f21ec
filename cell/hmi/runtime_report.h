#pragma once

// The part of a runtime's status that the page shows all the time; the rest stands in its report of the scan
// (scan_report.h). Pure; any thread.

#include "hmi_web/server/cell_source.h"
#include "runtime/host/messages.h"

namespace stepwright::hmi {

server::RuntimeReport report_of(const host::RuntimeStatus& status);

}  // namespace stepwright::hmi

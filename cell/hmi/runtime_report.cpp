#include "cell/hmi/runtime_report.h"

#include "runtime/host/state_name.h"

namespace stepwright::hmi {

server::RuntimeReport report_of(const host::RuntimeStatus& status) {
  return {
      host::name_of(status.state),
      status.detail,
      status.waiting_for_supervisor,
      status.trace_hash,
      {status.overruns, status.scan_p50_us, status.scan_p99_us, status.scan_max_us, status.realtime_factor}};
}

}  // namespace stepwright::hmi

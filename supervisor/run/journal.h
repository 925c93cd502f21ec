#pragma once

// Journal of a run, the part that all missions keep, from which a restarted supervisor goes on: the record so
// far, the run's clock, and how many of the timed requests have been taken. A mission's own derives from it;
// the file is read and written by internal/journal_json.h.
//
// Plain values.

#include <cstddef>

#include "supervisor/run/run_clock.h"
#include "supervisor/run/run_record.h"

namespace stepwright::run {

struct Journal {
  RunRecord record;
  RunClock::State clock;  // when the journal was written
  std::size_t next_request = 0;
};

}  // namespace stepwright::run

#pragma once

// Settings of the restart once lost I/O is there again, in the table [io]:
//
//   restart = "operator"     # the program is started by a person; or "auto": by the runtime
//   restart_after_s = 5      # "auto": the I/O has been there for so long without a break
//   restart_limit = 3        # "auto": at most so often within an hour; then a person is needed
//
// Thread-safe: pure.

#include <chrono>
#include <cstdint>

#include "runtime/ground/result/diagnostic.h"
#include "runtime/ground/settings/toml_document.h"

namespace stepwright::config {

struct RestartConfig {
  bool automatic = false;
  std::chrono::milliseconds after{5'000};
  std::uint32_t limit = 3;  // within an hour
};

// `shared`: the I/O is another process's, the only kind that can be lost. Adds C0446 where it is not.
RestartConfig read_restart(const settings::TomlTable& io, bool shared, result::Diagnostics& problems);

}  // namespace stepwright::config

#pragma once

// The figures of runtimes as Prometheus reads them (text exposition format 0.0.4). One formatter for /metrics
// of the HMI and for `stepwright metrics`.
//
//   const std::string text = metrics_text({{"bench", true, status}});
//
// Pure function; any thread. A runtime that does not answer has nothing but stepwright_up 0. Names follow the
// conventions of Prometheus: base units, _total for what only grows. runtime/doc/citizen.md lists them.

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "runtime/host/messages.h"

namespace stepwright::metrics {

inline constexpr std::string_view kContentType = "text/plain; version=0.0.4; charset=utf-8";

struct RuntimeMetrics {
  std::string runtime;  // its id
  bool up = false;
  std::optional<host::RuntimeStatus> status;  // the newest
};

std::string metrics_text(std::span<const RuntimeMetrics> runtimes);

}  // namespace stepwright::metrics

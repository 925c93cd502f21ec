#include "cell/modbus_server/server_metrics.h"

#include <algorithm>
#include <array>

#include "runtime/metrics/exposition.h"

namespace stepwright::modbus_server {
namespace {

using metrics::Exposition;
using metrics::label;
using modbus::server::ServerFigures;

struct Counter {
  const char* name;
  const char* help;
  std::uint64_t ServerFigures::*value;
};
constexpr std::array kCounters = {
    Counter{"stepwright_modbus_server_accepted_total", "Connections that were let in.",
            &ServerFigures::accepted},
    Counter{"stepwright_modbus_server_turned_away_total",
            "Connections that were closed at once: the allow-list, a limit, no descriptor left.",
            &ServerFigures::turned_away},
    Counter{"stepwright_modbus_server_dropped_total", "Connections that were ended: slow, idle, malformed.",
            &ServerFigures::dropped},
    Counter{"stepwright_modbus_server_malformed_total", "Frames that ended their connection.",
            &ServerFigures::malformed},
    Counter{"stepwright_modbus_server_requests_total", "Requests.", &ServerFigures::requests},
    Counter{"stepwright_modbus_server_writes_total", "Requests that went to the runtime to write.",
            &ServerFigures::writes},
};
// Those that the server has reasons for; any other is listed once it was given.
constexpr std::array kUsual = {1u, 2u, 3u, 4u, 6u, 11u};

void add_exceptions(const std::string& cell, const ServerFigures& figures, Exposition& text) {
  text.family("stepwright_modbus_server_exceptions_total", "counter",
              "Exceptions that were answered, by code.");
  for (unsigned code = 1; code < figures.exceptions.size(); ++code) {
    const bool usual = std::find(kUsual.begin(), kUsual.end(), code) != kUsual.end();
    if (!usual && figures.exceptions[code] == 0) continue;
    text.sample(cell + "," + label("exception", std::to_string(code)),
                static_cast<double>(figures.exceptions[code]));
  }
}

}  // namespace

std::string server_metrics(const std::string& cell, const ServerStatus& status) {
  const ServerFigures& figures = status.figures;
  const std::string own = label("cell", cell);
  Exposition text;
  text.figure("stepwright_modbus_server_serving", "gauge", "1 if the runtime's values can be read.", own,
              status.serving ? 1.0 : 0.0);
  text.figure("stepwright_modbus_server_connections", "gauge", "Connections that are open.", own,
              static_cast<double>(figures.connections));
  for (const Counter& counter : kCounters)
    text.figure(counter.name, "counter", counter.help, own, static_cast<double>(figures.*counter.value));
  add_exceptions(own, figures, text);
  text.family("stepwright_modbus_server_service_seconds", "summary",
              "From the wake-up to the sending of the answer; reads only.");
  text.quantiles(own, figures.service_time);
  text.figure("stepwright_modbus_server_service_max_seconds", "gauge", "The longest of them.", own,
              static_cast<double>(figures.service_time.max_ns()) / 1e9);
  if (status.certificate_ends) {
    const auto ends =
        std::chrono::duration_cast<std::chrono::seconds>(status.certificate_ends->time_since_epoch());
    text.figure("stepwright_modbus_server_certificate_expiry_timestamp_seconds", "gauge",
                "When the server's certificate ends, in seconds since 1970.", own,
                static_cast<double>(ends.count()));
  }
  return text.take();
}

}  // namespace stepwright::modbus_server

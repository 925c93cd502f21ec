#include "cell/config/modbus_server_config.h"

#include <algorithm>
#include <charconv>
#include <limits>
#include <optional>
#include <string>
#include <string_view>

namespace stepwright::config {
namespace {

using modbus::map::kLastAddress;
using modbus::map::Order;
using modbus::map::RangeConfig;
using modbus::map::Table;
using modbus::server::ClientRule;
using modbus::server::Window;
using network::IpRange;
using settings::TomlTable;

std::vector<std::string> table_names() {
  return {modbus::map::kTableNames.begin(), modbus::map::kTableNames.end()};
}

std::optional<Table> table_of(std::string_view name) {
  const auto& names = modbus::map::kTableNames;
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) return std::nullopt;
  return static_cast<Table>(found - names.begin());
}

std::optional<std::uint32_t> address_of(std::string_view text) {
  std::uint32_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || value > kLastAddress) return std::nullopt;
  return value;
}

// "holding 0-19", "coils 3", "input".
std::optional<Window> window_of(std::string_view text) {
  const std::size_t blank = text.find(' ');
  const auto table = table_of(text.substr(0, blank));
  if (!table) return std::nullopt;
  Window window;
  window.table = *table;
  if (blank == std::string_view::npos) return window;
  const std::string_view range = text.substr(blank + 1);
  const std::size_t dash = range.find('-');
  const auto first = address_of(range.substr(0, dash));
  const auto last = dash == std::string_view::npos ? first : address_of(range.substr(dash + 1));
  if (!first || !last || *last < *first) return std::nullopt;
  window.first = *first;
  window.last = *last;
  return window;
}

class Reader {
 public:
  result::Diagnostics problems;

  void refuse(const char* code, const TomlTable& table, const char* key, const std::string& message,
              const std::string& hint) {
    problems.push_back({code, result::Severity::Error, table.where(key), message, hint});
  }

  std::vector<IpRange> networks(const TomlTable& table, const char* key) {
    std::vector<IpRange> ranges;
    for (const std::string& text : table.texts(key)) {
      if (const auto range = IpRange::parse(text)) {
        ranges.push_back(*range);
      } else {
        refuse("C0506", table, key, "`" + text + "` is no address and no network",
               "192.168.1.7, 192.168.1.0/24, fd00::/8");
      }
    }
    return ranges;
  }

  std::vector<Window> windows(const TomlTable& table, const char* key, bool writes) {
    std::vector<Window> windows;
    for (const std::string& text : table.texts(key)) {
      if (text == "all") {
        for (const std::string& name : table_names())
          if (!writes || modbus::map::may_be_written(*table_of(name))) windows.push_back(*window_of(name));
        continue;
      }
      const auto window = window_of(text);
      if (!window) {
        refuse("C0507", table, key, "`" + text + "` is no window",
               "\"all\", \"coils\", \"holding 0-99\", \"input 5\"");
      } else if (writes && !modbus::map::may_be_written(window->table)) {
        refuse("C0507", table, key, "`" + text + "`: clients can write coils and holding registers only", "");
      } else {
        windows.push_back(*window);
      }
    }
    return windows;
  }

  void range(const TomlTable& table, modbus::map::MapConfig& map) {
    RangeConfig range;
    range.where = table.where();
    range.at_name = table.where(table.has("variable") ? "variable" : "address");
    range.at_first = table.where("first");
    range.at_count = table.where("count");
    range.at_writable = table.where("writable");
    range.table = table_of(table.choice("table", "holding", table_names())).value_or(Table::HoldingRegisters);
    range.first = static_cast<std::uint32_t>(table.integer("first", 0, {0, kLastAddress}));
    range.count = static_cast<std::uint32_t>(table.integer("count", 0, {0, kLastAddress + 1}));
    range.writable = table.boolean("writable", false);
    range.byte_order = order(table, "byte_order");
    range.word_order = order(table, "word_order");
    const std::string address = table.text("address", {});
    range.variable = table.text("variable", address);
    if (range.variable.empty() || (!address.empty() && table.has("variable"))) {
      return refuse("C0508", table, "", "a range names a variable or an address, one of both",
                    "variable = \"MAIN.level\", or address = \"%MW0\"");
    }
    if (!address.empty() && address.front() != '%')
      return refuse("C0508", table, "address", "`" + address + "` is no address",
                    "%MW0; variable = names a variable");
    map.ranges.push_back(std::move(range));
  }

  void client(const TomlTable& table, std::vector<ClientRule>& clients) {
    ClientRule rule;
    const std::string address = table.text("address", {});
    rule.role = table.text("role", {});
    rule.read = windows(table, "read", false);
    rule.write = windows(table, "write", true);
    rule.any = address.empty();
    if (address.empty() && rule.role.empty())
      refuse("C0508", table, "", "a client has an address or a role",
             "address = \"192.168.1.0/24\"; \"0.0.0.0/0\" for all");
    if (address.starts_with('/')) {
      rule.device = address;
    } else if (!address.empty()) {
      const auto range = IpRange::parse(address);
      if (!range) {
        return refuse("C0506", table, "address", "`" + address + "` is no address and no network",
                      "192.168.1.7, 192.168.1.0/24, fd00::/8");
      }
      rule.address = *range;
    }
    clients.push_back(std::move(rule));
  }

 private:
  static Order order(const TomlTable& table, const char* key) {
    return table.choice(key, "high_first", {"high_first", "low_first"}) == "high_first" ? Order::HighFirst
                                                                                        : Order::LowFirst;
  }
};

std::chrono::milliseconds milliseconds_of(const TomlTable& table, const char* key,
                                          std::chrono::milliseconds fallback, double low) {
  return std::chrono::milliseconds(table.integer(key, fallback.count(), {low, 86'400'000}));
}

void read_limits(const TomlTable& table, ModbusServerConfig& config) {
  auto& server = config.server;
  server.max_connections = static_cast<std::size_t>(
      table.integer("max_connections", static_cast<std::int64_t>(server.max_connections), {1, 10'000}));
  server.max_per_address = static_cast<std::size_t>(
      table.integer("max_per_address", static_cast<std::int64_t>(server.max_per_address), {1, 10'000}));
  server.idle_timeout = milliseconds_of(table, "idle_timeout_ms", server.idle_timeout, 0);
  server.send_timeout = milliseconds_of(table, "send_timeout_ms", server.send_timeout, 10);
  server.greeting_timeout = milliseconds_of(table, "greeting_timeout_ms", server.greeting_timeout, 10);
  config.stale_after = milliseconds_of(table, "stale_after_ms", config.stale_after, 300);
  config.write_timeout = milliseconds_of(table, "write_timeout_ms", config.write_timeout, 10);
  config.tcp.keep_alive_s =
      static_cast<int>(table.integer("keep_alive_s", config.tcp.keep_alive_s, {1, 86'400}));
}

}  // namespace

result::Diagnostics read_modbus_server(const TomlTable& table, ModbusServerConfig& config) {
  Reader reader;
  config.enabled = table.boolean("enabled", false);
  config.tcp.bind = table.text("bind", config.tcp.bind);
  if (!network::parse_ip(config.tcp.bind)) {
    reader.refuse("C0506", table, "bind", "`" + config.tcp.bind + "` is no address of a machine",
                  "127.0.0.1, or 0.0.0.0 for all of IPv4");
  }
  config.tcp.port = static_cast<std::uint16_t>(
      table.integer("port", config.tcp.port, {0, std::numeric_limits<std::uint16_t>::max()}));
  config.tcp.allow = reader.networks(table, "allow");
  if (!table.has("allow")) config.tcp.allow = {*IpRange::parse("127.0.0.0/8"), *IpRange::parse("::1")};
  read_limits(table, config);
  config.metrics = read_metrics(table);
  for (const double unit : table.numbers("units")) {
    if (unit >= 0 && unit <= 255 && unit == static_cast<int>(unit)) {
      config.server.units.push_back(static_cast<std::uint8_t>(unit));
    } else {
      table.report("units", "a unit is a number from 0 to 255");
    }
  }
  config.server.answer_unknown_units =
      table.choice("unknown_unit", "exception", {"exception", "ignore"}) == "exception";
  const std::vector<TomlTable> ranges = table.tables("range");
  for (const TomlTable& range : ranges) reader.range(range, config.map);
  // Who has a map of one's own has asked for no other.
  config.map.openplc =
      table.choice("map", ranges.empty() ? "openplc" : "ranges", {"openplc", "ranges"}) == "openplc";
  config.map.openplc_writable = table.boolean("writable", false);
  for (const TomlTable& client : table.tables("client")) reader.client(client, config.server.clients);
  return std::move(reader.problems);
}

}  // namespace stepwright::config

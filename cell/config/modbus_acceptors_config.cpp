#include "cell/config/modbus_acceptors_config.h"

#include <algorithm>
#include <string>

namespace stepwright::config {
namespace {

using modbus::server::ClientRule;
using modbus::server::LineOptions;
using modbus::server::Parity;
using settings::TomlTable;

constexpr std::uint16_t kTlsPort = 802;  // MB-TCP-Security v2.1

void refuse(result::Diagnostics& problems, const char* code, const TomlTable& table, const char* key,
            const std::string& message, const std::string& hint) {
  problems.push_back({code, result::Severity::Error, table.where(key), message, hint});
}

// A file that is named must be there; what is in it, the server says.
std::filesystem::path file_of(const TomlTable& table, const char* key, const std::filesystem::path& folder,
                              bool required, result::Diagnostics& problems) {
  const std::string name = required ? table.required_text(key) : table.text(key, {});
  if (name.empty()) return {};
  const std::filesystem::path file = folder / name;
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error))
    refuse(problems, "C0512", table, key, "there is no file " + file.string(),
           "runtime/doc/modbus_security.md has a recipe for certificates");
  return file;
}

TlsAcceptorConfig read_tls(const TomlTable& table, const std::filesystem::path& folder,
                           result::Diagnostics& problems) {
  TlsAcceptorConfig config;
  config.tcp.bind = table.text("bind", config.tcp.bind);
  if (!network::parse_ip(config.tcp.bind))
    refuse(problems, "C0511", table, "bind", "`" + config.tcp.bind + "` is no address of a machine",
           "127.0.0.1, or 0.0.0.0 for all of IPv4");
  config.tcp.port = static_cast<std::uint16_t>(table.integer("port", kTlsPort, {0, 65'535}));
  config.tls.certificate = file_of(table, "certificate", folder, true, problems);
  config.tls.key = file_of(table, "key", folder, true, problems);
  config.tls.authorities = file_of(table, "authorities", folder, true, problems);
  config.tls.revoked = file_of(table, "revoked", folder, false, problems);
  config.tls.where = table.where();
  return config;
}

Parity parity_of(const TomlTable& table) {
  const std::string parity = table.choice("parity", "even", {"even", "odd", "none"});
  return parity == "even" ? Parity::Even : parity == "odd" ? Parity::Odd : Parity::None;
}

LineOptions read_line(const TomlTable& table, result::Diagnostics& problems) {
  LineOptions line;
  line.device = table.required_text("device");
  line.baud = static_cast<std::uint32_t>(table.integer("baud", line.baud, {1, 1e7}));
  const auto speeds = modbus::server::line_speeds();
  if (std::ranges::find(speeds, line.baud) == speeds.end())
    refuse(problems, "C0513", table, "baud",
           "a serial line cannot have " + std::to_string(line.baud) + " baud",
           "9600, 19200, 38400, 57600, 115200 and the usual others");
  line.parity = parity_of(table);
  // Without parity there is a second stop bit in its place (Modbus over Serial Line V1.02, 2.5.1).
  const int usual_stop_bits = line.parity == Parity::None ? 2 : 1;
  line.stop_bits = static_cast<std::uint8_t>(table.integer("stop_bits", usual_stop_bits, {1, 2}));
  line.rs485 = table.boolean("rs485", false);
  line.unit = static_cast<std::uint8_t>(table.integer("unit", line.unit, {1, 247}));
  line.where = table.where();
  return line;
}

}  // namespace

result::Diagnostics read_modbus_acceptors(const TomlTable& server, const std::filesystem::path& folder,
                                          const modbus::server::TcpOptions& plain_tcp,
                                          const modbus::server::ServerOptions& options,
                                          ModbusAcceptors& acceptors) {
  result::Diagnostics problems;
  acceptors.plain = server.boolean("plain", true);
  if (server.has_table("tls")) {
    acceptors.tls = read_tls(server.table("tls"), folder, problems);
    acceptors.tls->tcp.allow = plain_tcp.allow;
    acceptors.tls->tcp.keep_alive_s = plain_tcp.keep_alive_s;
    acceptors.tls->tls.handshake = options.greeting_timeout;
  }
  for (const TomlTable& table : server.tables("line")) {
    LineOptions line = read_line(table, problems);
    if (std::ranges::find(acceptors.lines, line.device, &LineOptions::device) != acceptors.lines.end())
      refuse(problems, "C0514", table, "device", line.device.string() + " is another line already", "");
    acceptors.lines.push_back(std::move(line));
  }
  const bool any_role =
      std::ranges::any_of(options.clients, [](const ClientRule& rule) { return !rule.role.empty(); });
  if (any_role && !acceptors.tls)
    refuse(problems, "C0515", server, "client",
           "a client has a role, but nobody can show one without [modbus.server.tls]",
           "roles are in the certificates of clients");
  if (!acceptors.plain && !acceptors.tls && acceptors.lines.empty())
    refuse(problems, "C0516", server, "plain", "without plain TCP, TLS and lines nobody can come in",
           "[modbus.server.tls], or [[modbus.server.line]]");
  return problems;
}

}  // namespace stepwright::config

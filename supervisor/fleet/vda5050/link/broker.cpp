#include "supervisor/fleet/vda5050/link/broker.h"

#include <charconv>
#include <filesystem>
#include <optional>
#include <string_view>
#include <utility>

#include "runtime/ground/settings/toml_document.h"

namespace stepwright::vda5050_link {

namespace {

constexpr const char* kForm = "write mqtt://HOST[:PORT], or mqtts://HOST[:PORT] for TLS";

struct HostAndPort {
  std::string host;
  std::optional<std::string> port;
};

// "host", "host:1883", "[::1]:1883".
std::optional<HostAndPort> split(const std::string& text) {
  HostAndPort found;
  std::size_t end = text.find(':');
  if (!text.empty() && text.front() == '[') {
    const std::size_t close = text.find(']');
    if (close == std::string::npos) return std::nullopt;
    found.host = text.substr(1, close - 1);
    end = close + 1 == text.size() ? std::string::npos : close + 1;
    if (end != std::string::npos && text[end] != ':') return std::nullopt;
  } else {
    found.host = text.substr(0, end);
  }
  if (end != std::string::npos) found.port = text.substr(end + 1);
  if (found.host.empty() || found.host.find_first_of("/?# ") != std::string::npos) return std::nullopt;
  return found;
}

std::optional<std::uint16_t> port_of(const std::string& text) {
  unsigned value = 0;
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (code != std::errc() || end != text.data() + text.size() || value == 0 || value > 65'535) {
    return std::nullopt;
  }
  return static_cast<std::uint16_t>(value);
}

result::Result<void> read_address(const BrokerArguments& arguments, mqtt::Options& options) {
  std::string_view rest = arguments.url;
  const bool tls = rest.starts_with("mqtts://");
  if (!tls && !rest.starts_with("mqtt://")) {
    return result::fail("MQ003", {}, "'" + arguments.url + "' is no address of a broker", kForm);
  }
  rest.remove_prefix(tls ? 8 : 7);
  if (rest.find('@') != std::string_view::npos) {
    // Not repeated here: it may hold the password.
    return result::fail("MQ003", {}, "the address of the broker names a user",
                        "who reads the list of processes reads it, too; put user and password into a file: "
                        "--credentials FILE");
  }
  const auto parts = split(std::string(rest));
  const auto port =
      parts && parts->port ? port_of(*parts->port) : std::optional<std::uint16_t>(tls ? 8883 : 1883);
  if (!parts || !port) {
    return result::fail("MQ003", {}, "'" + arguments.url + "' is no address of a broker", kForm);
  }
  options.host = parts->host;
  options.port = *port;
  const bool files =
      !arguments.ca_file.empty() || !arguments.certificate_file.empty() || !arguments.key_file.empty();
  if (!tls && files) {
    return result::fail("MQ003", {}, "certificates are given, and the address says no TLS",
                        "write mqtts:// for TLS");
  }
  if (tls) options.tls = mqtt::Tls{arguments.ca_file, arguments.certificate_file, arguments.key_file};
  return {};
}

result::Result<void> read_credentials(const std::string& file, Broker& broker) {
  auto document = settings::TomlDocument::load(file);
  if (!document) return result::forward(document);
  const settings::TomlTable root = (*document)->root();
  broker.options.user = root.required_text("user");
  broker.options.password = root.text("password", "");
  if (auto wrong = (*document)->finish(); !wrong.empty()) return tl::unexpected(std::move(wrong));
  std::error_code none;
  const auto rights = std::filesystem::status(file, none).permissions();
  if ((rights & (std::filesystem::perms::group_read | std::filesystem::perms::others_read)) !=
      std::filesystem::perms::none) {
    broker.warnings.push_back({.code = "MQ004",
                               .severity = result::Severity::Warning,
                               .where = {file, 0, 0},
                               .message = "others may read the password",
                               .hint = "chmod 600"});
  }
  return {};
}

}  // namespace

result::Result<Broker> broker_of(const BrokerArguments& arguments) {
  Broker broker;
  if (auto good = read_address(arguments, broker.options); !good) return result::forward(good);
  if (!arguments.credentials_file.empty()) {
    if (auto good = read_credentials(arguments.credentials_file, broker); !good) return result::forward(good);
  }
  return broker;
}

result::Diagnostic explain(const mqtt::Trouble& trouble, const mqtt::Options& broker) {
  const std::string at = "broker " + broker.host + ":" + std::to_string(broker.port) + ": ";
  result::Diagnostic found{.code = "MQ005",
                           .severity = result::Severity::Error,
                           .where = {},
                           .message = at + trouble.text,
                           .hint = {}};
  switch (trouble.kind) {
    case mqtt::TroubleKind::Unreachable:
      found.severity = result::Severity::Warning;
      found.hint = "it is tried again; is the broker running, and is this its port?";
      break;
    case mqtt::TroubleKind::NoHost:
      found.hint = "is the name of the machine right?";
      break;
    case mqtt::TroubleKind::Refused:
      found.code = "MQ006";
      found.hint = broker.user.empty() ? "the broker wants user and password: --credentials FILE"
                                       : "are user and password right, and may this user connect?";
      break;
    case mqtt::TroubleKind::Tls:
      found.code = "MQ007";
      found.hint = "does --ca hold the authority that signed the broker's certificate, for this host name?";
      break;
  }
  return found;
}

}  // namespace stepwright::vda5050_link

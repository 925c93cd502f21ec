#include "cell/config/hmi_config.h"

#include <algorithm>
#include <cctype>

namespace stepwright::config {

bool is_loopback(const std::string& host) {
  const bool numbers = host.find_first_not_of("0123456789.") == std::string::npos;
  return host == "localhost" || host == "::1" || (numbers && host.starts_with("127."));
}

namespace {

// "[fd00::2]", as a browser shows an address of IPv6, is "fd00::2".
std::string without_brackets(std::string name) {
  if (name.size() > 2 && name.front() == '[' && name.back() == ']' && std::ranges::count(name, ':') > 1)
    return name.substr(1, name.size() - 2);
  return name;
}

// All addresses of a machine are a name of none.
bool is_all_addresses(const std::string& host) {
  return host == "0.0.0.0" || host == "::";
}

// A host name, or an IPv4 or IPv6 address without brackets. Neither scheme nor port belongs to it.
bool is_host_name(const std::string& name) {
  const bool address = std::ranges::count(name, ':') > 1;
  const auto fits = [&](unsigned char c) {
    return std::isalnum(c) != 0 || c == '.' || c == '-' || (address && c == ':');
  };
  return !name.empty() && name.size() <= 253 && std::ranges::all_of(name, fits);
}

void check_page_names(const settings::TomlTable& hmi, const HmiConfig& config) {
  for (const std::string& name : config.names) {
    if (is_host_name(name)) continue;
    hmi.report("names", "'" + name + "' cannot be the name of a host",
               "a name or an address as it stands in the browser, without scheme and port: \"line.plant\", "
               "\"[fd00::2]\"",
               "0470");
  }
  if (is_all_addresses(config.host) && config.names.empty()) {
    hmi.report("host", "at all addresses of a machine the server does not know what browsers call it",
               "names = [\"line.plant\", \"10.0.0.5\"]: other names are refused", "0470");
  }
}

const std::vector<std::string> kPanels = {"overview",  "alarms", "history", "synoptic", "plan",
                                          "incidents", "sfc",    "trend",   "state",    "replans",
                                          "monitors",  "scan",   "tags"};

WallConfig read_wall(const settings::TomlTable& table, const std::string& host) {
  WallConfig wall;
  for (const std::string& each : table.texts("addresses")) {
    if (const auto range = network::IpRange::parse(each))
      wall.addresses.push_back(*range);
    else
      table.report("addresses", "'" + each + "' is no address", "10.0.0.17, or many: 192.168.7.0/24", "0471");
  }
  const auto here = network::parse_ip("127.0.0.1");
  const bool from_here =
      std::ranges::any_of(wall.addresses, [&](const auto& range) { return here && range.contains(*here); });
  if (!wall.addresses.empty() && !from_here && is_loopback(host))
    table.report("addresses", "from there nobody reaches a server at " + host,
                 "[hmi] host, with tls_certificate and tls_key", "0471");
  if (auto panels = table.texts("panels"); table.has("panels")) wall.panels = std::move(panels);
  for (const std::string& each : wall.panels) {
    if (std::ranges::find(kPanels, each) != kPanels.end() || !wall_screen(each).empty()) continue;
    const std::string meant = settings::closest(each, kPanels);
    std::string all;
    for (const std::string& panel : kPanels) all += panel + ", ";
    all += "or \"screen:NAME\", a screen that people have drawn";
    table.report("panels", "there is no panel '" + each + "'",
                 meant.empty() ? all : "did you mean '" + meant + "'?", "0471");
  }
  return wall;
}

}  // namespace

std::string page_address(const HmiConfig& hmi, const std::string& host, std::uint16_t port) {
  const std::string& name = is_all_addresses(host) && !hmi.names.empty() ? hmi.names.front() : host;
  const bool is_ipv6 = name.find(':') != std::string::npos;
  return (hmi.certificate.empty() ? "http://" : "https://") + (is_ipv6 ? "[" + name + "]" : name) + ":" +
         std::to_string(port) + "/";
}

std::string wall_screen(const std::string& panel) {
  constexpr std::string_view kScreen = "screen:";
  return panel.starts_with(kScreen) ? panel.substr(kScreen.size()) : std::string();
}

HmiConfig read_hmi(const settings::TomlTable& hmi, const std::filesystem::path& folder,
                   const std::filesystem::path& state_dir) {
  HmiConfig config;
  const auto path = [&](const char* key) {
    const std::string text = hmi.text(key, {});
    return text.empty() ? std::filesystem::path() : folder / text;
  };
  config.host = without_brackets(hmi.text("host", config.host));
  for (std::string& each : hmi.texts("names")) config.names.push_back(without_brackets(std::move(each)));
  config.port = static_cast<std::uint16_t>(hmi.integer("port", config.port, {0, 65'535}));
  config.metrics_of = hmi.texts("metrics_of");
  config.anonymous_viewer = hmi.choice("anonymous", "none", {"none", "viewer"}) == "viewer";
  config.certificate = path("tls_certificate");
  config.key = path("tls_key");
  config.access_dir = path("access_dir");
  if (config.access_dir.empty()) config.access_dir = state_dir / "access";
  config.recipes = path("recipes");
  config.recipes_dir = path("recipes_dir");
  config.programs_dir = path("programs_dir");
  if (config.programs_dir.empty()) config.programs_dir = state_dir / "programs";
  config.tags = path("tags");
  config.screens_dir = path("screens_dir");
  if (config.screens_dir.empty()) config.screens_dir = state_dir / "screens";
  config.drawing = path("drawing");
  if (config.recipes_dir.empty()) config.recipes_dir = state_dir / "recipes";
  config.idle = std::chrono::minutes(hmi.integer("idle_minutes", 30, {1, 24 * 60}));
  config.session = std::chrono::hours(hmi.integer("session_hours", 12, {1, 24 * 7}));
  config.refresh = std::chrono::milliseconds(hmi.integer("refresh_ms", 20, {20, 1'000}));
  if (config.certificate.empty() != config.key.empty()) {
    hmi.report(config.key.empty() ? "tls_certificate" : "tls_key", "TLS needs a certificate and its key",
               "set both, tls_certificate and tls_key", "0469");
  }
  if (!is_loopback(config.host) && config.certificate.empty()) {
    hmi.report("host", "beyond this machine the page is served over TLS only",
               "set tls_certificate and tls_key, or leave host at 127.0.0.1", "0468");
  }
  check_page_names(hmi, config);
  config.wall = read_wall(hmi.table("wall"), config.host);
  return config;
}

}  // namespace stepwright::config

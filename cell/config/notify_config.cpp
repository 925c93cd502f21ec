#include "cell/config/notify_config.h"

#include <algorithm>
#include <charconv>
#include <string_view>

#include "runtime/ground/files/files.h"

namespace stepwright::config {
namespace {

using settings::TomlTable;

constexpr const char* kWrong = "0635";
constexpr std::uintmax_t kLongestSecret = 4'096;

bool has_scheme(const std::string& address, std::initializer_list<std::string_view> schemes) {
  const auto fits = [](unsigned char c) { return c > 0x20 && c != 0x7F; };
  return std::ranges::all_of(address, fits) && std::ranges::any_of(schemes, [&](std::string_view scheme) {
           return address.starts_with(scheme) && address.size() > scheme.size();
         });
}

// "smtp://mail.plant:587": what stands behind the last ':' of the host is a port, if anything does.
bool has_wrong_port(std::string_view address) {
  address.remove_prefix(std::min(address.find("://") + 3, address.size()));
  address = address.substr(0, address.find_first_of("/?#"));
  address.remove_prefix(std::min(address.rfind('@') + 1, address.size()));
  const std::size_t colon = address.rfind(':');
  if (colon == std::string_view::npos || address.find(']', colon) != std::string_view::npos) return false;
  const std::string_view digits = address.substr(colon + 1);
  unsigned port = 0;
  const auto read = std::from_chars(digits.data(), digits.data() + digits.size(), port);
  return read.ec != std::errc() || read.ptr != digits.data() + digits.size() || port < 1 || port > 65'535;
}

// What goes into the header of a mail: one @, no blanks, no brackets, no line breaks.
bool is_mail_address(const std::string& text) {
  const std::size_t at = text.find('@');
  const auto fits = [](unsigned char c) {
    return c > 0x20 && c < 0x7F &&
           std::string_view("<>(),;:\"\\[]").find(static_cast<char>(c)) == std::string_view::npos;
  };
  return at != std::string::npos && at > 0 && at + 1 < text.size() &&
         text.find('@', at + 1) == std::string::npos && std::ranges::all_of(text, fits);
}

void check_mail(const TomlTable& table, const NotifyConfig& config) {
  for (const std::string& each : config.mail) {
    if (!is_mail_address(each))
      table.report("mail", "'" + each + "' is no address of a mail", "shift@plant.example", kWrong);
  }
  if (!has_scheme(config.server, {"smtp://", "smtps://"}))
    table.report("server", "a mail needs a server", "server = \"smtp://mail.plant:587\", or smtps://",
                 kWrong);
  else if (has_wrong_port(config.server))
    table.report("server", "'" + config.server + "' has no port from 1 to 65535", "smtp://mail.plant:587",
                 kWrong);
  if (!is_mail_address(config.from))
    table.report("from", "a mail needs somebody who sends it", "from = \"line@plant.example\"", kWrong);
}

std::string read_secret(const std::filesystem::path& file, result::Diagnostics& found) {
  auto text = files::read_file(file.string(), kLongestSecret);
  if (!text) {
    found.insert(found.end(), text.error().begin(), text.error().end());
    return {};
  }
  return text->substr(0, text->find_first_of("\r\n"));
}

NotifyConfig read_one(const TomlTable& table, const std::filesystem::path& folder,
                      result::Diagnostics& found) {
  NotifyConfig config;
  config.name = table.required_text("name", kWrong);
  config.mail = table.texts("mail");
  config.server = table.text("server", {});
  config.from = table.text("from", {});
  config.user = table.text("user", {});
  if (const std::string file = table.text("password_file", {}); !file.empty())
    config.password = read_secret(folder / file, found);
  config.tls = table.boolean("tls", config.tls);
  config.web_hook = table.text("web_hook", {});
  config.priority = table.choice("priority", config.priority, {"critical", "high", "medium", "low"});
  config.delay = std::chrono::seconds(table.integer("delay_s", 60, {0, 86'400}));
  config.repeat = std::chrono::minutes(table.integer("repeat_min", 15, {0, 10'080}));
  if (config.mail.empty() == config.web_hook.empty())
    table.report(config.mail.empty() ? "name" : "web_hook", "a notification is a mail or a web hook",
                 "mail = [\"shift@plant.example\"], or web_hook = \"https://...\"", kWrong);
  else if (!config.mail.empty())
    check_mail(table, config);
  else if (!has_scheme(config.web_hook, {"http://", "https://"}))
    table.report("web_hook", "this is no address of a web hook", "https://chat.example/hook", kWrong);
  else if (has_wrong_port(config.web_hook))
    table.report("web_hook", "'" + config.web_hook + "' has no port from 1 to 65535",
                 "https://chat.example:8443/hook", kWrong);
  return config;
}

}  // namespace

std::vector<NotifyConfig> read_notify(const TomlTable& root, const std::filesystem::path& folder,
                                      result::Diagnostics& found) {
  std::vector<NotifyConfig> all;
  for (const TomlTable& table : root.tables("notify")) {
    NotifyConfig config = read_one(table, folder, found);
    if (std::ranges::find(all, config.name, &NotifyConfig::name) != all.end())
      table.report("name", "there are two notifications '" + config.name + "'", {}, kWrong);
    all.push_back(std::move(config));
  }
  return all;
}

}  // namespace stepwright::config

#pragma once

// [[notify]] of a cell's configuration: who is told of alarms that nobody acknowledges
// (hmi_web/doc/notify.md).
//
//   [[notify]]
//   name = "shift"                       # for people; unique
//   mail = ["shift@plant.example"]       # who gets it; or web_hook
//   server = "smtp://mail.plant:587"     # or smtps://
//   from = "line@plant.example"
//   user = "line"                        # of the server; default: without logging in
//   password_file = "mail.secret"        # beside this file; its first line
//   tls = true                           # false: a server without TLS will do
//   web_hook = "https://chat.example/x"  # a POST with JSON; with password_file a bearer token
//   priority = "high"                    # critical, high, medium or low: this one or a higher one
//   delay_s = 60                         # unacknowledged for so long
//   repeat_min = 15                      # until it is acknowledged; 0: told once
//
// Diagnostics: C0635 a name that is empty or there twice, neither or both of mail and web hook, an address
// that cannot be one; E0001 the file of the password cannot be read.
//
// Plain data; read by load_cell_config.

#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

#include "runtime/ground/settings/toml_document.h"

namespace stepwright::config {

struct NotifyConfig {
  std::string name;
  std::vector<std::string> mail;  // empty: a web hook
  std::string server;
  std::string from;
  std::string user;
  std::string password;
  bool tls = true;
  std::string web_hook;
  std::string priority = "high";
  std::chrono::seconds delay{60};
  std::chrono::minutes repeat{15};
};

// `found` gets what is wrong in other files; errors of this one are reported to its document.
std::vector<NotifyConfig> read_notify(const settings::TomlTable& root, const std::filesystem::path& folder,
                                      result::Diagnostics& found);

}  // namespace stepwright::config

#pragma once

// Channel on which people are told of alarms while nobody looks at the page: an e-mail, or a web hook.
//
// Plain values; any thread.

#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "hmi_web/alarms/definition.h"

namespace stepwright::notify {

struct Channel {
  std::string name = {};  // for people; unique
  // An e-mail: the server ("smtp://mail.plant:587", "smtps://..."), who sends it and who gets it.
  std::string server = {};
  std::string from = {};
  std::vector<std::string> to = {};
  std::string user = {};      // of the server; empty: without logging in
  std::string password = {};  // likewise, or a secret of the web hook
  bool needs_tls =
      true;  // a server that offers no TLS is refused; false: what is sent can be read on its way
  // A web hook: a POST with a JSON body.
  std::string web_hook = {};

  alarms::Priority at_least = alarms::Priority::High;  // this priority or a higher one
  std::chrono::seconds delay{60};                      // unacknowledged for so long
  std::chrono::seconds repeat{900};                    // until somebody acknowledges it; 0: told once

  bool is_mail() const { return web_hook.empty(); }
};

// An alarm that stands and that nobody has acknowledged.
struct StandingAlarm {
  std::string name = {};
  std::string text = {};
  std::string source = {};
  std::string response = {};
  alarms::Priority priority = alarms::Priority::Medium;
  std::int64_t raised_ns = 0;  // since 1970, on the history's clock
  double value = 0;
  bool is_bool = false;   // the source is a BOOL: the value is 0 or 1
  std::string told = {};  // the value as people read it: "95.00 l", "Auto"
  std::string unit = {};  // of the value: "l", of a TIME "s"; empty: it has none
};

struct Message {
  std::string subject = {};
  std::string text = {};
  std::string json = {};  // of a web hook
};

}  // namespace stepwright::notify

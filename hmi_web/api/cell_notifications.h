#pragma once

// Interface of the routes to who is told of alarms: hmi_web/notify implements it.
//
// Threads: every function from any; none waits for another machine.

#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

#include "runtime/ground/result/result.h"

namespace stepwright::api {

struct NotificationStatus {
  std::string channel = {};   // its name
  std::string kind = {};      // "mail", "web hook"
  std::string to = {};        // of a mail
  std::string priority = {};  // this one or a higher one
  std::chrono::seconds delay{0}, repeat{0};
  std::uint64_t sent = 0;
  std::uint64_t tests_done = 0;             // with or without success
  std::int64_t sent_ms = 0, failed_ms = 0;  // newest; since 1970; 0: never
  std::string problem = {};                 // of the newest try; empty: it has arrived
};

class CellNotifications {
 public:
  virtual ~CellNotifications() = default;

  virtual std::vector<NotificationStatus> status() const = 0;
  // Sends one soon; `status` tells what became of it. H0084: there is no such channel.
  [[nodiscard]] virtual result::Result<void> test(const std::string& channel, const std::string& user) = 0;
};

}  // namespace stepwright::api

#pragma once

// One channel, "shift", that remembers who asked for tests.
//
// Threads: one at a time.

#include <string>
#include <vector>

#include "hmi_web/api/cell_notifications.h"

namespace stepwright::api {

class FakeNotifications : public CellNotifications {
 public:
  std::vector<NotificationStatus> status() const override {
    NotificationStatus one;
    one.channel = "shift";
    one.kind = "mail";
    one.to = "shift@plant.example";
    one.priority = "high";
    one.delay = std::chrono::seconds(60);
    one.sent = testers.size();
    one.problem = "no answer";
    return {one};
  }
  result::Result<void> test(const std::string& channel, const std::string& user) override {
    if (channel != "shift") return result::fail("H0084", {}, "there is no such channel");
    testers.push_back(user);
    return {};
  }

  std::vector<std::string> testers;
};

}  // namespace stepwright::api

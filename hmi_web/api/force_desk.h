#pragma once

// What has been forced from the page: until when, by whom and why. Every force ends by itself; the list is
// kept on the disk, so that forces end in time after a restart of the server, too.
//
//   auto desk = ForceDesk::open(file, control, audit, std::chrono::system_clock::now, [&](auto json) { ...
//   }); desk->force({"MAIN.valve", "TRUE", 15min, "ada", "commissioning"});
//
// Threads: every function from any; a thread of its own ends what is due, once a second. It does not see what
// others force (`stepwright force`): the contract of Fast DDS has no reading of forces.

#include <chrono>
#include <condition_variable>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "hmi_web/access/audit_log.h"
#include "hmi_web/api/cell_control.h"
#include "runtime/result/result.h"

namespace stepwright::api {

inline constexpr std::size_t kMostForces = 64;  // of a runtime

struct ForceOrder {
  std::string name;
  std::string value;
  std::chrono::minutes duration{15};
  std::string user;
  std::string reason;
};

struct StandingForce {
  std::string name;
  std::string value;  // as the program spells it
  std::string user;
  std::string reason;
  std::chrono::system_clock::time_point since;
  std::chrono::system_clock::time_point until;
};

class ForceDesk {
 public:
  // `on_change` gets the list as JSON after every change and once at the start, from any thread.
  using OnChange = std::function<void(const std::string& json)>;

  // A list that cannot be read is refused (H0022): what is forced would not end.
  [[nodiscard]] static result::Result<std::unique_ptr<ForceDesk>> open(std::filesystem::path file,
                                                                       CellControl& control,
                                                                       access::AuditLog& audit,
                                                                       access::WallClock clock,
                                                                       OnChange on_change);
  // Leaves standing what is forced; the next server ends it.
  ~ForceDesk();

  // Forces it, or goes on forcing it with another value and time. On the disk before it is done.
  [[nodiscard]] result::Result<StandingForce> force(const ForceOrder& order);
  [[nodiscard]] result::Result<void> unforce(const std::string& name);
  std::string json() const;
  // Of everything that stands forced.
  std::vector<std::string> names() const;

  // Ends what is due now; the thread's work, for tests.
  void end_what_is_due();

 private:
  ForceDesk(std::filesystem::path file, CellControl& control, access::AuditLog& audit,
            access::WallClock clock, OnChange on_change, std::vector<StandingForce> standing);
  [[nodiscard]] result::Result<void> keep(std::vector<StandingForce> standing);
  void run();

  const std::filesystem::path file_;
  CellControl& control_;
  access::AuditLog& audit_;
  const access::WallClock clock_;
  const OnChange on_change_;
  std::mutex turn_;  // one change at a time, also while the runtime is asked
  mutable std::mutex mutex_;
  std::vector<StandingForce> standing_;  // guarded by mutex_
  std::condition_variable stop_signal_;
  bool stopping_ = false;  // guarded by mutex_
  std::thread thread_;     // last: it uses all of the above
};

}  // namespace stepwright::api

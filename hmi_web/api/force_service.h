#pragma once

// Service for the forces of the page: until when, by whom and why each stands. Each ends by itself: the
// runtime has its time and releases it, whatever becomes of this server. The list is kept on the disk, so
// that it is known after a restart, too. Beside them it lists the forces of others (`stepwright force`,
// another server), as the runtime tells of them.
//
//   auto service = ForceService::open(file, control, audit, std::chrono::system_clock::now,
//                               [&](auto json) { feed.set_forces(json); });
//   (*service)->force({"MAIN.valve", "TRUE", 15min, "ada", "commissioning"});
//
// Threads: every function from any; a thread of its own asks the runtime and takes off what is over, once a
// second.
// Invariants: a force of ours that the runtime does not have any more (a stop of the process, a download, an
// unforce at its socket), or has with another value or without an end, because somebody else has forced it
// since, is ours no longer and is never released by its timer; nothing is taken for gone before the runtime
// has said so twice in a row. Another server that forces the very value that we force cannot be told from us.
// While the runtime does not answer, or its link cannot tell, the list stays as it was.

#include <chrono>
#include <condition_variable>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "hmi_web/access/audit_log.h"
#include "hmi_web/api/cell_control.h"
#include "runtime/ground/result/result.h"

namespace stepwright::api {

inline constexpr std::size_t kMostForces = 64;  // of a runtime
inline constexpr const char* kTooMuchForced = "H0068";

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

class ForceService {
 public:
  // `on_change` gets the list as JSON after every change and once at the start, from any thread. A force of
  // somebody else has neither user nor reason, and null as its times.
  using OnChange = std::function<void(const std::string& json)>;

  // A list that cannot be read is refused (H0022): what is forced would be nobody's.
  [[nodiscard]] static result::Result<std::unique_ptr<ForceService>> open(std::filesystem::path file,
                                                                          CellControl& control,
                                                                          access::AuditLog& audit,
                                                                          access::WallClock clock,
                                                                          OnChange on_change);
  // Leaves standing what is forced: it ends in the runtime.
  ~ForceService();

  // Forces it for that time, or goes on forcing it with another value and time. On the disk before it is
  // done.
  [[nodiscard]] result::Result<StandingForce> force(const ForceOrder& order);
  [[nodiscard]] result::Result<void> unforce(const std::string& name);
  std::string json() const;
  // Of everything that stands forced, whoever has forced it.
  std::vector<std::string> names() const;

  // Asks the runtime what is forced, and ends what is due now; the thread's work, for tests.
  void look();

 private:
  ForceService(std::filesystem::path file, CellControl& control, access::AuditLog& audit,
               access::WallClock clock, OnChange on_change, std::vector<StandingForce> standing);
  [[nodiscard]] result::Result<void> keep(std::vector<StandingForce> standing);
  void ask_runtime();
  void end_what_is_due();
  void compare(const std::vector<ForcedPlace>& forced);
  // Of the list, with an entry in the audit trail.
  void take_off(const StandingForce& gone, const char* by, const std::string& why, const std::string& result);
  std::vector<StandingForce> standing() const;
  void tell();
  void run();

  const std::filesystem::path file_;
  CellControl& control_;
  access::AuditLog& audit_;
  const access::WallClock clock_;
  const OnChange on_change_;
  std::mutex turn_;  // one change at a time, also while the runtime is asked
  // Ours that the runtime did not have when it was asked last; guarded by turn_.
  std::set<std::string> missing_;
  int pause_ = 0;     // rounds in which a link that cannot tell is not asked; guarded by turn_
  std::string told_;  // what on_change has got last; guarded by turn_
  mutable std::mutex mutex_;
  std::vector<StandingForce> standing_;  // ours; guarded by mutex_
  std::vector<ForcedPlace> others_;      // of somebody else; guarded by mutex_
  std::condition_variable stop_signal_;
  bool stopping_ = false;  // guarded by mutex_
  std::thread thread_;     // last: it uses all of the above
};

}  // namespace stepwright::api

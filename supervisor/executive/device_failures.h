#pragma once

// Counts failures of the devices of the binding. An action that had no effect or did not end in time casts
// suspicion on every device that it needs; one that ends clears them. A device that is suspected for the
// second time has failed: plans must do without it.
//
// Threads: one thread uses an object.
//
//   DeviceFailures failures;
//   failures.suspect({"diverter 1"});
//   failures.suspect({"diverter 1"})   // {"diverter 1"}: from now on
//   failures.failed()                  // {"diverter 1"}

#include <map>
#include <set>
#include <string>
#include <vector>

namespace stepwright::executive {

class DeviceFailures {
 public:
  // Those that have failed by that.
  std::vector<std::string> suspect(const std::vector<std::string>& devices);
  // An action that needs them came to its end. What has failed stays so: nobody has looked at it.
  void clear(const std::vector<std::string>& devices);
  // As told by an earlier supervisor.
  void restore(const std::vector<std::string>& devices) { failed_.insert(devices.begin(), devices.end()); }

  const std::set<std::string>& failed() const { return failed_; }

 private:
  std::map<std::string, int> suspected_;  // times since it last worked
  std::set<std::string> failed_;
};

}  // namespace stepwright::executive

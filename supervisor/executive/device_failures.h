#pragma once

// Ledger of the devices of the binding that have failed. An action that did nothing or did not end in time
// casts suspicion on every device that it needs; one that ends clears all that it needs. A device that is
// suspected for the second time has failed: a plan that needs it would be in vain.
//
// Threads: one thread uses an object.
//
//   DeviceLedger ledger;
//   ledger.suspect({"diverter 1"});
//   ledger.suspect({"diverter 1"})   // {"diverter 1"}: from now on
//   ledger.failed()                  // {"diverter 1"}

#include <map>
#include <set>
#include <string>
#include <vector>

namespace stepwright::executive {

class DeviceLedger {
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

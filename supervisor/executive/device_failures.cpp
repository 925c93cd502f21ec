#include "supervisor/executive/device_failures.h"

namespace stepwright::executive {
namespace {

// Once may be a hand in the way.
constexpr int kFailed = 2;

}  // namespace

std::vector<std::string> DeviceFailures::suspect(const std::vector<std::string>& devices) {
  std::vector<std::string> failed;
  for (const std::string& device : std::set<std::string>(devices.begin(), devices.end())) {
    if (++suspected_[device] >= kFailed && failed_.insert(device).second) failed.push_back(device);
  }
  return failed;
}

void DeviceFailures::clear(const std::vector<std::string>& devices) {
  for (const std::string& device : devices) suspected_.erase(device);
}

}  // namespace stepwright::executive

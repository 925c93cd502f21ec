#include "runtime/service/internal/process_watch.h"

#include <unistd.h>

#include <fstream>
#include <utility>

namespace stepwright::service::internal {
namespace {

std::uint64_t resident_bytes() {
  std::ifstream file("/proc/self/statm");
  std::uint64_t size = 0;
  std::uint64_t resident = 0;
  file >> size >> resident;
  return resident * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
}

}  // namespace

ProcessWatch::ProcessWatch(std::string version) : version_(std::move(version)), began_(Clock::now()) {}

void ProcessWatch::fill(host::ProcessFigures& figures, std::size_t clients) {
  const auto now = Clock::now();
  if (now - looked_ >= std::chrono::seconds(1)) {
    looked_ = now;
    resident_bytes_ = resident_bytes();
  }
  figures.version = version_;
  figures.uptime_s = std::chrono::duration<double>(now - began_).count();
  figures.resident_bytes = resident_bytes_;
  figures.clients = clients;
}

}  // namespace stepwright::service::internal

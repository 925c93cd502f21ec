#include "programs/hmi/local_runtime.h"

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <sstream>
#include <system_error>

namespace stepwright::hmi {
namespace {

constexpr std::chrono::seconds kPause{1};
constexpr std::chrono::seconds kPatience{5};
constexpr unsigned long kAccepts = 0x10000;  // __SO_ACCEPTCON of the kernel's table

}  // namespace

bool listens_at(const std::string& socket, const std::string& table) {
  std::istringstream lines(table);
  for (std::string line; std::getline(lines, line);) {
    // Num RefCount Protocol Flags Type St Inode Path
    std::istringstream fields(line);
    std::string skipped;
    std::string flags;
    std::string rest;
    if (!(fields >> skipped >> skipped >> skipped >> flags >> skipped >> skipped >> skipped)) continue;
    std::getline(fields >> std::ws, rest);
    if (rest == socket && (std::strtoul(flags.c_str(), nullptr, 16) & kAccepts) != 0) return true;
  }
  return false;
}

LocalRuntime::LocalRuntime(const std::filesystem::path& socket) {
  // The table has the path as it was bound.
  std::error_code ignored;
  socket_ = std::filesystem::absolute(socket, ignored).lexically_normal().string();
}

bool LocalRuntime::is_there(Time now) {
  if (now >= next_look_) {
    next_look_ = now + kPause;
    std::ifstream file("/proc/net/unix");
    const std::string table{std::istreambuf_iterator<char>(file), {}};
    if (!listens_at(socket_, table)) {
      since_.reset();
    } else if (!since_) {
      since_ = now;
    }
  }
  return since_ && now - *since_ >= kPatience;
}

}  // namespace stepwright::hmi

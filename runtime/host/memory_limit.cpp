#include "runtime/host/memory_limit.h"

#include <sys/resource.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <map>
#include <utility>

#include "runtime/host/event_ring.h"
#include "runtime/host/thread_stacks.h"

namespace stepwright::host {
namespace {

// Bytes for each byte of bytecode, while machine code is made of it and for the quick form of the
// interpreter.
constexpr std::uint64_t kNativePerCodeByte = 28;
constexpr std::uint64_t kQuickPerCodeByte = 2;
// A task has a copy of the image and one of what it got; the event ring holds many.
constexpr std::uint64_t kImagesPerThread = 2;
constexpr std::uint64_t kImagesOnce = 2;
constexpr std::uint64_t kOfAThread = kThreadStackBytes + (64u << 10);
constexpr std::uint64_t kOnce = 2u << 20;
constexpr unsigned kCapIpcLock = 14;

std::optional<std::uint64_t> number_in(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::uint64_t value = 0;
  if (in >> value) return value;
  return std::nullopt;  // "max", or there is no such file
}

// "VmLck:  12 kB", "inactive_file 4096": by the first word.
std::map<std::string, std::string> entries_of(const std::filesystem::path& file) {
  std::map<std::string, std::string> entries;
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    const std::size_t end = line.find_first_of(": \t");
    if (end == std::string::npos) continue;
    const std::size_t begin = line.find_first_not_of(": \t", end);
    if (begin != std::string::npos) entries[line.substr(0, end)] = line.substr(begin);
  }
  return entries;
}

std::uint64_t value_of(const std::map<std::string, std::string>& entries, const char* name, int base = 10) {
  const auto found = entries.find(name);
  return found == entries.end() ? 0 : std::strtoull(found->second.c_str(), nullptr, base);
}

class Tightest {
 public:
  void add(std::uint64_t limit, std::uint64_t used, const char* what) {
    const std::uint64_t free = limit > used ? limit - used : 0;
    if (!room_ || free < room_->free_bytes) room_ = {limit, free, what};
  }
  void add_resource(__rlimit_resource resource, std::uint64_t used, const char* what) {
    rlimit limit{};
    if (getrlimit(resource, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY) add(limit.rlim_cur, used, what);
  }
  std::optional<MemoryLimit> take() { return std::move(room_); }

 private:
  std::optional<MemoryLimit> room_;
};

// What the kernel can take back at any time, the pages of files, does not count.
std::uint64_t used_in(const std::filesystem::path& group) {
  const auto entries = entries_of(group / "memory.stat");
  const std::uint64_t files = value_of(entries, "inactive_file") + value_of(entries, "active_file");
  const std::uint64_t used = number_in(group / "memory.current").value_or(0);
  return used > files ? used - files : 0;
}

// Of the group that the process is in, and of all around it (cgroup v2: one line, "0::/a/b").
void add_groups(const MemorySources& sources, Tightest& tightest) {
  std::ifstream in(sources.process / "cgroup");
  for (std::string line; std::getline(in, line);) {
    if (line.rfind("0::/", 0) != 0) continue;
    for (std::filesystem::path group = line.substr(4);; group = group.parent_path()) {
      const std::filesystem::path folder = sources.groups / group;
      if (const auto limit = number_in(folder / "memory.max"))
        tightest.add(*limit, used_in(folder), "of the control group (MemoryMax=)");
      if (group.empty()) return;
    }
  }
}

std::string in_mb(std::uint64_t bytes) {
  return std::to_string((bytes + (1u << 20) - 1) >> 20) + " MB";
}

}  // namespace

std::uint64_t needed_bytes(const MemoryNeed& need) {
  const std::uint64_t code = need.code_bytes * (need.native ? kNativePerCodeByte : kQuickPerCodeByte);
  const std::uint64_t images = need.image_bytes * (kImagesOnce + kImagesPerThread * need.threads);
  const std::uint64_t events = std::min(
      std::uint64_t{EventRing::kMostSlots} * need.image_bytes,
      std::max(std::uint64_t{EventRing::kBytes}, std::uint64_t{EventRing::kFewestSlots} * need.image_bytes));
  return kOnce + code + images + events + need.threads * kOfAThread;
}

std::optional<MemoryLimit> memory_limit(std::size_t own_limit_bytes, const MemorySources& sources) {
  constexpr std::uint64_t kKb = 1024;
  const auto status = entries_of(sources.process / "status");
  const auto kilobytes = [&](const char* name) { return value_of(status, name) * kKb; };
  Tightest tightest;
  if (own_limit_bytes > 0) tightest.add(own_limit_bytes, kilobytes("VmRSS"), "of the configuration");
  add_groups(sources, tightest);
  tightest.add_resource(RLIMIT_AS, kilobytes("VmSize"), "of the address space (ulimit -v)");
  tightest.add_resource(RLIMIT_DATA, kilobytes("VmData"), "of the data (ulimit -d)");
  const std::uint64_t locked = kilobytes("VmLck");
  const bool free_of_limit = ((value_of(status, "CapEff", 16) >> kCapIpcLock) & 1u) != 0;
  if (locked > 0 && !free_of_limit)
    tightest.add_resource(RLIMIT_MEMLOCK, locked, "of locked memory (ulimit -l)");
  return tightest.take();
}

result::Result<void> check_memory(const MemoryNeed& need, std::size_t own_limit_bytes,
                                  const MemorySources& sources) {
  const auto room = memory_limit(own_limit_bytes, sources);
  const std::uint64_t needed = needed_bytes(need);
  if (!room || needed <= room->free_bytes) return {};
  return result::fail("R0076", {"download", 0, 0},
                      "the program takes up to " + in_mb(needed) + " while it is prepared; of the limit " +
                          room->what + ", " + in_mb(room->limit_bytes) + ", " + in_mb(room->free_bytes) +
                          " are free",
                      "raise the limit, or load a smaller program; nothing was changed");
}

}  // namespace stepwright::host

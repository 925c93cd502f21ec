#include "runtime/io_memory/io_area.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <cassert>
#include <cerrno>
#include <cstring>

namespace stepwright::io_memory {
namespace {

constexpr std::size_t kMaxName = 64;

struct flock range(AreaLock lock, int type) {
  struct flock wanted {};
  wanted.l_type = static_cast<short>(type);
  wanted.l_whence = SEEK_SET;
  wanted.l_start = static_cast<off_t>(lock);
  wanted.l_len = 1;
  return wanted;
}

tl::unexpected<result::Diagnostics> refused(const std::filesystem::path& path, const std::string& why) {
  return result::fail("R0042", {path.string(), 0, 0}, "the shared-memory I/O cannot be had: " + why);
}

bool has_sizes(const AreaHeader& header, std::uint32_t input_bytes, std::uint32_t output_bytes) {
  return header.magic == kAreaMagic && header.version == kAreaVersion && header.input_bytes == input_bytes &&
         header.output_bytes == output_bytes;
}

}  // namespace

bool is_area_name(std::string_view name) {
  const auto proper = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' ||
           c == '_' || c == '.';
  };
  return !name.empty() && name.size() <= kMaxName && std::ranges::all_of(name, proper);
}

std::filesystem::path area_path(std::string_view name) {
  return std::filesystem::path("/dev/shm") / ("stepwright-io-" + std::string(name));
}

std::int64_t monotonic_ns() {
  timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  return now.tv_sec * 1'000'000'000 + now.tv_nsec;
}

result::Result<std::unique_ptr<IoArea>> IoArea::open(const std::string& name, std::uint32_t input_bytes,
                                                     std::uint32_t output_bytes) {
  assert(is_area_name(name) && input_bytes > 0 && output_bytes > 0);
  const std::filesystem::path path = area_path(name);
  const std::uint32_t wanted =
      static_cast<std::uint32_t>(sizeof(AreaHeader)) + block_bytes(input_bytes) + block_bytes(output_bytes);
  // Again once, if an area of other sizes had to go.
  for (int attempt = 0; attempt < 2; ++attempt) {
    const int descriptor = ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0600);
    if (descriptor < 0) return refused(path, std::strerror(errno));
    std::unique_ptr<IoArea> area(new IoArea(path, descriptor));
    struct stat info {};
    if (fstat(descriptor, &info) != 0) return refused(path, std::strerror(errno));
    if (info.st_uid != geteuid()) return refused(path, "it belongs to another user");
    struct flock making = range(AreaLock::Making, F_WRLCK);
    if (fcntl(descriptor, F_OFD_SETLKW, &making) != 0) return refused(path, std::strerror(errno));
    if (fstat(descriptor, &info) != 0) return refused(path, std::strerror(errno));
    if (info.st_nlink == 0) continue;  // it went while this one waited
    if (info.st_size != 0 && info.st_size != static_cast<off_t>(wanted)) {
      if (area->in_use()) {
        return result::fail("R0043", {path.string(), 0, 0}, "another process uses this area with other sizes",
                            "the same [image] sizes belong into the configurations of both");
      }
      unlink(path.c_str());
      continue;
    }
    if (info.st_size == 0 && ftruncate(descriptor, static_cast<off_t>(wanted)) != 0)
      return refused(path, std::strerror(errno));
    area->bytes_ = wanted;
    if (auto mapped = area->map(input_bytes, output_bytes); !mapped) return result::forward(mapped);
    // From now on nobody gives it other sizes, whether anybody drives already or not.
    struct flock use = range(AreaLock::Use, F_RDLCK);
    if (fcntl(descriptor, F_OFD_SETLK, &use) != 0) return refused(path, std::strerror(errno));
    area->unlock(AreaLock::Making);
    return area;
  }
  return refused(path, "it comes and goes");
}

// Writes the header of a new area, or of one that is left with other sizes of the same sum.
result::Result<void> IoArea::map(std::uint32_t input_bytes, std::uint32_t output_bytes) {
  void* memory = mmap(nullptr, bytes_, PROT_READ | PROT_WRITE, MAP_SHARED, descriptor_, 0);
  if (memory == MAP_FAILED) return refused(path_, std::strerror(errno));
  memory_ = static_cast<std::byte*>(memory);
  AreaHeader& area = header();
  if (has_sizes(area, input_bytes, output_bytes)) return {};
  if (area.magic != 0 && in_use()) {
    return result::fail("R0043", {path_.string(), 0, 0}, "another process uses this area with other sizes",
                        "the same [image] sizes belong into the configurations of both");
  }
  std::memset(memory_, 0, bytes_);
  area.version = kAreaVersion;
  area.input_bytes = input_bytes;
  area.output_bytes = output_bytes;
  area.inputs_at = sizeof(AreaHeader);
  area.outputs_at = area.inputs_at + block_bytes(input_bytes);
  area.magic = kAreaMagic;
  return {};
}

IoArea::~IoArea() {
  if (memory_ != nullptr) munmap(memory_, bytes_);
  close(descriptor_);
}

bool IoArea::try_lock(AreaLock lock) {
  struct flock wanted = range(lock, F_WRLCK);
  return fcntl(descriptor_, F_OFD_SETLK, &wanted) == 0;
}

void IoArea::unlock(AreaLock lock) {
  struct flock wanted = range(lock, F_UNLCK);
  fcntl(descriptor_, F_OFD_SETLK, &wanted);
}

bool IoArea::locked_elsewhere(AreaLock lock) const {
  struct flock asked = range(lock, F_WRLCK);
  return fcntl(descriptor_, F_OFD_GETLK, &asked) == 0 && asked.l_type != F_UNLCK;
}

bool IoArea::in_use() const {
  return locked_elsewhere(AreaLock::Lease) || locked_elsewhere(AreaLock::Guard) ||
         locked_elsewhere(AreaLock::Plant) || locked_elsewhere(AreaLock::Use);
}

}  // namespace stepwright::io_memory

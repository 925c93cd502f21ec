#include "programs/up/memory_file.h"

#include <sys/mman.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <utility>

namespace stepwright::up {

result::Result<MemoryFile> MemoryFile::make() {
  const int descriptor = memfd_create("stepwright-program", MFD_CLOEXEC);
  if (descriptor < 0)
    return result::fail("M0014", {},
                        std::string("the system gives no file in memory: ") + std::strerror(errno));
  return MemoryFile(descriptor);
}

MemoryFile::MemoryFile(MemoryFile&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}

MemoryFile& MemoryFile::operator=(MemoryFile&& other) noexcept {
  std::swap(descriptor_, other.descriptor_);
  return *this;
}

MemoryFile::~MemoryFile() {
  if (descriptor_ >= 0) close(descriptor_);
}

std::string MemoryFile::bytes() const {
  std::string all;
  std::array<char, 65'536> block{};
  for (ssize_t length = 1; length > 0;) {
    length = pread(descriptor_, block.data(), block.size(), static_cast<off_t>(all.size()));
    if (length > 0) all.append(block.data(), static_cast<std::size_t>(length));
  }
  return all;
}

}  // namespace stepwright::up

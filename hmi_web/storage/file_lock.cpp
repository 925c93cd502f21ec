#include "hmi_web/storage/file_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "hmi_web/storage/codes.h"

namespace stepwright::storage {

result::Result<FileLock> FileLock::take(const std::filesystem::path& file) {
  const std::string name = file.string() + ".lock";
  const int descriptor = ::open(name.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0600);
  if (descriptor < 0)
    return result::fail(kCannotOpen, {name},
                        std::string("the file cannot be opened: ") + std::strerror(errno),
                        errno == EACCES || errno == EPERM ? "be the user who runs the cell, or root"
                                                          : "see that its folder exists and can be written");
  FileLock lock(descriptor);
  if (::flock(descriptor, LOCK_EX | LOCK_NB) != 0)
    return result::fail(kInUse, {file.string()}, "another process writes the file", "end the other process");
  return lock;
}

FileLock::~FileLock() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

}  // namespace stepwright::storage

#include "runtime/ground/log/rotating_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

namespace stepwright::log {
namespace {

std::filesystem::path numbered(const std::filesystem::path& file, std::uint32_t number) {
  return file.string() + "." + std::to_string(number);
}

}  // namespace

tl::expected<std::unique_ptr<RotatingFile>, int> RotatingFile::open(const std::filesystem::path& file,
                                                                    const Rotation& rotation) {
  std::unique_ptr<RotatingFile> self(new RotatingFile(file, rotation));
  if (const int error = self->reopen(); error != 0) return tl::unexpected(error);
  return self;
}

RotatingFile::~RotatingFile() {
  if (descriptor_ >= 0) close(descriptor_);
}

// The file before stays open where there is no other.
int RotatingFile::reopen() {
  const int fresh = ::open(file_.c_str(), O_WRONLY | O_APPEND | O_CREAT | O_CLOEXEC, rotation_.mode);
  if (fresh < 0) return errno;
  if (descriptor_ >= 0) close(descriptor_);
  descriptor_ = fresh;
  return 0;
}

bool RotatingFile::is_still_there() const {
  struct stat ours {};
  struct stat named {};
  return fstat(descriptor_, &ours) == 0 && stat(file_.c_str(), &named) == 0 && ours.st_ino == named.st_ino &&
         ours.st_dev == named.st_dev;
}

int RotatingFile::append(std::string_view line) {
  if (!is_still_there()) static_cast<void>(reopen());
  struct stat info {};
  const bool counted = rotation_.max_bytes > 0 && fstat(descriptor_, &info) == 0 && S_ISREG(info.st_mode);
  if (counted && static_cast<std::uint64_t>(info.st_size) + line.size() > rotation_.max_bytes &&
      info.st_size > 0)
    rotate();
  ssize_t written = 0;
  do {
    written = ::write(descriptor_, line.data(), line.size());
  } while (written < 0 && errno == EINTR);
  if (written < 0) return errno;
  return static_cast<std::size_t>(written) == line.size() ? 0 : ENOSPC;
}

// One of all processes renames: whoever has the lock of the file that is still the one of this name.
void RotatingFile::rotate() {
  if (flock(descriptor_, LOCK_EX) != 0) return;
  if (is_still_there()) {
    std::error_code ignored;
    for (std::uint32_t i = rotation_.keep; i > 1; --i)
      std::filesystem::rename(numbered(file_, i - 1), numbered(file_, i), ignored);
    if (rotation_.keep > 0) {
      std::filesystem::rename(file_, numbered(file_, 1), ignored);
    } else {
      std::filesystem::remove(file_, ignored);
    }
  }
  flock(descriptor_, LOCK_UN);
  static_cast<void>(reopen());
}

}  // namespace stepwright::log

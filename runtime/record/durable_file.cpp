#include "runtime/record/durable_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <span>

namespace stepwright::record {
namespace {

class OpenFile {
 public:
  OpenFile(const std::filesystem::path& path, int flags)
      : descriptor_(open(path.c_str(), flags | O_CLOEXEC, 0600)), error_(descriptor_ < 0 ? errno : 0) {}
  ~OpenFile() {
    if (descriptor_ >= 0) close(descriptor_);
  }
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;

  int get() const { return descriptor_; }
  int error() const { return error_; }

 private:
  int descriptor_;
  int error_;
};

int sync_folder(const std::filesystem::path& path) {
  const auto folder = path.has_parent_path() ? path.parent_path() : std::filesystem::path(".");
  const OpenFile file(folder, O_RDONLY | O_DIRECTORY);
  if (file.error() != 0) return file.error();
  return fsync(file.get()) == 0 ? 0 : errno;
}

}  // namespace

tl::unexpected<result::Diagnostics> file_error(const std::filesystem::path& path, const char* what,
                                               int error) {
  return result::fail("R0024", {path.string(), 0, 0}, std::string(what) + ": " + std::strerror(error));
}

int write_at(int descriptor, std::span<const std::byte> bytes, std::size_t offset) {
  while (!bytes.empty()) {
    const ssize_t count = pwrite(descriptor, bytes.data(), bytes.size(), static_cast<off_t>(offset));
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return errno;
    if (count == 0) return ENOSPC;
    bytes = bytes.subspan(static_cast<std::size_t>(count));
    offset += static_cast<std::size_t>(count);
  }
  return 0;
}

result::Result<void> replace_file(const std::filesystem::path& path, std::span<const std::byte> bytes) {
  const std::filesystem::path fresh = path.string() + ".new";
  int error = 0;
  {
    const OpenFile file(fresh, O_WRONLY | O_CREAT | O_TRUNC | O_NOFOLLOW);
    error = file.error();
    if (error == 0) error = write_at(file.get(), bytes, 0);
    if (error == 0 && fsync(file.get()) != 0) error = errno;
  }
  if (error == 0 && rename(fresh.c_str(), path.c_str()) != 0) error = errno;
  if (error == 0) error = sync_folder(path);
  if (error == 0) return {};
  unlink(fresh.c_str());
  return file_error(path, "the file cannot be written", error);
}

result::Result<std::optional<std::vector<std::byte>>> read_whole(const std::filesystem::path& path,
                                                                 std::size_t most) {
  const char* const what = "the file cannot be read";
  const OpenFile file(path, O_RDONLY | O_NONBLOCK);
  if (file.error() == ENOENT) return std::nullopt;
  struct stat info {};
  if (file.error() != 0) return file_error(path, what, file.error());
  if (fstat(file.get(), &info) != 0) return file_error(path, what, errno);
  if (!S_ISREG(info.st_mode)) return file_error(path, what, EISDIR);
  if (static_cast<std::size_t>(info.st_size) > most) return file_error(path, what, EFBIG);
  std::vector<std::byte> bytes(static_cast<std::size_t>(info.st_size));
  std::size_t got = 0;
  while (got < bytes.size()) {
    const ssize_t count = read(file.get(), bytes.data() + got, bytes.size() - got);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return file_error(path, what, errno);
    if (count == 0) break;
    got += static_cast<std::size_t>(count);
  }
  bytes.resize(got);
  return bytes;
}

}  // namespace stepwright::record

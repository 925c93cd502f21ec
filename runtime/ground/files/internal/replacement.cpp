#include "runtime/ground/files/internal/replacement.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>

#include "runtime/ground/files/descriptor.h"
#include "runtime/ground/files/durable_file.h"

namespace stepwright::files::internal {
namespace {

constexpr mode_t kOwnersOnly = 0600;

int write_beside(const std::filesystem::path& fresh, std::span<const std::byte> bytes, bool durable) {
  const int flags = O_WRONLY | O_CREAT | O_TRUNC | O_NOFOLLOW | O_CLOEXEC;
  const Descriptor file(open(fresh.c_str(), flags, durable ? kOwnersOnly : 0666));
  if (!file.ok()) return errno;
  // What stood there before may have been for everybody.
  if (durable && fchmod(file.get(), kOwnersOnly) != 0) return errno;
  if (const int error = write_at(file.get(), bytes, 0); error != 0) return error;
  return durable && fsync(file.get()) != 0 ? errno : 0;
}

}  // namespace

int sync_folder_of(const std::filesystem::path& file) {
  const auto folder = file.has_parent_path() ? file.parent_path() : std::filesystem::path(".");
  const Descriptor opened(open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  return opened.ok() && fsync(opened.get()) == 0 ? 0 : errno;
}

int replace(const std::filesystem::path& path, std::span<const std::byte> bytes, const Replacement& how) {
  const std::filesystem::path fresh = path.string() + how.beside;
  int error = write_beside(fresh, bytes, how.durable);
  if (error == 0 && rename(fresh.c_str(), path.c_str()) != 0) error = errno;
  if (error == 0 && how.durable) error = sync_folder_of(path);
  if (error != 0) unlink(fresh.c_str());
  return error;
}

}  // namespace stepwright::files::internal

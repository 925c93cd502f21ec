#include "runtime/ground/files/durable_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <fstream>

#include "runtime/ground/files/internal/replacement.h"

namespace stepwright::files {
namespace {

constexpr const char* kUnread = "the file cannot be read";
constexpr const char* kUnwritten = "the file cannot be written";

int write_all(int descriptor, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t count = ::write(descriptor, bytes.data(), bytes.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return errno;
    if (count == 0) return ENOSPC;
    bytes.remove_prefix(static_cast<std::size_t>(count));
  }
  return 0;
}

// `Content`: bytes of any type, resizable.
template <typename Content>
result::Result<std::optional<Content>> read_whole(const std::filesystem::path& path, std::size_t most,
                                                  const Owner& owner) {
  const Descriptor file(open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC));
  if (!file.ok() && errno == ENOENT) return std::nullopt;
  struct stat info {};
  if (!file.ok() || fstat(file.get(), &info) != 0) return failed(owner, path, kUnread, errno);
  if (!S_ISREG(info.st_mode)) return failed(owner, path, kUnread, EISDIR);
  if (static_cast<std::size_t>(info.st_size) > most) return failed(owner, path, kUnread, EFBIG);
  Content content;
  content.resize(static_cast<std::size_t>(info.st_size));
  std::size_t got = 0;
  while (got < content.size()) {
    const ssize_t count = read(file.get(), content.data() + got, content.size() - got);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return failed(owner, path, kUnread, errno);
    if (count == 0) break;
    got += static_cast<std::size_t>(count);
  }
  content.resize(got);
  return content;
}

}  // namespace

tl::unexpected<result::Diagnostics> failed(const Owner& owner, const std::filesystem::path& path,
                                           const char* what, int error) {
  return result::fail(owner.code, {path.string(), 0, 0}, std::string(what) + ": " + std::strerror(error),
                      owner.hint);
}

result::Result<void> replace_file(const std::filesystem::path& path, std::span<const std::byte> bytes,
                                  const Owner& owner) {
  const int error = internal::replace(path, bytes, {.beside = ".new", .durable = true});
  if (error != 0) return failed(owner, path, kUnwritten, error);
  return {};
}

result::Result<void> replace_file(const std::filesystem::path& path, std::string_view text,
                                  const Owner& owner) {
  return replace_file(path, std::as_bytes(std::span(text)), owner);
}

result::Result<bool> remove_file(const std::filesystem::path& path, const Owner& owner) {
  if (::unlink(path.c_str()) != 0) {
    if (errno == ENOENT) return false;
    return failed(owner, path, "the file cannot be removed", errno);
  }
  if (auto synced = sync_folder_of(path, owner); !synced) return result::forward(synced);
  return true;
}

result::Result<void> make_private_folder(const std::filesystem::path& folder, const Owner& owner) {
  std::error_code error;
  if (folder.has_parent_path()) std::filesystem::create_directories(folder.parent_path(), error);
  if (::mkdir(folder.c_str(), 0700) != 0 && errno != EEXIST)
    return failed(owner, folder, "the folder cannot be made", errno);
  return {};
}

result::Result<void> sync_folder_of(const std::filesystem::path& file, const Owner& owner) {
  const int error = internal::sync_folder_of(file);
  if (error != 0) return failed(owner, file, "the folder cannot be synced", error);
  return {};
}

result::Result<Descriptor> open_for_append(const std::filesystem::path& path, const Owner& owner) {
  Descriptor out(::open(path.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC | O_NOFOLLOW, 0600));
  if (!out.ok() || ::fchmod(out.get(), 0600) != 0)
    return failed(owner, path, "the file cannot be opened", errno);
  return out;
}

result::Result<void> append(const Descriptor& file, const std::filesystem::path& path, std::string_view text,
                            const Owner& owner) {
  const off_t end = ::lseek(file.get(), 0, SEEK_END);
  int error = end < 0 ? errno : write_all(file.get(), text);
  if (error == 0 && ::fdatasync(file.get()) != 0) error = errno;
  if (error == 0) return {};
  auto problem = failed(owner, path, kUnwritten, error);
  // Half a line would make what follows it unreadable. Where this fails too, opening the file mends it.
  if (end >= 0 && ::ftruncate(file.get(), end) != 0) return problem;
  return problem;
}

result::Result<std::optional<std::vector<std::byte>>> read_bytes(const std::filesystem::path& path,
                                                                 std::size_t most, const Owner& owner) {
  return read_whole<std::vector<std::byte>>(path, most, owner);
}

result::Result<std::optional<std::string>> read_text(const std::filesystem::path& path, std::size_t most,
                                                     const Owner& owner) {
  return read_whole<std::string>(path, most, owner);
}

std::optional<std::string> read_bounded(const std::filesystem::path& file, std::size_t most) {
  std::error_code error;
  const auto size = std::filesystem::file_size(file, error);
  std::ifstream in(file, std::ios::binary);
  if (!in || error) return std::nullopt;
  std::string text(static_cast<std::size_t>(std::min<std::uintmax_t>(size, most)) + 1, '\0');
  in.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(in.gcount()));
  return text;
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

}  // namespace stepwright::files

#include "hmi_web/access/durable_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>

#include "hmi_web/access/codes.h"

namespace stepwright::access {
namespace {

auto failed(const std::filesystem::path& file, const char* what) {
  return result::fail(kFileFails, {file.string(), 0, 0}, std::string(what) + ": " + std::strerror(errno),
                      "users and the audit trail are kept in [hmi] access_dir, recipes in recipes_dir, "
                      "programs in programs_dir, screens in screens_dir");
}

bool write_all(int descriptor, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t count = ::write(descriptor, bytes.data(), bytes.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(count));
  }
  return true;
}

}  // namespace

result::Result<void> sync_folder_of(const std::filesystem::path& file) {
  const Descriptor folder(::open(file.parent_path().c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (!folder.open() || ::fsync(folder.number()) != 0) return failed(file, "the folder cannot be synced");
  return {};
}

Descriptor& Descriptor::operator=(Descriptor&& other) noexcept {
  std::swap(number_, other.number_);
  return *this;
}

Descriptor::~Descriptor() {
  if (number_ >= 0) ::close(number_);
}

result::Result<void> make_private_folder(const std::filesystem::path& folder) {
  std::error_code error;
  if (folder.has_parent_path()) std::filesystem::create_directories(folder.parent_path(), error);
  if (::mkdir(folder.c_str(), 0700) != 0 && errno != EEXIST)
    return failed(folder, "the folder cannot be made");
  return {};
}

result::Result<void> replace_private_file(const std::filesystem::path& file, std::string_view bytes) {
  const std::filesystem::path fresh = file.string() + ".new";
  {
    const Descriptor out(::open(fresh.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC | O_NOFOLLOW, 0600));
    if (!out.open() || ::fchmod(out.number(), 0600) != 0 || !write_all(out.number(), bytes) ||
        ::fsync(out.number()) != 0)
      return failed(fresh, "the file cannot be written");
  }
  if (::rename(fresh.c_str(), file.c_str()) != 0) return failed(file, "the file cannot be replaced");
  return sync_folder_of(file);
}

result::Result<bool> remove_durably(const std::filesystem::path& file) {
  if (::unlink(file.c_str()) != 0) {
    if (errno == ENOENT) return false;
    return failed(file, "the file cannot be removed");
  }
  if (auto synced = sync_folder_of(file); !synced) return result::forward(synced);
  return true;
}

result::Result<Descriptor> open_for_append(const std::filesystem::path& file) {
  Descriptor out(::open(file.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC | O_NOFOLLOW, 0600));
  if (!out.open() || ::fchmod(out.number(), 0600) != 0) return failed(file, "the file cannot be opened");
  return out;
}

result::Result<void> append_durably(const Descriptor& file, const std::filesystem::path& path,
                                    std::string_view bytes) {
  const off_t end = ::lseek(file.number(), 0, SEEK_END);
  if (end >= 0 && write_all(file.number(), bytes) && ::fdatasync(file.number()) == 0) return {};
  auto problem = failed(path, "the file cannot be written");
  // Half a line would make what follows it unreadable. Where this fails too, opening the file mends it.
  if (end >= 0 && ::ftruncate(file.number(), end) != 0) return problem;
  return problem;
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

result::Result<std::string> read_whole(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) return failed(file, "the file cannot be read");
  return std::string(std::istreambuf_iterator<char>(in), {});
}

}  // namespace stepwright::access

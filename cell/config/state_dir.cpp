#include "cell/config/state_dir.h"

#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "cell/config/cell_config.h"

namespace stepwright::config {
namespace {

tl::unexpected<result::Diagnostics> refused(const std::filesystem::path& folder, const std::string& why,
                                            const std::string& hint = {}) {
  return result::fail("R0078", {folder.string(), 0, 0}, why, hint);
}

// Of all cells of this user that name no folder.
std::filesystem::path users_folder() {
  return temporary_folder() / ("stepwright-" + std::to_string(geteuid()));
}

bool is_default(const CellConfig& config) {
  return config.state_dir.parent_path() == users_folder();
}

// Somebody else could put links and files of his own into a folder that he may write to.
result::Result<void> check_owner(const std::filesystem::path& folder, bool follow, bool anyones = false) {
  const char* const hint = "name another folder with state_dir in [cell]";
  struct stat info {};
  if ((follow ? stat(folder.c_str(), &info) : lstat(folder.c_str(), &info)) != 0)
    return refused(folder, std::string("the state folder cannot be used: ") + std::strerror(errno), hint);
  if (!S_ISDIR(info.st_mode)) return refused(folder, "the state folder is no folder", hint);
  if (!anyones && info.st_uid != geteuid() && info.st_uid != 0)
    return refused(folder,
                   "the state folder belongs to another user (" + std::to_string(info.st_uid) +
                       "), who could put files of his own there",
                   hint);
  if ((info.st_mode & S_IWOTH) != 0)
    return refused(folder, "everybody may write into the state folder",
                   "chmod o-w, or another state_dir in [cell]");
  return {};
}

// True if it was made.
result::Result<bool> make(const std::filesystem::path& folder) {
  std::error_code error;
  const bool made = std::filesystem::create_directories(folder, error);
  if (made && !error) std::filesystem::permissions(folder, std::filesystem::perms::owner_all, error);
  if (error) return refused(folder, "the state folder cannot be made: " + error.message());
  return made;
}

}  // namespace

std::filesystem::path default_state_dir(const std::string& cell) {
  return users_folder() / cell;
}

result::Result<bool> claim_state_dir(const CellConfig& config) {
  const std::filesystem::path& folder = config.state_dir;
  const bool by_default = is_default(config);
  if (by_default) {
    if (auto made = make(folder.parent_path()); !made) return made;
    if (auto checked = check_owner(folder.parent_path(), false); !checked) return result::forward(checked);
  }
  auto made = make(folder);
  if (!made) return made;
  if (auto checked = check_owner(folder, !by_default); !checked) return result::forward(checked);
  return made;
}

result::Result<void> check_state_dir(const CellConfig& config) {
  const bool by_default = is_default(config);
  const auto check = [&](const std::filesystem::path& folder) -> result::Result<void> {
    struct stat info {};
    if (lstat(folder.c_str(), &info) != 0 && errno == ENOENT) return {};
    return check_owner(folder, !by_default, !by_default);
  };
  if (by_default) {
    if (auto checked = check(config.state_dir.parent_path()); !checked) return checked;
  }
  return check(config.state_dir);
}

}  // namespace stepwright::config

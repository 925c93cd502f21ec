#include "cell/check/check_places.h"

#include <linux/magic.h>
#include <sys/stat.h>
#include <sys/vfs.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <climits>
#include <cstring>
#include <filesystem>
#include <string>

#include "cell/check/listening_servers.h"

namespace stepwright::check {
namespace {

namespace fs = std::filesystem;
using result::Severity;

// The folder that is there on the way to `path`, or `path` itself; errno says why not more of it.
fs::path nearest(fs::path path) {
  struct stat info {};
  while (stat(path.c_str(), &info) != 0 && (errno == ENOENT || errno == ENOTDIR) && path.has_parent_path() &&
         path != path.parent_path())
    path = path.parent_path();
  return path;
}

// Sets errno, as opening it would once the folders above it are there.
bool is_too_long(const fs::path& path) {
  errno = ENAMETOOLONG;
  return path.native().size() >= PATH_MAX || std::any_of(path.begin(), path.end(), [](const fs::path& each) {
           return each.native().size() > NAME_MAX;
         });
}

// Where the kernel shows what it knows; root, too, makes nothing there.
bool is_of_kernel(const fs::path& folder) {
  struct statfs info {};
  return statfs(folder.c_str(), &info) == 0 &&
         (info.f_type == PROC_SUPER_MAGIC || info.f_type == SYSFS_MAGIC);
}

class PlaceCheck {
 public:
  explicit PlaceCheck(const config::CellConfig& config) : config_(config), state_(whole(config.state_dir)) {
    struct stat info {};
    if (stat(state_.c_str(), &info) != 0) {
      const bool missing = errno == ENOENT;
      if (missing) folder("cell", "state_dir", state_);
      closed_ = !missing || !problems_.empty();  // check_state_dir says why one that is there cannot be used
    } else if (access(state_.c_str(), R_OK | X_OK) != 0) {
      closed_ = true;
      problems_.push_back({"C0476", Severity::Warning, where_of(config, "cell", "state_dir"),
                           "this user may not look into the state folder " + config.state_dir.string() +
                               ": " + std::strerror(errno),
                           "what lies there is not checked; be the user who runs the cell"});
    }
  }

  // `told`: who reads it says of one that is a folder what it is.
  void file(const char* table, const char* key, const fs::path& path, bool told = false) {
    if (path.empty() || is_hidden(path)) return;
    if (is_too_long(path)) return cannot(table, key, path);
    struct stat info {};
    if (stat(path.c_str(), &info) == 0) {
      if (S_ISDIR(info.st_mode)) return told ? void() : is_folder(table, key, path);
      if (access(path.c_str(), W_OK) != 0) may_not(table, key, path);
      return;
    }
    if (errno != ENOENT && errno != ENOTDIR) return cannot(table, key, path);
    if (path.filename() == "." || path.filename() == ".." || !path.has_filename())
      return is_folder(table, key, path);
    const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
    if (whole(folder) == state_) return;  // made at the start, and checked on its own
    if (stat(folder.c_str(), &info) != 0)
      return tell(table, key, "its folder " + folder.string() + " is not there",
                  "make it, or name a file in a folder that is there");
    if (!S_ISDIR(info.st_mode))
      return tell(table, key, folder.string() + " is no folder", "name a file in a folder");
    if (is_of_kernel(folder)) return of_kernel(table, key, folder);
    if (access(folder.c_str(), W_OK | X_OK) != 0) may_not(table, key, folder);
  }

  // It is made, with all folders above it.
  void folder(const char* table, const char* key, const fs::path& path) {
    if (path.empty() || is_hidden(path)) return;
    if (is_too_long(path)) return cannot(table, key, path);
    const fs::path there = nearest(path);
    struct stat info {};
    if (stat(there.c_str(), &info) != 0) {
      if (errno != ENOENT) cannot(table, key, path);
      return;
    }
    if (!S_ISDIR(info.st_mode))
      return tell(table, key, there.string() + " is no folder", "name a folder, or what can become one");
    if (is_of_kernel(there)) return of_kernel(table, key, there);
    if (access(there.c_str(), W_OK | X_OK) != 0) may_not(table, key, there);
  }

  result::Diagnostics take() { return std::move(problems_); }

 private:
  static fs::path whole(const fs::path& path) {
    std::error_code error;
    const fs::path absolute = fs::absolute(path, error).lexically_normal();
    return error ? path : absolute;
  }

  bool is_hidden(const fs::path& path) const {
    const fs::path rest = whole(path).lexically_relative(state_);
    return closed_ && !rest.empty() && *rest.begin() != "..";
  }

  void is_folder(const char* table, const char* key, const fs::path& path) {
    tell(table, key, path.string() + " is a folder", "name a file");
  }

  void of_kernel(const char* table, const char* key, const fs::path& folder) {
    tell(table, key, "nothing can be made in " + folder.string() + ", which is the kernel's",
         "name another place");
  }

  void cannot(const char* table, const char* key, const fs::path& path) {
    if (errno == EACCES) return may_not(table, key, path);
    tell(table, key, path.string() + ": " + std::strerror(errno), "name another place");
  }

  void may_not(const char* table, const char* key, const fs::path& path) {
    tell(table, key, "this user may not write " + path.string() + ": " + std::strerror(errno),
         "be the user who runs the cell, or give him the right", Severity::Warning);
  }

  void tell(const char* table, const char* key, const std::string& why, const char* hint,
            Severity severity = Severity::Error) {
    problems_.push_back({"C0476", severity, where_of(config_, table, key),
                         std::string("[") + table + "] " + key + " cannot be written: " + why, hint});
  }

  const config::CellConfig& config_;
  fs::path state_;
  bool closed_ = false;  // the state folder, for this user
  result::Diagnostics problems_;
};

}  // namespace

result::Diagnostics check_places(const config::CellConfig& config) {
  PlaceCheck places(config);
  places.file("retain", "file", config.retain.file, true);
  places.file("log", "file", config.log.file);
  places.file("record", "file", config.record.file);
  if (!config.boot.sources.empty()) places.file("runtime", "program", config.boot.program, true);
  places.folder("history", "folder", config.history.folder);
  places.folder("hmi", "access_dir", config.hmi.access_dir);
  places.folder("hmi", "programs_dir", config.hmi.programs_dir);
  places.folder("hmi", "screens_dir", config.hmi.screens_dir);
  if (!config.hmi.recipes.empty()) places.folder("hmi", "recipes_dir", config.hmi.recipes_dir);
  return places.take();
}

}  // namespace stepwright::check

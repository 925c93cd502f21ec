#include "ladder/driver/container_names.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <optional>
#include <set>

namespace stepwright::driver {

namespace {

using Path = std::filesystem::path;

bool is_below(const Path& path, const Path& folder) {
  return std::mismatch(folder.begin(), folder.end(), path.begin(), path.end()).first == folder.end();
}

// The deepest folder that holds both.
Path common_folder(const Path& left, const Path& right) {
  Path common;
  for (auto l = left.begin(), r = right.begin(); l != left.end() && r != right.end() && *l == *r; ++l, ++r)
    common /= *l;
  return common;
}

// "/plant/" is the folder "/plant".
Path folder_of(std::string_view text) {
  Path folder = Path(text).lexically_normal();
  return folder.has_filename() || !folder.has_relative_path() ? folder : folder.parent_path();
}

}  // namespace

std::vector<std::string> container_names(const std::vector<std::string>& names, std::string_view folder) {
  const Path home = folder_of(folder);
  std::optional<Path> shared;  // by the absolute ones that do not lie at home
  const auto is_outside = [&](const Path& path) {
    return path.is_absolute() && (home.empty() || !is_below(path, home));
  };
  std::vector<Path> paths;
  for (const std::string& each : names) {
    paths.push_back(Path(each).lexically_normal());
    if (!is_outside(paths.back())) continue;
    const Path parent = paths.back().parent_path();
    shared = shared ? common_folder(*shared, parent) : parent;
  }
  std::vector<std::string> result;
  std::map<std::string, std::set<Path>> users;
  for (const Path& each : paths) {
    const Path named = each.is_relative() ? each : each.lexically_relative(is_outside(each) ? *shared : home);
    result.push_back(named.generic_string());
    users[result.back()].insert(each);
  }
  for (std::size_t i = 0; i < paths.size(); ++i)
    if (users[result[i]].size() > 1) result[i] = paths[i].generic_string();
  return result;
}

std::vector<std::string> container_names(const source::SourceSet& sources, std::string_view folder) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < sources.size(); ++i)
    names.push_back(sources.name(source::FileId(static_cast<std::uint32_t>(i))));
  return container_names(names, folder);
}

}  // namespace stepwright::driver

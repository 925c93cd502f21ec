#include "supervisor/motion/robot/mesh_locator.h"

#include <algorithm>
#include <optional>
#include <string_view>

#include "supervisor/motion/robot/codes.h"

namespace stepwright::motion {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view kPackage = "package://";
constexpr std::string_view kFile = "file://";

// The rest of `name` after whole parts of a path; nothing where it does not begin so.
std::optional<std::string_view> after(std::string_view name, std::string_view beginning) {
  if (!name.starts_with(beginning)) return std::nullopt;
  std::string_view rest = name.substr(beginning.size());
  if (!rest.empty() && !beginning.ends_with('/') && rest.front() != '/') return std::nullopt;
  while (!rest.empty() && rest.front() == '/') rest.remove_prefix(1);
  return rest;
}

bool is_file(const fs::path& path) {
  std::error_code ignored;
  return fs::is_regular_file(path, ignored);
}

}  // namespace

void MeshLocator::map(std::string beginning, fs::path folder) {
  mapped_.emplace_back(std::move(beginning), std::move(folder));
  std::stable_sort(mapped_.begin(), mapped_.end(),
                   [](const auto& a, const auto& b) { return a.first.size() > b.first.size(); });
}

result::Result<fs::path> MeshLocator::find(const std::string& name) const {
  std::vector<fs::path> places;
  for (const auto& [beginning, folder] : mapped_)
    if (const auto rest = after(name, beginning)) {
      places.push_back(folder / *rest);
      break;
    }
  if (places.empty()) {
    if (const auto path = after(name, kPackage)) {
      const std::string_view inside = path->substr(std::min(path->find('/'), path->size() - 1) + 1);
      std::error_code ignored;
      for (fs::path at = fs::absolute(folder_, ignored).lexically_normal();; at = at.parent_path()) {
        places.push_back(at / *path);
        places.push_back(at / inside);
        if (at == at.parent_path()) break;
      }
    } else if (name.starts_with(kFile)) {
      places.emplace_back(name.substr(kFile.size()));
    } else {
      places.push_back(folder_ / name);
    }
  }
  const auto found = std::find_if(places.begin(), places.end(), is_file);
  if (found != places.end()) return *found;
  return result::fail(
      code::kNoMesh, {name}, "the file of this mesh is not found",
      "looked for " + places.front().string() +
          (places.size() > 1 ? " and " + std::to_string(places.size() - 1) + " more places" : "") +
          "; map its package to a folder");
}

}  // namespace stepwright::motion

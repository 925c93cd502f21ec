#include "cell/processes/known_cells.h"

#include <algorithm>
#include <system_error>

namespace stepwright::processes {
namespace {

constexpr const char* kFile = "cell.toml";

std::filesystem::path cells_folder() {
  const std::filesystem::path programs = std::filesystem::read_symlink("/proc/self/exe").parent_path();
  const std::filesystem::path installed = (programs / "../../share/stepwright/cells").lexically_normal();
  std::error_code error;
  if (std::filesystem::is_directory(installed, error)) return installed;
  return (programs / "../../../tests/cells").lexically_normal();
}

}  // namespace

std::vector<std::string> known_cells() {
  std::vector<std::string> names;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(cells_folder(), error)) {
    if (std::filesystem::is_regular_file(entry.path() / kFile, error))
      names.push_back(entry.path().filename().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

result::Result<std::filesystem::path> find_cell(const std::string& cell) {
  if (cell.ends_with(".toml")) return std::filesystem::path(cell);
  const std::filesystem::path file = cells_folder() / cell / kFile;
  std::error_code error;
  if (std::filesystem::is_regular_file(file, error)) return file;
  std::string known;
  for (const std::string& name : known_cells()) known += (known.empty() ? "" : ", ") + name;
  return result::fail("M0002", {}, "there is no cell '" + cell + "'",
                      "known cells: " + known + "; or give the path of a cell's .toml file");
}

}  // namespace stepwright::processes

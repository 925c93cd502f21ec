#include "runtime/ground/process/temporary_folder.h"

#include <cstdlib>
#include <string>
#include <system_error>

namespace stepwright::process {

std::filesystem::path temporary_place() {
  std::error_code none;
  const std::filesystem::path place = std::filesystem::temp_directory_path(none);
  return none ? std::filesystem::path("/tmp") : place;
}

TemporaryFolder::TemporaryFolder(const std::filesystem::path& in) {
  std::string pattern = (in / "stepwright-XXXXXX").string();
  if (mkdtemp(pattern.data()) != nullptr) path_ = pattern;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  if (!path_.empty()) std::filesystem::remove_all(path_, ignored);
}

}  // namespace stepwright::process

#pragma once

// A folder of a test's own that goes with its object.
//
//   const TemporaryFolder folder;
//   std::ofstream(folder / "cell.toml") << text;

#include <stdlib.h>

#include <filesystem>
#include <stdexcept>
#include <string>

namespace stepwright::support {

class TemporaryFolder {
 public:
  // In `around`, which exists. Throws std::runtime_error if it cannot be made.
  explicit TemporaryFolder(const std::filesystem::path& around = std::filesystem::temp_directory_path()) {
    std::string path = (around / "stepwright-test-XXXXXX").string();
    if (::mkdtemp(path.data()) == nullptr) throw std::runtime_error("no temporary folder");
    path_ = path;
  }
  ~TemporaryFolder() {
    std::error_code ignored;  // a leftover in the temporary folder harms nobody
    std::filesystem::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

 private:
  std::filesystem::path path_;
};

}  // namespace stepwright::support

#pragma once

// A folder of its own for as long as the object lives. Threads: one.
//
//   const TemporaryFolder folder(temporary_place());
//   if (folder.path().empty()) ...

#include <filesystem>

namespace stepwright::process {

// Where the system wants such folders: TMPDIR, or /tmp.
std::filesystem::path temporary_place();

class TemporaryFolder {
 public:
  // In a folder that is there. Without a path if none can be made.
  explicit TemporaryFolder(const std::filesystem::path& in);
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace stepwright::process

#pragma once

// A ZIP archive that somebody else has made, read and unpacked with limits: minizip behind a move-only
// handle.
//
// Nothing is written outside of the folder that it is unpacked to, whatever the names in it say; every file
// is written as a plain file, so that there are no links; what the archive says of its sizes is not believed.
//
//   auto archive = ZipArchive::open("tank.fmu");
//   auto text = archive->read("modelDescription.xml", 16 << 20);
//
// Threads: one. Fails with C0330: the file is no archive, one of its names is refused, or it is too large.

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/ground/result/result.h"

namespace stepwright::fmu {

struct UnpackLimits {
  std::uint64_t files = 10'000;
  std::uint64_t bytes = std::uint64_t{1} << 30;  // of all files, unpacked
  std::uint64_t file_bytes = std::uint64_t{512} << 20;
  std::size_t name_bytes = 512;
};

class ZipArchive {
 public:
  [[nodiscard]] static result::Result<ZipArchive> open(const std::filesystem::path& file,
                                                       const UnpackLimits& limits = {});
  ~ZipArchive();
  ZipArchive(ZipArchive&& other) noexcept;
  ZipArchive& operator=(ZipArchive&& other) noexcept;

  // As they stand in the archive; folders end with '/'.
  const std::vector<std::string>& names() const { return names_; }
  bool has(std::string_view name) const;
  // One file, of at most so many bytes.
  [[nodiscard]] result::Result<std::string> read(const std::string& name, std::uint64_t most_bytes);
  // Everything, into a folder that is there.
  [[nodiscard]] result::Result<void> unpack(const std::filesystem::path& folder);

 private:
  explicit ZipArchive(std::filesystem::path file) : file_(std::move(file)) {}
  [[nodiscard]] result::Result<void> list();
  // Passes a file on in pieces; fails if it is longer than `most_bytes`.
  template <typename Sink>
  [[nodiscard]] result::Result<std::uint64_t> pass(std::size_t file, std::uint64_t most_bytes, Sink sink);
  tl::unexpected<result::Diagnostics> refuse(const std::string& why, const std::string& hint = {}) const;

  std::filesystem::path file_;
  UnpackLimits limits_;
  void* handle_ = nullptr;
  // Where each file stands in the archive's list: to look for its name there would take as many steps as
  // there are files, for every file.
  struct Place {
    std::uint64_t in_list = 0;
    std::uint64_t number = 0;
  };
  std::vector<std::string> names_;
  std::vector<Place> places_;
};

// A name that leads nowhere but into the folder: relative, without "..", "\\", ':' or control characters.
bool is_safe_name(std::string_view name);

}  // namespace stepwright::fmu

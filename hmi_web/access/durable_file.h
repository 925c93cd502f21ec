#pragma once

// Files that only their owner reads and that are on the disk when a call returns.
//
// Thread rule: one thread per file. Fails with H0021.

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "runtime/ground/result/result.h"

namespace stepwright::access {

// A descriptor that closes itself.
class Descriptor {
 public:
  explicit Descriptor(int number = -1) : number_(number) {}
  Descriptor(Descriptor&& other) noexcept : number_(other.number_) { other.number_ = -1; }
  Descriptor& operator=(Descriptor&& other) noexcept;
  ~Descriptor();
  int number() const { return number_; }
  bool open() const { return number_ >= 0; }

 private:
  int number_;
};

// Makes the folder with mode 0700 if it is not there.
[[nodiscard]] result::Result<void> make_private_folder(const std::filesystem::path& folder);
// Whole or not at all: written beside its place with mode 0600, synced, moved there, the folder synced.
[[nodiscard]] result::Result<void> replace_private_file(const std::filesystem::path& file,
                                                        std::string_view bytes);
// Gone for good when it returns; false: there was none.
[[nodiscard]] result::Result<bool> remove_durably(const std::filesystem::path& file);
// That a file has come, gone or another name is on the disk.
[[nodiscard]] result::Result<void> sync_folder_of(const std::filesystem::path& file);
// Opened for appending, made with mode 0600 if it is not there.
[[nodiscard]] result::Result<Descriptor> open_for_append(const std::filesystem::path& file);
// All bytes, then fdatasync. What was written of a text that failed is cut off again.
[[nodiscard]] result::Result<void> append_durably(const Descriptor& file, const std::filesystem::path& path,
                                                  std::string_view bytes);
// At most one byte more than `most`: a file that grows meanwhile does not fill the memory. Nothing: it cannot
// be read.
std::optional<std::string> read_bounded(const std::filesystem::path& file, std::size_t most);
[[nodiscard]] result::Result<std::string> read_whole(const std::filesystem::path& file);

}  // namespace stepwright::access

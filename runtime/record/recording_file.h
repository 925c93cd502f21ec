#pragma once

// One file of a recording while it is written: records are gathered into chunks, each written at once with
// its checksum.
//
//   auto file = RecordingFile::create("run.swrec");
//   (*file)->add(record);
//   (*file)->flush();                        // the chunk so far
//   auto closed = (*file)->close();
//
// Threads: one. Invariants: a recording that exists at its path is kept beside it as `<path>.1`, and any
// other file stays and is refused (R0051); what has been flushed survives the end of the process; a chunk
// that could not be written whole ends the file.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <vector>

#include "runtime/ground/result/result.h"

namespace stepwright::record {

class RecordingFile {
 public:
  // Fails with R0051.
  [[nodiscard]] static result::Result<std::unique_ptr<RecordingFile>> create(
      const std::filesystem::path& path);
  ~RecordingFile();
  RecordingFile(const RecordingFile&) = delete;
  RecordingFile& operator=(const RecordingFile&) = delete;

  // Adds a record to the chunk, which is written when it is large enough. Fails with R0051.
  [[nodiscard]] result::Result<void> add(std::span<const std::byte> record);
  [[nodiscard]] result::Result<void> flush();
  // Flushes and has the system write everything to the disk.
  [[nodiscard]] result::Result<void> close();

  bool has_unwritten() const { return !chunk_.empty(); }
  std::uint64_t bytes() const { return bytes_ + chunk_.size(); }

 private:
  RecordingFile(std::filesystem::path path, int descriptor)
      : path_(std::move(path)), descriptor_(descriptor) {}
  [[nodiscard]] result::Result<void> write(std::span<const std::byte> bytes);
  tl::unexpected<result::Diagnostics> failed(int error) const;

  std::filesystem::path path_;
  int descriptor_;
  std::uint32_t sequence_ = 0;
  std::uint64_t bytes_ = 0;
  std::vector<std::byte> chunk_;  // with room for its header in front, or empty
};

}  // namespace stepwright::record

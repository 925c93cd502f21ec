#pragma once

// A recording as a sequence of records, chunk by chunk, each checked before anything of it is used.
//
//   auto reader = RecordingReader::open("run.swrec");
//   while (true) {
//     auto record = (*reader)->next();          // an error: damage, located
//     if (!record || !*record) break;           // no record: the end
//     ... (**record)[0] is its RecordKind
//   }
//
// Threads: one. Any bytes are safe to read. A last chunk that is not whole, as a killed runtime leaves it, is
// no damage: it ends the recording, and unfinished_bytes() says how long it is.

#include <cstddef>
#include <cstdint>
#include <fstream>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "runtime/base/byte_reader.h"
#include "runtime/ground/result/result.h"

namespace stepwright::record {

class RecordingReader {
 public:
  // Fails with R0051 (cannot be read), R0054 (no recording) or R0059 (of another version).
  [[nodiscard]] static result::Result<std::unique_ptr<RecordingReader>> open(const std::string& path);

  // The next record, valid until the next call; none at the end. Fails with R0053 where the file is damaged.
  [[nodiscard]] result::Result<std::optional<std::span<const std::byte>>> next();

  // Of the chunk that the newest record stands in.
  std::uint64_t chunk_offset() const { return chunk_offset_; }
  std::uint64_t unfinished_bytes() const { return unfinished_bytes_; }
  const std::string& path() const { return path_; }

  // A diagnostic at this chunk.
  tl::unexpected<result::Diagnostics> fail_here(const char* code, const std::string& what) const;

 private:
  explicit RecordingReader(std::string path) : path_(std::move(path)) {}
  [[nodiscard]] result::Result<bool> next_chunk();
  bool chunk_follows(std::uint32_t sequence);

  std::string path_;
  std::ifstream file_;
  std::uint64_t size_ = 0;
  std::uint64_t position_ = 0;  // in the file, of the next chunk
  std::uint64_t chunk_offset_ = 0;
  std::uint64_t unfinished_bytes_ = 0;
  std::uint32_t sequence_ = 0;
  std::vector<std::byte> chunk_;
  base::ByteReader in_{{}};
};

}  // namespace stepwright::record

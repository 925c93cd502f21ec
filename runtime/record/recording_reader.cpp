#include "runtime/record/recording_reader.h"

#include <algorithm>
#include <cstring>
#include <utility>

#include "runtime/record/recording_format.h"

namespace stepwright::record {

tl::unexpected<result::Diagnostics> RecordingReader::fail_here(const char* code,
                                                               const std::string& what) const {
  return result::fail(code, {path_, 0, 0}, "at byte " + std::to_string(chunk_offset_) + ": " + what);
}

result::Result<std::unique_ptr<RecordingReader>> RecordingReader::open(const std::string& path) {
  std::unique_ptr<RecordingReader> self(new RecordingReader(path));
  self->file_.open(path, std::ios::binary | std::ios::ate);
  const std::streamoff size = self->file_ ? static_cast<std::streamoff>(self->file_.tellg()) : -1;
  if (size < 0) return result::fail("R0051", {path, 0, 0}, "the recording cannot be read");
  self->size_ = static_cast<std::uint64_t>(size);
  FileHeader header{};
  self->file_.seekg(0);
  self->file_.read(reinterpret_cast<char*>(&header), sizeof header);
  if (!self->file_ || header.magic != kFileMagic) {
    return result::fail("R0054", {path, 0, 0}, "the file is no recording",
                        "recordings are made by `stepwright record` or [record] file");
  }
  if (header.version != kFormatVersion || header.reserved != 0) {
    return result::fail("R0059", {path, 0, 0},
                        "the recording has version " + std::to_string(header.version) +
                            ", this program reads version " + std::to_string(kFormatVersion));
  }
  self->position_ = sizeof header;
  return self;
}

result::Result<std::optional<std::span<const std::byte>>> RecordingReader::next() {
  while (in_.at_end()) {
    auto there = next_chunk();
    if (!there) return result::forward(there);
    if (!*there) return std::nullopt;
  }
  std::uint64_t size = 0;
  if (!read_varint(in_, size) || size == 0 || size > in_.remaining()) {
    return fail_here("R0054", "a record is longer than its chunk");
  }
  return in_.read_bytes(static_cast<std::size_t>(size));
}

result::Result<bool> RecordingReader::next_chunk() {
  chunk_offset_ = position_;
  const std::uint64_t left = size_ - position_;
  if (left == 0) return false;
  ChunkHeader header{};
  const bool headed = left >= sizeof header;
  if (headed) file_.read(reinterpret_cast<char*>(&header), sizeof header);
  if (headed && (header.magic != kChunkMagic || header.sequence != sequence_)) {
    return fail_here("R0053", "the recording is damaged: no chunk begins here");
  }
  if (headed && header.bytes > kMaxChunkPayload) {
    return fail_here("R0053",
                     "the recording is damaged: a chunk of " + std::to_string(header.bytes) + " bytes");
  }
  if (!headed || header.bytes > left - sizeof header) {
    if (chunk_follows(sequence_ + 1))
      return fail_here("R0053", "the recording is damaged: a chunk has lost its end");
    unfinished_bytes_ = left;
    position_ = size_;
    return false;
  }
  chunk_.resize(header.bytes);
  file_.read(reinterpret_cast<char*>(chunk_.data()), static_cast<std::streamsize>(chunk_.size()));
  if (!file_) return fail_here("R0051", "the recording cannot be read");
  if (chunk_crc(header, chunk_) != header.crc) {
    return fail_here("R0053", "the recording is damaged: the checksum of a chunk is wrong");
  }
  ++sequence_;
  position_ += sizeof header + header.bytes;
  in_ = base::ByteReader(chunk_);
  return true;
}

// True if the header of the chunk with this number stands behind the present one: what looks like an
// unfinished chunk at the end is then a damaged one in the middle.
bool RecordingReader::chunk_follows(std::uint32_t sequence) {
  constexpr std::size_t kStretch = 1u << 20;
  char wanted[8];
  std::memcpy(wanted, &kChunkMagic, 4);
  std::memcpy(wanted + 4, &sequence, 4);
  std::string stretch;
  for (std::uint64_t at = position_ + sizeof(ChunkHeader); at < size_; at += kStretch) {
    stretch.resize(static_cast<std::size_t>(std::min<std::uint64_t>(kStretch + sizeof wanted, size_ - at)));
    file_.clear();
    file_.seekg(static_cast<std::streamoff>(at));
    file_.read(stretch.data(), static_cast<std::streamsize>(stretch.size()));
    if (stretch.find(std::string_view(wanted, sizeof wanted)) != std::string::npos) return true;
  }
  return false;
}

}  // namespace stepwright::record

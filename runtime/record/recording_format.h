#pragma once

// The file of a recording: what its chunks and records are made of. Specified byte by byte in
// runtime/doc/recording_format.md; writer (recording_file.h), scan side (scan_tap.h) and reader
// (recording_reader.h) meet here only.
//
// Pure functions and plain values; any thread. Invariants: little-endian; an Encoder never writes behind its
// buffer, and what does not fit marks it as failed.
//
//   std::array<std::byte, 64> buffer;
//   Encoder out(buffer);
//   out.put(RecordKind::Scan).put_varint(7);
//   ring.push(out.bytes());
//
// Diagnostics of recordings: R0051 the file cannot be written or read, R0052 refused in the present state,
// R0053 the end is missing (a warning) or is damaged, R0054 contents that no runtime writes, R0055 a replay
// that differs, R0056 scans are missing, R0057 an unknown name, R0058 a value that does not fit its variable,
// R0059 another version of the format.

#include <array>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <type_traits>

#include "runtime/base/byte_reader.h"

namespace stepwright::record {

inline constexpr std::array<char, 8> kFileMagic = {'S', 'T', 'S', 'W', 'R', 'E', 'C', '\n'};
inline constexpr std::uint32_t kFormatVersion = 1;
inline constexpr std::uint32_t kChunkMagic = 0x4B4E4843;  // "CHNK"
// Of a chunk's records: a container of the largest size and a state of the largest image fit.
inline constexpr std::uint32_t kMaxChunkPayload = 40u << 20;

struct FileHeader {
  std::array<char, 8> magic = kFileMagic;
  std::uint32_t version = kFormatVersion;
  std::uint32_t reserved = 0;
};
static_assert(sizeof(FileHeader) == 16);

struct ChunkHeader {
  std::uint32_t magic = kChunkMagic;
  std::uint32_t sequence = 0;  // from 0 within the file
  std::uint32_t bytes = 0;     // of the records behind it
  std::uint32_t crc = 0;       // CRC-32C over sequence, bytes and records
};
static_assert(sizeof(ChunkHeader) == 16);

enum class RecordKind : std::uint8_t {
  Session = 1,  // how the runtime is configured; the first record of a file
  Program = 2,  // a container
  State = 3,    // everything that the next scan starts from
  Scan = 4,     // its time, its inputs as a difference to those of the scan before, its hash
  Force = 5,    // commands between two scans
  Unforce = 6,
  Write = 7,
  Stop = 8,
  Load = 9,
  Keyframe = 10,  // the complete image after a scan
  Gap = 11,       // scans from here on to the next State are missing
  End = 12,       // an orderly end; the last record of a file
};

enum class StateCause : std::uint8_t {
  Begin = 0,    // the recording began while this program was loaded
  Start = 1,    // a start, cold or warm
  Change = 2,   // another program went on from where the one before it stood
  Segment = 3,  // a new file of the same recording
  Resume = 4,   // after a Gap
  Tasks = 5,    // tasks on other threads wrote to the image since the scan before
};

// Flags of a Scan record; the state of the scan cycle after it stands in the three bits from kScanStateShift.
enum ScanFlag : std::uint8_t {
  kScanInputs = 1,     // the inputs changed: runs follow
  kScanReadLost = 2,   // the driver gave no inputs
  kScanWriteLost = 4,  // the driver did not take the outputs
  kScanHash = 8,       // the hash of the image follows
  kScanStep = 16,      // the distance in time to the scan before differs from the one before it: it follows
};
inline constexpr unsigned kScanStateShift = 5;

// Of the bytes of sequence and length of a chunk's header and of its records.
std::uint32_t chunk_crc(const ChunkHeader& header, std::span<const std::byte> payload);

inline constexpr std::size_t kMaxVarintBytes = 10;

// Small signed numbers as small unsigned ones.
constexpr std::uint64_t zigzag(std::int64_t value) {
  return (static_cast<std::uint64_t>(value) << 1) ^ static_cast<std::uint64_t>(value >> 63);
}
constexpr std::int64_t unzigzag(std::uint64_t value) {
  return static_cast<std::int64_t>(value >> 1) ^ -static_cast<std::int64_t>(value & 1);
}

// Fills a buffer of the caller with numbers and bytes. No heap.
class Encoder {
 public:
  explicit Encoder(std::span<std::byte> buffer) : buffer_(buffer) {}

  template <typename T>
  requires(std::is_arithmetic_v<T> || std::is_enum_v<T>) Encoder& put(T value) {
    return put_bytes(std::as_bytes(std::span(&value, 1)));
  }

  // Seven bits a byte, the lowest first.
  Encoder& put_varint(std::uint64_t value) {
    std::array<std::byte, kMaxVarintBytes> bytes;
    std::size_t count = 0;
    for (; value >= 0x80; value >>= 7) bytes[count++] = static_cast<std::byte>((value & 0x7F) | 0x80);
    bytes[count++] = static_cast<std::byte>(value);
    return put_bytes(std::span(bytes).first(count));
  }

  Encoder& put_bytes(std::span<const std::byte> bytes) {
    if (bytes.size() > buffer_.size() - size_) {
      good_ = false;
    } else if (!bytes.empty()) {
      std::memcpy(buffer_.data() + size_, bytes.data(), bytes.size());
      size_ += bytes.size();
    }
    return *this;
  }
  // Behind their count.
  Encoder& put_block(std::span<const std::byte> bytes) { return put_varint(bytes.size()).put_bytes(bytes); }

  bool good() const { return good_; }
  std::span<const std::byte> bytes() const { return buffer_.first(size_); }

 private:
  std::span<std::byte> buffer_;
  std::size_t size_ = 0;
  bool good_ = true;
};

// A number that put_varint wrote; false, and 0, if there is none.
inline bool read_varint(base::ByteReader& in, std::uint64_t& value) {
  value = 0;
  for (unsigned shift = 0; shift < 64; shift += 7) {
    const auto byte = in.read<std::uint8_t>();
    if (!in.ok()) return false;
    value |= std::uint64_t{byte & 0x7Fu} << shift;
    if (byte < 0x80) return true;
  }
  value = 0;
  return false;
}

}  // namespace stepwright::record

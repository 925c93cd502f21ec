#pragma once

// A part of the flash that holds one record: a header and data behind it. The header is programmed last and
// carries the sums of itself and of the data, so that a loss of power at any instant leaves either a whole
// record or none.
//
// Called by the main loop only. No heap.
//
//   FlashArea area(flash, offset, size);
//   area.begin() && area.append(first) && area.append(second) && area.finish(sequence, digest);
//   FlashRecord record;
//   if (area.read(record)) use(record.data);

#include <cstddef>
#include <cstdint>
#include <span>

#include "firmware/port/flash.h"
#include "firmware/storage/sha256.h"

namespace stepwright::storage {

struct FlashRecord {
  std::uint32_t sequence = 0;  // of two records the newer one has the higher number, modulo 2^32
  Digest digest{};             // what the writer gave
  std::span<const std::byte> data;
};

class FlashArea {
 public:
  // Requires whole pages.
  FlashArea(port::Flash& flash, std::uint32_t offset, std::uint32_t bytes)
      : flash_(flash), offset_(offset), bytes_(bytes) {}

  // The longest data that it holds.
  std::uint32_t capacity() const { return bytes_ - kDataAt; }

  // False if there is no whole record.
  bool read(FlashRecord& record) const;

  // Of the record, by its header alone; 0 without one.
  std::uint32_t sequence() const;

  // Ends the record that was there. Pages are erased when the data reaches them; what was programmed is read
  // back. Each of the four is false if the flash failed or the data is too long; nothing but begin() may
  // follow then.
  bool begin();
  bool append(std::span<const std::byte> data);
  bool finish(std::uint32_t sequence, const Digest& digest);
  bool clear() { return flash_.erase(offset_); }

  // The bytes appended so far.
  std::span<const std::byte> written() const { return flash_.content().subspan(offset_ + kDataAt, written_); }

 private:
  static constexpr std::uint32_t kDataAt = 64;
  bool program(std::uint32_t at, std::span<const std::byte> bytes);

  port::Flash& flash_;
  std::uint32_t offset_;
  std::uint32_t bytes_;
  std::uint32_t written_ = 0;
  std::uint32_t crc_ = 0;  // of what has been written
};

// Of two areas the one with the newer record: 0, 1 or -1 without any; `record` is it.
int newest_of(const FlashArea (&areas)[2], FlashRecord& record);

}  // namespace stepwright::storage

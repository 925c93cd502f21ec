#pragma once

// Retained values in two areas of the flash: the newer one holds, the other one is written. A record belongs
// to one program, by its digest; another program begins with its initial values.
//
// Writing is cut into pages, one a call of step(), so that the main loop comes round; never within a scan.
// Called by the main loop only. No heap: the values that are being written stand in memory of the caller.

#include <cstdint>
#include <span>

#include "firmware/storage/flash_layout.h"

namespace stepwright::storage {

class RetainStore {
 public:
  explicit RetainStore(port::Flash& flash);

  std::uint32_t capacity() const { return areas_[0].capacity(); }

  // The newest values of that program; empty if there are none.
  std::span<const std::byte> values_of(const Digest& program) const;

  // Begins to write; the values must stay until busy() is false. What was being written is given up.
  void write(const Digest& program, std::span<const std::byte> values);
  bool busy() const { return left_ > 0 || begun_; }
  // Writes at most one page.
  void step();

  // Forgets everything. False if the flash failed.
  bool clear();

 private:
  FlashArea areas_[2];
  std::uint32_t page_bytes_;
  Digest program_{};
  std::span<const std::byte> values_;
  std::uint32_t sequence_ = 0;
  int target_ = 0;
  std::size_t left_ = 0;
  bool begun_ = false;
};

}  // namespace stepwright::storage

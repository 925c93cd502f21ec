#pragma once

// The program of the controller in two slots of the flash. A transfer fills the slot that is not in use,
// piece by piece; its header, which comes last, makes it the newest one, that a reset loads.
//
// Called by the main loop only. No heap.

#include <cstdint>
#include <span>

#include "firmware/storage/flash_layout.h"

namespace stepwright::storage {

class ProgramStore {
 public:
  explicit ProgramStore(port::Flash& flash);

  // The slot of the newest whole container whose SHA-256 is right, or -1; slots of `except` (bit i = slot i)
  // are passed over.
  int newest(std::uint32_t except = 0) const;
  // Requires a slot that newest() gave.
  std::span<const std::byte> container(int slot) const;
  Digest digest(int slot) const;
  std::uint32_t capacity() const { return slots_[0].capacity(); }

  // A transfer into the slot that is not `in_use` (-1: none). False if the flash failed.
  bool begin(int in_use);
  bool append(std::span<const std::byte> piece) { return slots_[target_].append(piece); }
  std::span<const std::byte> written() const { return slots_[target_].written(); }
  int target() const { return target_; }
  // The container that was written becomes the newest. Requires its digest.
  bool finish(const Digest& digest);

 private:
  FlashArea slots_[2];
  int target_ = 0;
};

}  // namespace stepwright::storage

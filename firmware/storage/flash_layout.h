#pragma once

// Layout of the flash: two slots for programs, two areas for retained values. A value; the flash outlives it.

#include <cstdint>

#include "firmware/port/flash.h"
#include "firmware/storage/flash_area.h"

namespace stepwright::storage {

struct FlashLayout {
  explicit FlashLayout(port::Flash& flash) : flash_(flash) {}

  // Of sixteen parts each slot has seven, each retain area one. Requires sixteen pages at least.
  FlashArea slot(std::uint32_t which) const { return {flash_, which * 7 * part(), 7 * part()}; }
  FlashArea retain(std::uint32_t which) const { return {flash_, (14 + which) * part(), part()}; }

 private:
  std::uint32_t part() const {
    const auto pages = static_cast<std::uint32_t>(flash_.content().size()) / flash_.page_bytes();
    return pages / 16 * flash_.page_bytes();
  }
  port::Flash& flash_;
};

}  // namespace stepwright::storage

#pragma once

// Flash that is RAM: pages of 4 KiB that are erased to 0xFF and in which programming clears bits only. It
// keeps its content as long as the RAM does.

#include <cstring>

#include "firmware/port/flash.h"

namespace stepwright::boards {

class RamFlash final : public port::Flash {
 public:
  // Requires whole pages.
  explicit RamFlash(std::span<std::byte> memory) : memory_(memory) {}

  static constexpr std::uint32_t kPageBytes = 4096;

  std::uint32_t page_bytes() const override { return kPageBytes; }
  std::span<const std::byte> content() const override { return memory_; }

  bool erase(std::uint32_t offset) override {
    if (offset % kPageBytes != 0 || offset >= memory_.size()) return false;
    std::memset(memory_.data() + offset, 0xFF, kPageBytes);
    return true;
  }

  bool program(std::uint32_t offset, std::span<const std::byte> bytes) override {
    if (offset > memory_.size() || bytes.size() > memory_.size() - offset) return false;
    for (std::size_t i = 0; i < bytes.size(); ++i) {
      std::byte& cell = memory_[offset + i];
      if ((cell & bytes[i]) != bytes[i]) return false;
      cell &= bytes[i];
    }
    return true;
  }

 private:
  std::span<std::byte> memory_;
};

}  // namespace stepwright::boards

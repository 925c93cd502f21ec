#pragma once

// Directly represented variables (IEC 61131-3, 6.5.5) in the languages: %IX0.0, %QB3, %MW12; and places in
// structures (6.4.4.7): %X3.0, %B4.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/ground/naming/direct_address.h"

namespace stepwright::syntax {

using naming::Area;
using naming::DirectAddress;
using naming::kAreaLimit;

// Hierarchical addresses, %QW1.0.3 (6.5.5.2): which place of its area one means is decided when all are
// known. Until then `byte` is kHierarchical + the NameId of its text.
inline constexpr std::uint32_t kHierarchical = 0x4000'0000;

struct HierarchicalAddress {
  DirectAddress address;              // area and bits
  std::vector<std::uint32_t> levels;  // two or more, of a bit three or more
};

// Nothing if the text is no hierarchical address.
std::optional<HierarchicalAddress> parse_hierarchical(std::string_view text);

// Where a member of a structure lies in it, by bytes whatever its size is: %W2 begins in byte 2.
struct RelativeAddress {
  std::uint8_t bits = 8;  // 1, 8, 16, 32 or 64
  std::uint32_t byte = 0;
  std::uint8_t bit = 0;  // of `byte`; 0 unless bits = 1
};

// "%X3.0", "%B4", "%W2", "%D4", "%L8", in upper or lower case, below byte `limit`. Nothing if the text is
// none.
std::optional<RelativeAddress> parse_relative(std::string_view text, std::uint32_t limit);

// "%IX0.0"
std::string to_string(const DirectAddress& address);
// "%X3.0"
std::string to_string(const RelativeAddress& address);

}  // namespace stepwright::syntax

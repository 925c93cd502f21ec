#pragma once

// Directly represented variables (IEC 61131-3, 6.5.5) in the languages: %IX0.0, %QB3, %MW12.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/naming/direct_address.h"

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

// "%IX0.0"
std::string to_string(const DirectAddress& address);

}  // namespace stepwright::syntax

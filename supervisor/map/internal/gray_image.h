#pragma once

// The picture of a map: 0 is black, 255 white; the first row is the topmost. Readers bound the size by
// kMostCells before they take memory.

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "runtime/ground/result/result.h"

namespace stepwright::fleet::internal {

struct GrayImage {
  std::int32_t columns = 0;
  std::int32_t rows = 0;
  // Brightness from 0 (black) to 1 (white), negative where the picture says nothing (transparent).
  std::vector<float> brightness;
};

bool is_png(std::span<const std::uint8_t> bytes);
// `file` names the bytes in diagnostics. Both fail with F0104.
[[nodiscard]] result::Result<GrayImage> read_png(std::span<const std::uint8_t> bytes,
                                                 const std::string& file);
[[nodiscard]] result::Result<GrayImage> read_pgm(std::span<const std::uint8_t> bytes,
                                                 const std::string& file);

// Nothing if an image of this size can be a map; else what is wrong with it.
std::optional<std::string> wrong_size(std::uint64_t columns, std::uint64_t rows);

}  // namespace stepwright::fleet::internal

#pragma once

// Samples of one tag in ascending time as a compressed, checksummed block of bytes
// (hmi_web/doc/history_format.md): delta of delta of the times, and of the values what is shortest: deltas of
// whole or decimal numbers, deltas in a table of the different values, or XOR. Lossless, bit by bit.
//
//   std::vector<std::byte> bytes = encode_block(samples);
//   std::vector<Sample> back;
//   if (!decode_block(bytes, back)) ...            // damaged: nothing may be said about its samples
//
// Pure functions; any thread. Any bytes are safe to decode.

#include <cstddef>
#include <span>
#include <vector>

#include "hmi_web/historian/sample.h"

namespace stepwright::historian {

// A block that is full; what is encoded has at most kMostInBlock.
inline constexpr std::size_t kBlockSamples = 512;
inline constexpr std::size_t kMostInBlock = 65'535;

// Requires 1 to kMostInBlock samples in ascending time (equal times are allowed).
std::vector<std::byte> encode_block(std::span<const Sample> samples);

// Appends the block's samples; false, and `samples` as it was, if the bytes are no sound block.
[[nodiscard]] bool decode_block(std::span<const std::byte> bytes, std::vector<Sample>& samples);

}  // namespace stepwright::historian

#pragma once

// The ways to write the values of a block, of which the shortest is taken.
//
// Pure functions. A reader gives false for bits that no writer makes; `values` has the size to be read.

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "hmi_web/historian/internal/bits.h"

namespace stepwright::historian::internal {

enum class ValueCode : std::uint8_t {
  Scaled,      // decimal numbers: deltas of value * 10^exponent
  Dictionary,  // the different values in order, deltas of their indices
  Xor,         // every value XOR the one before
};
inline constexpr std::uint8_t kValueCodes = 3;

using Bits = std::vector<std::byte>;

// The least exponent with which every value is a whole number over 10^exponent, exactly; nullopt: none.
std::optional<unsigned> decimal_exponent(std::span<const double> values);
void write_scaled(std::span<const double> values, unsigned exponent, BitWriter& out);
bool read_scaled(BitReader& in, std::span<double> values);

// False if there are too many different values; `out` is unchanged then.
bool write_dictionary(std::span<const double> values, BitWriter& out);
bool read_dictionary(BitReader& in, std::span<double> values);

void write_xor(std::span<const double> values, BitWriter& out);
bool read_xor(BitReader& in, std::span<double> values);

}  // namespace stepwright::historian::internal

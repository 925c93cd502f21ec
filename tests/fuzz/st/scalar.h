#pragma once

// The elementary types of generated programs and what the generator, both writers and the comparison must
// know about them.

#include <cstdint>

namespace stepwright::st_fuzz {

enum class Scalar : std::uint8_t {
  Bool,
  Sint,
  Int,
  Dint,
  Lint,
  Usint,
  Uint,
  Udint,
  Ulint,
  Byte,
  Word,
  Dword,
  Lword,
  Real,
  Lreal,
  Time,
};
inline constexpr unsigned kScalars = 16;

const char* st_name(Scalar type);  // "INT"
const char* c_name(Scalar type);   // "int16_t"
unsigned bits_of(Scalar type);     // of a BOOL 8, as it lies in memory

bool is_integer(Scalar type);
bool is_signed(Scalar type);  // integers with a sign, TIME
bool is_bits(Scalar type);    // BYTE .. LWORD
bool is_real(Scalar type);

// Whether a value of `from` is converted to `to` without being told to (IEC 61131-3, 6.6.1.6). Never for
// equal types.
bool widens(Scalar from, Scalar to);

// The value in 64 bits, extended as the type's sign says. Of reals their bits, unchanged.
std::uint64_t extended(Scalar type, std::uint64_t bits);

}  // namespace stepwright::st_fuzz

#include "tests/fuzz/st/scalar.h"

namespace stepwright::st_fuzz {

namespace {

struct Row {
  const char* st;
  const char* c;
  unsigned bits;
};

constexpr Row kRows[kScalars] = {
    {"BOOL", "uint8_t", 8},    {"SINT", "int8_t", 8},   {"INT", "int16_t", 16},   {"DINT", "int32_t", 32},
    {"LINT", "int64_t", 64},   {"USINT", "uint8_t", 8}, {"UINT", "uint16_t", 16}, {"UDINT", "uint32_t", 32},
    {"ULINT", "uint64_t", 64}, {"BYTE", "uint8_t", 8},  {"WORD", "uint16_t", 16}, {"DWORD", "uint32_t", 32},
    {"LWORD", "uint64_t", 64}, {"REAL", "float", 32},   {"LREAL", "double", 64},  {"TIME", "int64_t", 64},
};

const Row& row(Scalar type) {
  return kRows[static_cast<unsigned>(type)];
}

}  // namespace

const char* st_name(Scalar type) {
  return row(type).st;
}
const char* c_name(Scalar type) {
  return row(type).c;
}
unsigned bits_of(Scalar type) {
  return row(type).bits;
}

bool is_integer(Scalar type) {
  return type >= Scalar::Sint && type <= Scalar::Ulint;
}
bool is_signed(Scalar type) {
  return (type >= Scalar::Sint && type <= Scalar::Lint) || type == Scalar::Time;
}
bool is_bits(Scalar type) {
  return type >= Scalar::Byte && type <= Scalar::Lword;
}
bool is_real(Scalar type) {
  return type == Scalar::Real || type == Scalar::Lreal;
}

bool widens(Scalar from, Scalar to) {
  if (from == to) return false;
  if (is_real(to)) {
    if (from == Scalar::Real) return true;
    return is_integer(from) && bits_of(from) * 2 <= bits_of(to);
  }
  const bool wider = bits_of(from) < bits_of(to);
  if (is_bits(from) && is_bits(to)) return wider;
  if (!is_integer(from) || !is_integer(to)) return false;
  return wider && (is_signed(to) || !is_signed(from));
}

std::uint64_t extended(Scalar type, std::uint64_t bits) {
  const unsigned width = bits_of(type);
  if (width == 64 || is_real(type)) return bits;
  const std::uint64_t low = bits & ((std::uint64_t{1} << width) - 1);
  const bool negative = is_signed(type) && ((low >> (width - 1)) & 1) != 0;
  return negative ? low | ~((std::uint64_t{1} << width) - 1) : low;
}

}  // namespace stepwright::st_fuzz

#include "tests/unit/runtime/native/edge_values.h"

#include <bit>
#include <cstring>
#include <limits>
#include <string>

namespace stepwright::native {

using namespace edge_layout;

namespace {

using Values = std::vector<std::uint64_t>;

Values integers(unsigned bits) {
  Values out;
  const std::uint64_t mask = bits == 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << bits) - 1;
  for (const std::int64_t each : {0,  1,   -1,  2,   -2,   7,    8,     16,    31,    32,    33,     63,
                                  64, 127, 128, 255, -128, -129, 32767, 32768, 65535, 65536, -32768, -32769})
    out.push_back(static_cast<std::uint64_t>(each) & mask);
  for (const unsigned top : {31u, 32u, 53u, 63u}) {
    if (top >= bits) continue;
    const std::uint64_t power = std::uint64_t{1} << top;
    for (const std::uint64_t each : {power - 1, power, power + 1}) out.push_back(each & mask);
  }
  return out;
}

template <typename T, typename Bits>
Values reals(const std::vector<Bits>& more) {
  using Limits = std::numeric_limits<T>;
  Values out;
  const auto add = [&](T value) {
    out.push_back(std::bit_cast<Bits>(value));
    out.push_back(std::bit_cast<Bits>(-value));
  };
  for (const T each : {T{0},
                       T{1},
                       T(0.5),
                       T(1.5),
                       T(2.5),
                       T(0.49999997),
                       T(127.5),
                       T(128.5),
                       T(255.5),
                       T(32767.5),
                       T(65535.5),
                       T(2147483648.0),
                       T(4294967296.0),
                       T(9223372036854775808.0),
                       T(18446744073709551616.0),
                       Limits::infinity(),
                       Limits::quiet_NaN(),
                       Limits::min(),
                       Limits::denorm_min(),
                       Limits::max(),
                       Limits::epsilon()})
    add(each);
  for (const Bits each : more) out.push_back(each);
  return out;
}

Values references() {
  Values out;
  for (const std::uint32_t each : {0u, 1u, kInputs + 24, kOutputs + 40, kInstances + 64, kZeros,
                                   kMemoryBytes - 8, kMemoryBytes - 4, kMemoryBytes - 1, kMemoryBytes,
                                   kMemoryBytes + 1, 0x7FFFFFFFu, bytecode::kNullRef - 1, bytecode::kNullRef})
    out.push_back(each);
  return out;
}

template <typename Character>
void put_string(std::vector<std::byte>& memory, std::size_t at, std::uint16_t capacity, std::uint16_t length,
                const std::string& text) {
  const std::uint16_t header[] = {capacity, length};
  std::memcpy(&memory[at], header, sizeof header);
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto each = static_cast<Character>(static_cast<unsigned char>(text[i]));
    std::memcpy(&memory[at + sizeof header + i * sizeof each], &each, sizeof each);
  }
}

// Of each kind one string, 20 characters of room for the texts.
template <typename Character>
Values put_strings(std::vector<std::byte>& memory, std::uint32_t at) {
  struct Row {
    std::uint16_t capacity;
    std::uint16_t length;
    const char* text;
  };
  constexpr std::uint16_t kRoom = 16;
  const Row rows[] = {{8, 0, ""},    {0, 0, ""},      {4, 4, "abcd"},   {8, 3, "bcb"},
                      {16, 2, "-7"}, {3, 900, "xyz"}, {60000, 2, "far"}};
  Values out;
  for (const Row& each : rows) {
    put_string<Character>(memory, at, each.capacity, each.length, each.text);
    out.push_back(at);
    at += static_cast<std::uint32_t>(4 + kRoom * sizeof(Character));
  }
  // Overlaps the third in part; behind the memory; its header only within; nowhere.
  out.push_back(out[2] + 2);
  for (const std::uint32_t each : {kMemoryBytes - 4, kMemoryBytes - 3, kMemoryBytes, bytecode::kNullRef})
    out.push_back(each);
  return out;
}

constexpr std::uint32_t kWideStrings = kStrings;
constexpr std::uint32_t kNarrowStrings = kStrings + 7 * (4 + 32);
static_assert(kNarrowStrings + 7 * (4 + 16) == kStrings + kStringsBytes);

}  // namespace

const Values& edge_values(char letter) {
  static const Values kBools = {0, 1};
  static const Values kI32 = integers(32);
  static const Values kI64 = integers(64);
  static const Values kF32 =
      reals<float, std::uint32_t>({0x7F800001u, 0xFFC12345u, 0x7FFFFFFFu, 0x00400000u});
  static const Values kF64 = reals<double, std::uint64_t>(
      {0x7FF0000000000001u, 0xFFF8000012345678u, 0x41DFFFFFFFC00000u, 0x41E0000000100000u,
       0x47EFFFFFF0000000u, 0x47EFFFFFEFFFFFFFu, 0x36A0000000000000u});
  static const Values kRefs = references();
  switch (letter) {
    case 'b':
      return kBools;
    case 'i':
      return kI32;
    case 'l':
      return kI64;
    case 'f':
      return kF32;
    case 'd':
      return kF64;
    default:
      return kRefs;
  }
}

Values few_edge_values(char letter) {
  const Values& all = edge_values(letter);
  Values out;
  const std::size_t step = all.size() > 20 ? 3 : 1;
  for (std::size_t i = 0; i < all.size(); i += step) out.push_back(all[i]);
  return out;
}

const Values& string_references(bool wide) {
  static std::vector<std::byte> scratch(kMemoryBytes * 2);
  static const Values kWide = put_strings<std::uint16_t>(scratch, kWideStrings);
  static const Values kNarrow = put_strings<std::uint8_t>(scratch, kNarrowStrings);
  return wide ? kWide : kNarrow;
}

const Values& string_positions() {
  static const Values kPositions = {0, 1, 2, 3, 4, 5, 9, 0xFFFFFFFF, 0x80000000, 0x7FFFFFFF};
  return kPositions;
}

std::vector<std::byte> edge_memory() {
  std::vector<std::byte> memory(kMemoryBytes * 2);
  for (std::size_t i = kOutputs; i < kInstances; ++i) memory[i] = static_cast<std::byte>(i * 37);
  put_strings<std::uint16_t>(memory, kWideStrings);
  put_strings<std::uint8_t>(memory, kNarrowStrings);
  const double negative_zero = -0.0;
  std::memcpy(&memory[kZeros + 8], &negative_zero, sizeof negative_zero);
  memory.resize(kMemoryBytes);
  return memory;
}

namespace {

// Whether this operand of a string operation is a WSTRING.
bool is_wide(bytecode::StringOpId operation, std::size_t operand) {
  if (operation == bytecode::StringOpId::StringToWstring) return operand == 0;
  if (operation == bytecode::StringOpId::WstringToString) return operand == 1;
  return std::string(bytecode::kStringOps[static_cast<std::uint8_t>(operation)].name).ends_with('W');
}

}  // namespace

std::vector<Values> operand_values(const Shape& shape) {
  const bool strings = shape.opcode == bytecode::Opcode::StringOp;
  std::vector<Values> out;
  for (std::size_t i = 0; i < shape.pops.size(); ++i) {
    const char letter = shape.pops[i];
    if (strings && letter == 'r') {
      out.push_back(string_references(is_wide(static_cast<bytecode::StringOpId>(shape.operands[0]), i)));
    } else if (strings && letter == 'i') {
      out.push_back(string_positions());
    } else {
      out.push_back(edge_values(letter));
    }
  }
  return out;
}

}  // namespace stepwright::native

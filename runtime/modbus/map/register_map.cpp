#include "runtime/modbus/map/register_map.h"

#include <algorithm>
#include <cassert>
#include <cstring>

#include "runtime/modbus/map/image_parts.h"
#include "runtime/modbus/pdu/data_model.h"
#include "runtime/modbus/pdu/wire.h"

namespace stepwright::modbus::map {
namespace {

using pdu::Exception;

// Of one request: 125 registers of the last bytes of LWORDs, or 2000 BOOLs.
constexpr std::size_t kMostImageBytes = 2'048;

// Addresses of one segment: the first one, counted from the segment's beginning, and how many.
struct Stretch {
  const Segment* segment = nullptr;
  std::uint32_t at = 0;
  std::uint32_t count = 0;
  std::uint32_t done = 0;  // addresses of the request before these
};

// Calls visit(Stretch) -> Exception for each segment that the addresses lie in; IllegalDataAddress for a gap.
template <typename Visit>
Exception each_stretch(const RegisterMap::Segments& segments, std::uint32_t address, std::uint32_t count,
                       const Visit& visit) {
  auto segment = std::upper_bound(segments.begin(), segments.end(), address,
                                  [](std::uint32_t at, const Segment& each) { return at < each.first; });
  if (segment == segments.begin()) return Exception::IllegalDataAddress;
  --segment;
  for (std::uint32_t done = 0; done < count; ++segment) {
    if (segment == segments.end()) return Exception::IllegalDataAddress;
    const std::uint32_t at = address + done;
    if (at < segment->first || at >= segment->end()) return Exception::IllegalDataAddress;
    const std::uint32_t here = std::min(count - done, segment->end() - at);
    const Exception exception = visit(Stretch{&*segment, at - segment->first, here, done});
    if (exception != Exception::None) return exception;
    done += here;
  }
  return Exception::None;
}

bool get_bit(std::span<const std::byte> packed, std::size_t at) {
  return (std::to_integer<unsigned>(packed[at / 8]) >> at % 8 & 1u) != 0;
}

void set_bit(std::span<std::byte> packed, std::size_t at) {
  packed[at / 8] |= static_cast<std::byte>(1u << at % 8);
}

// Where the two bytes of a register of a wide value stand within it: the low one; the high one is the next.
std::uint32_t low_byte_of(const Segment& segment, std::uint32_t at) {
  const std::uint32_t registers = registers_of(segment.kind);
  const std::uint32_t value = at / registers;
  const std::uint32_t part = at % registers;
  const std::uint32_t word = segment.word_order == Order::HighFirst ? registers - 1 - part : part;
  return value * registers * 2 + word * 2;
}

// The image's bytes of a stretch, and where they begin.
struct Loaded {
  std::array<std::byte, kMostImageBytes> bytes;
  std::uint32_t begin = 0;  // counted from the segment's address

  bool load(const host::SnapshotView& view, const Segment& segment, std::uint32_t first, std::uint32_t end) {
    begin = first;
    assert(end - first <= bytes.size());
    return view.load(segment.address + first, std::span(bytes).first(end - first));
  }
  std::byte at(std::uint32_t byte) const { return bytes[byte - begin]; }
};

Exception read_bit_stretch(const host::SnapshotView& view, const Stretch& stretch,
                           std::span<std::byte> packed) {
  const Segment& segment = *stretch.segment;
  if (segment.kind == Kind::Zero) return Exception::None;
  Loaded image;
  if (segment.kind == Kind::Bools) {
    if (!image.load(view, segment, stretch.at, stretch.at + stretch.count)) return Exception::DeviceFailure;
    for (std::uint32_t i = 0; i < stretch.count; ++i)
      if (image.at(stretch.at + i) != std::byte{0}) set_bit(packed, stretch.done + i);
    return Exception::None;
  }
  const std::uint32_t first = segment.bit + stretch.at;
  if (!image.load(view, segment, first / 8, (first + stretch.count + 7) / 8)) return Exception::DeviceFailure;
  for (std::uint32_t i = 0; i < stretch.count; ++i) {
    const std::uint32_t bit = first + i;
    if ((std::to_integer<unsigned>(image.at(bit / 8)) >> bit % 8 & 1u) != 0)
      set_bit(packed, stretch.done + i);
  }
  return Exception::None;
}

std::uint16_t widened(const Segment& segment, std::byte value) {
  if (segment.is_signed)
    return static_cast<std::uint16_t>(static_cast<std::int8_t>(std::to_integer<std::uint8_t>(value)));
  return std::to_integer<std::uint16_t>(value);
}

void put_register(const Segment& segment, std::span<std::byte> words, std::size_t at, std::byte high,
                  std::byte low) {
  const bool standard = segment.byte_order == Order::HighFirst;
  words[2 * at] = standard ? high : low;
  words[2 * at + 1] = standard ? low : high;
}

// BOOLs and bits as registers.
Exception read_truths(const host::SnapshotView& view, const Stretch& stretch, std::span<std::byte> words) {
  std::array<std::byte, 16> packed{};
  const Stretch alone{stretch.segment, stretch.at, stretch.count, 0};
  const Exception exception = read_bit_stretch(view, alone, packed);
  for (std::uint32_t i = 0; i < stretch.count; ++i)
    put_register(*stretch.segment, words, stretch.done + i, std::byte{0}, std::byte{get_bit(packed, i)});
  return exception;
}

Exception read_register_stretch(const host::SnapshotView& view, const Stretch& stretch,
                                std::span<std::byte> words) {
  const Segment& segment = *stretch.segment;
  if (segment.kind == Kind::Zero) {
    std::memset(&words[stretch.done * 2], 0, stretch.count * 2);
    return Exception::None;
  }
  if (segment.kind == Kind::Bits || segment.kind == Kind::Bools) return read_truths(view, stretch, words);
  Loaded image;
  const std::uint32_t bytes = bytes_of(segment.kind);
  const std::uint32_t registers = registers_of(segment.kind);
  const std::uint32_t first = stretch.at / registers * bytes;
  const std::uint32_t end = ((stretch.at + stretch.count - 1) / registers + 1) * bytes;
  if (!image.load(view, segment, first, end)) return Exception::DeviceFailure;
  for (std::uint32_t i = 0; i < stretch.count; ++i) {
    if (segment.kind == Kind::Byte) {
      const std::uint16_t value = widened(segment, image.at(stretch.at + i));
      put_register(segment, words, stretch.done + i, static_cast<std::byte>(value >> 8),
                   static_cast<std::byte>(value & 0xFF));
      continue;
    }
    const std::uint32_t low = low_byte_of(segment, stretch.at + i);
    put_register(segment, words, stretch.done + i, image.at(low + 1), image.at(low));
  }
  return Exception::None;
}

void write_truth(const Segment& segment, std::uint32_t at, bool value, Parts& parts) {
  if (segment.kind == Kind::Bools) return add_byte(parts, segment.address + at, 0xFF, value ? 1 : 0);
  const std::uint32_t bit = segment.bit + at;
  const auto mask = static_cast<std::uint8_t>(1u << bit % 8);
  add_byte(parts, segment.address + bit / 8, mask, value ? mask : std::uint8_t{0});
}

bool fits(const Segment& segment, std::uint16_t value) {
  if (!segment.is_signed) return value <= 0xFF;
  const auto number = static_cast<std::int16_t>(value);
  return number >= -128 && number <= 127;
}

// The bits of `mask` of one register.
Exception write_register(const Segment& segment, std::uint32_t at, std::uint16_t mask, std::uint16_t value,
                         Parts& parts) {
  if (segment.byte_order == Order::LowFirst) {
    mask = static_cast<std::uint16_t>(mask << 8 | mask >> 8);
    value = static_cast<std::uint16_t>(value << 8 | value >> 8);
  }
  if (segment.kind == Kind::Bits || segment.kind == Kind::Bools) {
    if (mask != 0) write_truth(segment, at, (value & mask) != 0, parts);
    return Exception::None;
  }
  const auto low_mask = static_cast<std::uint8_t>(mask & 0xFF);
  const auto low_value = static_cast<std::uint8_t>(value & 0xFF);
  if (segment.kind == Kind::Byte) {
    if (mask == 0xFFFF && !fits(segment, value)) return Exception::IllegalDataValue;
    add_byte(parts, segment.address + at, low_mask, low_value);
    return Exception::None;
  }
  const std::uint32_t low = segment.address + low_byte_of(segment, at);
  add_byte(parts, low, low_mask, low_value);
  add_byte(parts, low + 1, static_cast<std::uint8_t>(mask >> 8), static_cast<std::uint8_t>(value >> 8));
  return Exception::None;
}

bool writable(const Segment& segment) {
  return segment.writable && segment.kind != Kind::Zero;
}

}  // namespace

Exception RegisterMap::read_bits(const host::SnapshotView& view, Table table, std::uint16_t address,
                                 std::uint16_t count, std::span<std::byte> packed) const {
  std::memset(packed.data(), 0, packed.size());
  return each_stretch(segments(table), address, count,
                      [&](const Stretch& stretch) { return read_bit_stretch(view, stretch, packed); });
}

Exception RegisterMap::read_registers(const host::SnapshotView& view, Table table, std::uint16_t address,
                                      std::uint16_t count, std::span<std::byte> words) const {
  return each_stretch(segments(table), address, count,
                      [&](const Stretch& stretch) { return read_register_stretch(view, stretch, words); });
}

Exception RegisterMap::write_coils(std::uint16_t address, std::uint16_t count,
                                   std::span<const std::byte> packed, Parts& parts) const {
  return each_stretch(segments(Table::Coils), address, count, [&](const Stretch& stretch) {
    if (!writable(*stretch.segment)) return Exception::IllegalDataAddress;
    for (std::uint32_t i = 0; i < stretch.count; ++i)
      write_truth(*stretch.segment, stretch.at + i, get_bit(packed, stretch.done + i), parts);
    return Exception::None;
  });
}

Exception RegisterMap::write_registers(std::uint16_t address, std::uint16_t count,
                                       std::span<const std::byte> words, Parts& parts) const {
  return each_stretch(segments(Table::HoldingRegisters), address, count, [&](const Stretch& stretch) {
    if (!writable(*stretch.segment)) return Exception::IllegalDataAddress;
    for (std::uint32_t i = 0; i < stretch.count; ++i) {
      const std::uint16_t value = pdu::get16(words, 2 * (stretch.done + i));
      const Exception exception = write_register(*stretch.segment, stretch.at + i, 0xFFFF, value, parts);
      if (exception != Exception::None) return exception;
    }
    return Exception::None;
  });
}

Exception RegisterMap::mask_register(std::uint16_t address, std::uint16_t and_mask, std::uint16_t or_mask,
                                     Parts& parts) const {
  return each_stretch(segments(Table::HoldingRegisters), address, 1, [&](const Stretch& stretch) {
    if (!writable(*stretch.segment)) return Exception::IllegalDataAddress;
    const auto mask = static_cast<std::uint16_t>(~and_mask);
    // What a register has beyond its value reads 0 and stays 0: only the value's own bits can change.
    const Kind kind = stretch.segment->kind;
    const bool truth = kind == Kind::Bits || kind == Kind::Bools;
    auto own = static_cast<std::uint16_t>(truth ? 1 : kind == Kind::Byte ? 0xFF : 0xFFFF);
    if (stretch.segment->byte_order == Order::LowFirst) own = static_cast<std::uint16_t>(own << 8 | own >> 8);
    return write_register(*stretch.segment, stretch.at, mask & own, or_mask & own, parts);
  });
}

bool RegisterMap::covers(Table table, std::uint16_t address, std::uint16_t count) const {
  return each_stretch(segments(table), address, count, [](const Stretch&) { return Exception::None; }) ==
         Exception::None;
}

}  // namespace stepwright::modbus::map

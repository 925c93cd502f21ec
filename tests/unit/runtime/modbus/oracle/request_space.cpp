#include "tests/unit/runtime/modbus/oracle/request_space.h"

#include <algorithm>
#include <initializer_list>
#include <string>
#include <unordered_set>

namespace stepwright::modbus::oracle {

namespace {

constexpr unsigned kMostReadBits = 2000, kMostReadRegisters = 125;    // Application Protocol V1.1b3, 6.1, 6.3
constexpr unsigned kMostWriteBits = 1968, kMostWriteRegisters = 123;  // 6.11, 6.12
constexpr unsigned kMostWriteInReadWrite = 121;                       // 6.17
constexpr std::size_t kMostPdu = 253;

void put16(Bytes& out, unsigned value) {
  out.push_back(static_cast<std::uint8_t>(value >> 8));
  out.push_back(static_cast<std::uint8_t>(value));
}

Bytes pdu_of(unsigned function, std::initializer_list<unsigned> words) {
  Bytes out{static_cast<std::uint8_t>(function)};
  for (const unsigned each : words) put16(out, each);
  return out;
}

std::vector<unsigned> addresses(std::size_t size) {
  const auto end = static_cast<unsigned>(size);
  return {0, 1, end / 2, end - 1, end & 0xFFFF, 65535};
}

std::vector<unsigned> counts(unsigned most) {
  return {0, 1, most, most + 1, 65535};
}

// The requests of one table size, with no request twice.
class Space {
 public:
  explicit Space(Sizes sizes) : sizes_(sizes) {}

  std::vector<Bytes> take() { return std::move(requests_); }

  void add_function(unsigned function) {
    add(Bytes{static_cast<std::uint8_t>(function)});
    switch (function) {
      case 1:
      case 2:
        return add_reads(function, sizes_.bits, kMostReadBits);
      case 3:
      case 4:
        return add_reads(function, sizes_.registers, kMostReadRegisters);
      case 5:
        return add_single(function, sizes_.bits, {0x0000, 0xFF00, 0x0001, 0x00FF, 0xFF01, 0xFFFF});
      case 6:
        return add_single(function, sizes_.registers, {0x0000, 0x0001, 0x7FFF, 0x8000, 0xFFFF});
      case 15:
        return add_writes(function, sizes_.bits, kMostWriteBits);
      case 16:
        return add_writes(function, sizes_.registers, kMostWriteRegisters);
      case 22:
        return add_masks();
      case 23:
        return add_read_writes();
      case 43:
        return add_identifications();
      default:
        return add_reads(function, sizes_.registers, kMostReadRegisters);
    }
  }

 private:
  void add(Bytes request) {
    if (!request.empty() && seen_.insert(hex(request)).second) requests_.push_back(std::move(request));
  }

  // The request whole, cut off and too long.
  void add_lengths(const Bytes& whole) {
    add(whole);
    for (const std::size_t kept : {std::size_t{2}, std::size_t{3}, std::size_t{5}, whole.size() - 1}) {
      if (kept < whole.size()) add(Bytes(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(kept)));
    }
    for (const std::size_t length : {whole.size() + 1, kMostPdu, kMostPdu + 7}) {
      if (length <= whole.size()) continue;
      Bytes longer = whole;
      longer.resize(length, 0x5A);
      add(longer);
    }
  }

  void add_reads(unsigned function, std::size_t size, unsigned most) {
    for (const unsigned address : addresses(size)) {
      for (const unsigned count : counts(most)) add_lengths(pdu_of(function, {address, count}));
    }
  }

  void add_single(unsigned function, std::size_t size, std::initializer_list<unsigned> values) {
    for (const unsigned address : addresses(size)) {
      for (const unsigned value : values) add_lengths(pdu_of(function, {address, value}));
    }
  }

  // `data` bytes behind a byte count that may say something else.
  static Bytes with_data(Bytes head, unsigned byte_count, std::size_t data) {
    head.push_back(static_cast<std::uint8_t>(byte_count));
    for (std::size_t i = 0; i < data; ++i) head.push_back(static_cast<std::uint8_t>(i * 37 + 11));
    return head;
  }

  void add_bodies(const Bytes& head, std::size_t needed) {
    const std::size_t room = kMostPdu - head.size() - 1;
    const std::size_t fits = std::min(needed, room);
    add_lengths(with_data(head, static_cast<unsigned>(fits), fits));
    // The byte count is wrong, and so are the data or not.
    for (const std::size_t other :
         {std::size_t{0}, fits - std::min<std::size_t>(fits, 1), fits + 1, std::size_t{255}}) {
      add(with_data(head, static_cast<unsigned>(other), fits));
      add(with_data(head, static_cast<unsigned>(other), std::min(other, room)));
    }
  }

  void add_writes(unsigned function, std::size_t size, unsigned most) {
    for (const unsigned address : addresses(size)) {
      for (const unsigned count : counts(most)) {
        add_bodies(pdu_of(function, {address, count}), function == 15 ? (count + 7) / 8 : count * 2);
      }
    }
  }

  void add_masks() {
    for (const unsigned address : addresses(sizes_.registers)) {
      for (const unsigned and_mask : {0x0000u, 0xFFFFu, 0x0F0Fu}) {
        for (const unsigned or_mask : {0x0000u, 0xFFFFu, 0x3355u})
          add_lengths(pdu_of(22, {address, and_mask, or_mask}));
      }
    }
  }

  void add_read_writes() {
    for (const unsigned read_at : addresses(sizes_.registers)) {
      for (const unsigned read : counts(kMostReadRegisters)) {
        for (const unsigned write_at : addresses(sizes_.registers)) {
          for (const unsigned write : counts(kMostWriteInReadWrite)) {
            add_bodies(pdu_of(23, {read_at, read, write_at, write}), write * 2);
          }
        }
      }
    }
  }

  void add_identifications() {
    for (const unsigned mei : {0x0Eu, 0x0Du, 0x00u, 0xFFu}) {
      for (const unsigned code : {0u, 1u, 2u, 3u, 4u, 5u, 255u}) {
        for (const unsigned object : {0u, 1u, 2u, 3u, 6u, 7u, 0x7Fu, 0x80u, 255u}) {
          add_lengths({43, static_cast<std::uint8_t>(mei), static_cast<std::uint8_t>(code),
                       static_cast<std::uint8_t>(object)});
        }
      }
    }
  }

  Sizes sizes_;
  std::unordered_set<std::string> seen_;  // in hex
  std::vector<Bytes> requests_;
};

}  // namespace

std::vector<Bytes> request_space(Sizes sizes, bool only_known) {
  Space space(sizes);
  for (unsigned function = 0; function < 256; ++function) {
    const bool known = (function >= 1 && function <= 6) || function == 15 || function == 16 ||
                       function == 22 || function == 23 || function == 43;
    if (known || !only_known) space.add_function(function);
  }
  return space.take();
}

}  // namespace stepwright::modbus::oracle

#pragma once

// A string in memory while one operation works on it: header and capacity checked, length within the
// capacity. `Char` is std::uint8_t (STRING) or std::uint16_t (WSTRING); characters lie at any alignment.

#include <cstddef>
#include <cstdint>
#include <span>

#include "runtime/operations/reference.h"
#include "runtime/operations/slot.h"

namespace stepwright::operations {

template <typename Char>
class StringText {
 public:
  // Sets `text`, or says why there is no string at `ref`.
  static bytecode::TrapCode open(std::span<std::byte> memory, Slot ref, StringText& text) {
    if (!within(ref, bytecode::kStringHeaderBytes, memory.size())) return reference_fault(ref);
    text.header_ = memory.data() + ref;
    text.capacity_ = read_as<std::uint16_t>(text.header_);
    text.length_ = read_as<std::uint16_t>(text.header_ + 2);
    if (text.length_ > text.capacity_) text.length_ = text.capacity_;
    return within(ref, text.bytes(), memory.size()) ? bytecode::TrapCode::None
                                                    : bytecode::TrapCode::BadReference;
  }

  std::uint32_t capacity() const { return capacity_; }
  std::uint32_t length() const { return length_; }

  // Position from 0, below the capacity.
  Char at(std::uint32_t index) const { return read_as<Char>(character(index)); }
  void put(std::uint32_t index, Char value) { write_as(character(index), value); }

  // Copies characters to `to` as far as they fit the capacity. Source and target may overlap.
  void copy(std::uint32_t to, const StringText& source, std::uint32_t from, std::uint32_t count) {
    // A source without characters may be no string at all.
    if (to >= capacity_ || count == 0) return;
    const std::uint32_t fitting = count < capacity_ - to ? count : capacity_ - to;
    std::memmove(character(to), source.character(from), std::size_t{fitting} * sizeof(Char));
  }

  // Cut to the capacity.
  void set_length(std::uint32_t length) {
    write_as(header_ + 2, static_cast<std::uint16_t>(length < capacity_ ? length : capacity_));
  }

  template <typename Other>
  bool is(const StringText<Other>& other) const {
    return sizeof(Char) == sizeof(Other) && header_ == other.header();
  }
  // The same string, or no byte in common.
  template <typename Other>
  bool is_or_is_apart_from(const StringText<Other>& other) const {
    return is(other) || header_ + bytes() <= other.header() || other.header() + other.bytes() <= header_;
  }

  const std::byte* header() const { return header_; }
  std::size_t bytes() const { return bytecode::kStringHeaderBytes + std::size_t{capacity_} * sizeof(Char); }

 private:
  std::byte* character(std::uint32_t index) const {
    return header_ + bytecode::kStringHeaderBytes + std::size_t{index} * sizeof(Char);
  }

  std::byte* header_ = nullptr;
  std::uint32_t capacity_ = 0;
  std::uint32_t length_ = 0;
};

}  // namespace stepwright::operations

#include "runtime/record/byte_ring.h"

#include <algorithm>
#include <cstring>

namespace stepwright::record {

std::size_t ByteRing::room() const {
  const std::uint64_t used =
      pushed_.load(std::memory_order_relaxed) - popped_.load(std::memory_order_acquire);
  const std::size_t left = bytes_.size() - static_cast<std::size_t>(used);
  return left < sizeof(Length) ? 0 : left - sizeof(Length);
}

bool ByteRing::push(std::initializer_list<std::span<const std::byte>> parts) {
  std::size_t size = 0;
  for (const auto part : parts) size += part.size();
  if (size > room()) return false;
  std::uint64_t at = pushed_.load(std::memory_order_relaxed);
  const auto length = static_cast<Length>(size);
  copy_in(at, std::as_bytes(std::span(&length, 1)));
  at += sizeof length;
  for (const auto part : parts) {
    copy_in(at, part);
    at += part.size();
  }
  pushed_.store(at, std::memory_order_release);
  return true;
}

bool ByteRing::pop(std::vector<std::byte>& record) {
  const std::uint64_t at = popped_.load(std::memory_order_relaxed);
  if (at == pushed_.load(std::memory_order_acquire)) return false;
  Length length = 0;
  copy_out(at, std::as_writable_bytes(std::span(&length, 1)));
  record.resize(length);
  copy_out(at + sizeof length, record);
  popped_.store(at + sizeof length + length, std::memory_order_release);
  return true;
}

void ByteRing::copy_in(std::uint64_t at, std::span<const std::byte> from) {
  const std::size_t place = static_cast<std::size_t>(at % bytes_.size());
  const std::size_t first = std::min(from.size(), bytes_.size() - place);
  if (first > 0) std::memcpy(bytes_.data() + place, from.data(), first);
  if (from.size() > first) std::memcpy(bytes_.data(), from.data() + first, from.size() - first);
}

void ByteRing::copy_out(std::uint64_t at, std::span<std::byte> to) const {
  const std::size_t place = static_cast<std::size_t>(at % bytes_.size());
  const std::size_t first = std::min(to.size(), bytes_.size() - place);
  if (first > 0) std::memcpy(to.data(), bytes_.data() + place, first);
  if (to.size() > first) std::memcpy(to.data() + first, bytes_.data(), to.size() - first);
}

}  // namespace stepwright::record

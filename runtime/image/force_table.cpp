#include "runtime/image/force_table.h"

#include <cstring>

#include "runtime/image/process_image.h"

namespace stepwright::image {

bool ForceTable::set(const Force& force, std::size_t image_size) {
  const bool bit_force = force.bit != kWholeBytes;
  const bool size_ok =
      force.size == 1 || (!bit_force && (force.size == 2 || force.size == 4 || force.size == 8));
  if (!size_ok || (bit_force && force.bit > 7)) return false;
  if (force.address > image_size || force.size > image_size - force.address) return false;
  for (std::size_t i = 0; i < count_; ++i) {
    if (forces_[i].address == force.address && forces_[i].bit == force.bit) {
      forces_[i] = force;
      return true;
    }
  }
  if (count_ == kCapacity) return false;
  forces_[count_++] = force;
  return true;
}

bool ForceTable::clear(std::uint32_t address, std::uint8_t bit) {
  for (std::size_t i = 0; i < count_; ++i) {
    if (forces_[i].address != address || forces_[i].bit != bit) continue;
    for (std::size_t j = i + 1; j < count_; ++j) forces_[j - 1] = forces_[j];
    --count_;
    return true;
  }
  return false;
}

std::int64_t ForceTable::next_end_ns() const {
  std::int64_t next_ns = kNoEnd;
  for (const Force& force : forces()) next_ns = force.end_ns < next_ns ? force.end_ns : next_ns;
  return next_ns;
}

bool ForceTable::take_ended(std::int64_t now_ns, Force& ended) {
  for (const Force& force : forces()) {
    if (force.end_ns == kNoEnd || force.end_ns > now_ns) continue;
    ended = force;
    return clear(ended.address, ended.bit);
  }
  return false;
}

void ForceTable::apply(std::span<std::byte> image) const {
  for (const Force& force : forces()) {
    if (force.bit == kWholeBytes) {
      std::memcpy(image.data() + force.address, &force.value, force.size);
    } else {
      set_bit(image, force.address, force.bit, force.value != 0);
    }
  }
}

}  // namespace stepwright::image

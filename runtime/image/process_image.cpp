#include "runtime/image/process_image.h"

#include <cassert>
#include <cstring>

#include "runtime/base/hash64.h"

namespace stepwright::image {

ProcessImage::ProcessImage(std::span<std::byte> memory, const ImageLayout& layout)
    : memory_(memory), layout_(layout) {
  assert(memory.size() == layout.memory_size());
}

void ProcessImage::reset(std::span<const std::byte> initial) {
  assert(initial.size() <= layout_.size());
  if (!initial.empty()) std::memcpy(memory_.data(), initial.data(), initial.size());
  for (std::byte& byte : bytes().subspan(initial.size())) byte = std::byte{0};
}

std::uint64_t ProcessImage::hash() const {
  return base::hash_bytes(bytes());
}

}  // namespace stepwright::image

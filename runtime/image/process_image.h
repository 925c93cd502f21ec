#pragma once

// The process image: all variable memory of a program in one block, [inputs][outputs][markers][data].
// Between two scans it is the whole state of the program, so that a snapshot, a hash or a comparison needs
// nothing else. Behind it in the same block lie the frames, scratch memory of the running functions without a
// value between scans. The block belongs to the caller; no heap here.
// Thread rule: one scan thread writes; others read copies that it publishes.
//
//   std::vector<std::byte> memory(layout.memory_size());
//   image::ProcessImage image(memory, layout);
//   image.reset(initial_data);
//   image::set_bit(image.outputs(), 0, 3, true);  // %QX0.3

#include <cstddef>
#include <cstdint>
#include <span>

namespace stepwright::image {

// Sizes of the areas in bytes; they follow each other in this order without gaps.
struct ImageLayout {
  std::uint32_t inputs = 0;
  std::uint32_t outputs = 0;
  std::uint32_t markers = 0;
  std::uint32_t data = 0;
  std::uint32_t frames = 0;  // of all tasks

  // Of the image.
  constexpr std::uint32_t size() const { return inputs + outputs + markers + data; }
  // Of the whole block.
  constexpr std::uint32_t memory_size() const { return size() + frames; }
};

class ProcessImage {
 public:
  // Requires memory of layout.memory_size() bytes. Does not touch it.
  ProcessImage(std::span<std::byte> memory, const ImageLayout& layout);

  // Every byte of the image to its initial value: `initial` from address 0 on, zero behind it.
  // Requires initial.size() <= layout.size().
  void reset(std::span<const std::byte> initial);

  std::span<std::byte> bytes() { return memory_.first(layout_.size()); }
  std::span<const std::byte> bytes() const { return memory_.first(layout_.size()); }
  std::span<std::byte> memory() { return memory_; }  // with the frames: what an engine runs on
  std::span<std::byte> inputs() { return memory_.first(layout_.inputs); }
  std::span<std::byte> outputs() { return memory_.subspan(layout_.inputs, layout_.outputs); }
  std::span<std::byte> markers() {
    return memory_.subspan(layout_.inputs + layout_.outputs, layout_.markers);
  }
  std::span<std::byte> data() {
    return memory_.subspan(layout_.inputs + layout_.outputs + layout_.markers, layout_.data);
  }
  const ImageLayout& layout() const { return layout_; }

  // The same for equal images on every machine.
  std::uint64_t hash() const;

 private:
  std::span<std::byte> memory_;
  ImageLayout layout_;
};

// Bit `bit` (0..7) of byte `byte` of an area. Requires a byte inside the area.
inline bool get_bit(std::span<const std::byte> area, std::uint32_t byte, std::uint8_t bit) {
  return ((area[byte] >> bit) & std::byte{1}) != std::byte{0};
}
inline void set_bit(std::span<std::byte> area, std::uint32_t byte, std::uint8_t bit, bool value) {
  area[byte] = (area[byte] & ~(std::byte{1} << bit)) | (std::byte{value} << bit);
}

}  // namespace stepwright::image

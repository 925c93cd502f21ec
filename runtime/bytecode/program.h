#pragma once

// A verified program: the only thing that an engine runs. Only verify() makes one, so that an unverified
// container cannot be executed (house rule: what must not happen does not compile).
// A Program is a view: the container's bytes must outlive it and stay unchanged.
//
//   bytecode::Program program;
//   std::vector<std::uint32_t> scratch(bytecode::verify_scratch_words(bytes));
//   if (auto result = bytecode::verify(bytes, scratch, program); !result.ok()) ...

#include <cstddef>
#include <cstdint>
#include <span>

#include "runtime/bytecode/container_view.h"
#include "runtime/bytecode/verify_result.h"

namespace stepwright::bytecode {

class Program {
 public:
  Program() = default;  // no program: every table is empty

  const ContainerView& container() const { return view_; }
  const SizesRecord& sizes() const { return sizes_; }
  // Bytes of the image: the state between two scans.
  std::uint32_t image_size() const { return static_cast<std::uint32_t>(image_bytes(sizes_)); }

  // Bytes of the image and the frames behind it: what an engine runs on.
  std::uint32_t memory_size() const {
    return static_cast<std::uint32_t>(memory_bytes(sizes_, view_.count<Section::Tasks>()));
  }

  // Where the frames of a task (its index in the table) start.
  std::uint32_t frames_of(std::uint32_t task) const { return image_size() + task * sizes_.frame_bytes; }

 private:
  friend VerifyResult verify(std::span<const std::byte>, std::span<std::uint32_t>, Program&);
  explicit Program(const ContainerView& view) : view_(view), sizes_(view.sizes()) {}

  ContainerView view_;
  SizesRecord sizes_{};
};

// Scratch memory that verify needs for this file, in 32-bit words; 0 if the file is so broken that it needs
// none. Walks the tables once.
std::uint64_t verify_scratch_words(std::span<const std::byte> bytes);

// Accepts or refuses a container. `program` is set only if the result is ok. Any bytes are safe to pass.
VerifyResult verify(std::span<const std::byte> bytes, std::span<std::uint32_t> scratch, Program& program);

}  // namespace stepwright::bytecode

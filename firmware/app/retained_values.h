#pragma once

// The retained variables of a program, one behind the other as its retain map names them. Pure; any thread.

#include <cstdint>
#include <span>

#include "runtime/bytecode/program.h"

namespace stepwright::app {

// Bytes of all of them.
std::uint64_t retain_bytes(const bytecode::Program& program);

// Copies them out of the image, and back into it; the copy has retain_bytes().
void copy_retained(const bytecode::Program& program, std::span<const std::byte> image,
                   std::span<std::byte> copy);
void restore_retained(const bytecode::Program& program, std::span<const std::byte> copy,
                      std::span<std::byte> image);

}  // namespace stepwright::app

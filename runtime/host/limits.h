#pragma once

// The bounds of everything that enters a runtime from outside. They hold on the service socket and on Fast
// DDS alike (runtime/dds/idl/runtime_types.idl repeats them), and what exceeds one is refused before it is
// copied.

#include <cstddef>
#include <cstdint>

namespace stepwright::host {

inline constexpr std::size_t kMaxImageBytes = 1u << 20;       // of one process image
inline constexpr std::size_t kMaxContainerBytes = 16u << 20;  // of one program
inline constexpr std::size_t kMaxChunkBytes = 32u << 10;      // of a program in one message
inline constexpr std::size_t kMaxPlantValues = 128;           // truth values of a simulated plant
inline constexpr std::size_t kMaxNameBytes = 64;              // plant values, faults, runtime ids
inline constexpr std::size_t kMaxPathBytes = 4'096;           // of a file that a runtime is to write
inline constexpr std::size_t kMaxReasonBytes = 200;           // why a runtime is stopped
inline constexpr std::size_t kMaxBlockWrites = 2'048;         // parts of one write
inline constexpr std::size_t kDigestLetters = 64;             // of a program's SHA-256 in hexadecimal
inline constexpr std::uint64_t kMaxForceMs = 366ull * 24 * 3'600 * 1'000;  // of a force that ends by itself

}  // namespace stepwright::host

#pragma once

// The bounds of everything that enters a runtime from outside or leaves it. They hold on the service socket
// and on Fast DDS alike.

#include <cstddef>
#include <cstdint>

namespace stepwright::host {

inline constexpr std::size_t kMaxImageBytes = 1u << 20;       // of one process image
inline constexpr std::size_t kMaxContainerBytes = 16u << 20;  // of one program
inline constexpr std::size_t kMaxChunkBytes = 32u << 10;      // of a program in one message
inline constexpr std::size_t kMaxPlantValues = 1'024;         // truth values of a simulated plant
inline constexpr std::size_t kMaxNameBytes = 64;              // plant values, faults, runtime ids
inline constexpr std::size_t kMaxPathBytes = 4'096;           // of a file that a runtime is to write
inline constexpr std::size_t kMaxTextBytes = 4'096;           // a text of a diagnostic, detail of a status
inline constexpr std::size_t kMaxProblems = 64;               // diagnostics in one reply
inline constexpr std::size_t kMaxDevices = 64;                // devices of one cell
inline constexpr std::size_t kMaxProcessBytes = 256;          // as a supervisor calls itself
inline constexpr std::size_t kMaxReasonBytes = 200;           // why a runtime is stopped
inline constexpr std::size_t kMaxBlockWrites = 2'048;         // parts of one write
// How often image and figures are published while nothing happens. Events publish at once.
inline constexpr std::int64_t kPublishPeriodNs = 5'000'000;
inline constexpr std::size_t kDigestLetters = 64;  // of a program's SHA-256 in hexadecimal
inline constexpr std::uint64_t kMaxForceMs = 366ull * 24 * 3'600 * 1'000;  // of a force that ends by itself

}  // namespace stepwright::host

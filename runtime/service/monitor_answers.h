#pragma once

// Encoding of the answers for observers (forces, faults, recording), as the bytes of Reply::data.
//
//   auto reply = connection.call(ReadForces{}, 1s);
//   auto forces = decode_forces(reply->data);
//
// Pure functions; any thread. Any bytes are safe to decode: malformed ones fail with R0005.

#include <cstddef>
#include <span>
#include <vector>

#include "runtime/ground/result/result.h"
#include "runtime/host/plant_fault.h"
#include "runtime/image/force_table.h"
#include "runtime/record/recorder.h"

namespace stepwright::service {

// A force's `end_ns` travels as it is: in an answer it is the time that is left (host::Forces).
std::vector<std::byte> encode_forces(std::span<const image::Force> forces);
[[nodiscard]] result::Result<std::vector<image::Force>> decode_forces(std::span<const std::byte> data);

// As many as kMaxChunkBytes has room for; texts are cut at kMaxNameBytes, meanings at kMaxMeaningBytes.
inline constexpr std::size_t kMaxMeaningBytes = 512;
std::vector<std::byte> encode_faults(std::span<const host::PlantFault> faults);
[[nodiscard]] result::Result<std::vector<host::PlantFault>> decode_faults(std::span<const std::byte> data);

std::vector<std::byte> encode_recording(const record::RecordingStatus& status);
[[nodiscard]] result::Result<record::RecordingStatus> decode_recording(std::span<const std::byte> data);

}  // namespace stepwright::service

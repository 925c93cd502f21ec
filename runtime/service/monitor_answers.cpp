#include "runtime/service/monitor_answers.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "runtime/base/byte_reader.h"
#include "runtime/host/limits.h"
#include "runtime/record/recording_format.h"

namespace stepwright::service {
namespace {

constexpr std::size_t kForceBytes = 22;
constexpr std::size_t kFixedBytes = 128;
constexpr std::size_t kMostFaultBytes = 2 * host::kMaxNameBytes + kMaxMeaningBytes + 64;
constexpr std::uint8_t kWhole = 1;
constexpr std::uint8_t kHolds = 2;

std::vector<std::byte> finish(const record::Encoder& out) {
  return {out.bytes().begin(), out.bytes().end()};
}

tl::unexpected<result::Diagnostics> malformed() {
  return result::fail("R0005", {}, "the answer of the runtime is malformed");
}

std::string read_text(base::ByteReader& in) {
  std::uint64_t size = 0;
  record::read_varint(in, size);
  const auto text = in.read_bytes(static_cast<std::size_t>(size));
  return {reinterpret_cast<const char*>(text.data()), text.size()};
}

}  // namespace

std::vector<std::byte> encode_forces(std::span<const image::Force> forces) {
  std::vector<std::byte> buffer(forces.size() * kForceBytes);
  record::Encoder out(buffer);
  for (const image::Force& force : forces)
    out.put(force.address).put(force.bit).put(force.size).put(force.value).put(force.end_ns);
  return finish(out);
}

result::Result<std::vector<image::Force>> decode_forces(std::span<const std::byte> data) {
  if (data.size() % kForceBytes != 0 || data.size() > image::ForceTable::kCapacity * kForceBytes)
    return malformed();
  base::ByteReader in(data);
  std::vector<image::Force> forces;
  while (!in.at_end()) {
    image::Force& force = forces.emplace_back();
    force.address = in.read<std::uint32_t>();
    force.bit = in.read<std::uint8_t>();
    force.size = in.read<std::uint8_t>();
    force.value = in.read<std::uint64_t>();
    force.end_ns = in.read<std::int64_t>();
    const bool right = std::has_single_bit(force.size) && force.size <= sizeof force.value &&
                       (force.bit < 8 || force.bit == image::kWholeBytes) &&
                       force.address < host::kMaxImageBytes && force.end_ns >= 0;
    if (!right) return malformed();
  }
  return forces;
}

std::vector<std::byte> encode_faults(std::span<const host::PlantFault> faults) {
  std::vector<std::byte> buffer(host::kMaxChunkBytes);
  record::Encoder out(buffer);
  for (const host::PlantFault& fault : faults) {
    if (host::kMaxChunkBytes - out.bytes().size() < kMostFaultBytes) break;
    const auto text = [&out](const std::string& whole, std::size_t most) {
      out.put_block(std::as_bytes(std::span(whole)).first(std::min(whole.size(), most)));
    };
    text(fault.name, host::kMaxNameBytes);
    text(fault.unit, host::kMaxNameBytes);
    text(fault.meaning, kMaxMeaningBytes);
    out.put(fault.low).put(fault.high).put(fault.value);
    out.put(static_cast<std::uint8_t>((fault.whole ? kWhole : 0) | (fault.holds ? kHolds : 0)));
  }
  return finish(out);
}

result::Result<std::vector<host::PlantFault>> decode_faults(std::span<const std::byte> data) {
  if (data.size() > host::kMaxChunkBytes) return malformed();
  base::ByteReader in(data);
  std::vector<host::PlantFault> faults;
  while (in.ok() && !in.at_end()) {
    host::PlantFault& fault = faults.emplace_back();
    fault.name = read_text(in);
    fault.unit = read_text(in);
    fault.meaning = read_text(in);
    fault.low = in.read<double>();
    fault.high = in.read<double>();
    fault.value = in.read<double>();
    const auto flags = in.read<std::uint8_t>();
    fault.whole = (flags & kWhole) != 0;
    fault.holds = (flags & kHolds) != 0;
    if (!std::isfinite(fault.low) || !std::isfinite(fault.high) || !std::isfinite(fault.value))
      return malformed();
  }
  if (!in.ok()) return malformed();
  return faults;
}

std::vector<std::byte> encode_recording(const record::RecordingStatus& status) {
  std::vector<std::byte> buffer(kFixedBytes + status.file.size() + status.problem.size());
  record::Encoder out(buffer);
  out.put(status.state).put(status.scans).put(status.bytes).put(status.gaps).put(status.first_gap);
  out.put_block(std::as_bytes(std::span(status.file))).put_block(std::as_bytes(std::span(status.problem)));
  return finish(out);
}

result::Result<record::RecordingStatus> decode_recording(std::span<const std::byte> data) {
  base::ByteReader in(data);
  record::RecordingStatus status;
  const auto state = in.read<std::uint8_t>();
  if (state > static_cast<std::uint8_t>(record::RecordingState::Failed)) return malformed();
  status.state = static_cast<record::RecordingState>(state);
  status.scans = in.read<std::uint64_t>();
  status.bytes = in.read<std::uint64_t>();
  status.gaps = in.read<std::uint64_t>();
  status.first_gap = in.read<std::uint64_t>();
  status.file = read_text(in);
  status.problem = read_text(in);
  if (!in.ok() || !in.at_end()) return malformed();
  return status;
}

}  // namespace stepwright::service

#include "hmi_web/historian/summary.h"

#include <cmath>
#include <cstring>

#include "runtime/base/byte_reader.h"
#include "runtime/base/crc32c.h"

namespace stepwright::historian {
namespace {

constexpr std::uint8_t kVersion = 1;

bool usable(const Sample& sample) {
  return sample.quality <= Quality::Uncertain && !std::isnan(sample.value);
}

void take_extremes(Summary& into, const Sample& least, const Sample& greatest) {
  const bool lower = least.value < into.least.value ||
                     (least.value == into.least.value && least.time_ns < into.least.time_ns);
  const bool higher = greatest.value > into.greatest.value ||
                      (greatest.value == into.greatest.value && greatest.time_ns < into.greatest.time_ns);
  if (!into.has_extremes() || lower) into.least = least;
  if (!into.has_extremes() || higher) into.greatest = greatest;
}

Sample read_sample(base::ByteReader& in) {
  Sample sample;
  sample.time_ns = in.read<std::int64_t>();
  sample.value = in.read<double>();
  sample.quality = static_cast<Quality>(in.read<std::uint8_t>() % kQualities);
  return sample;
}

}  // namespace

void Summary::add(const Sample& sample) {
  if (count == 0 || sample.time_ns < first.time_ns) first = sample;
  if (count == 0 || sample.time_ns >= last.time_ns) last = sample;
  if (usable(sample)) {
    take_extremes(*this, sample, sample);
  } else {
    ++unusable;
  }
  ++count;
}

void Summary::add(const Summary& other) {
  if (other.count == 0) return;
  if (count == 0 || other.first.time_ns < first.time_ns) first = other.first;
  if (count == 0 || other.last.time_ns >= last.time_ns) last = other.last;
  if (other.has_extremes()) take_extremes(*this, other.least, other.greatest);
  count += other.count;
  unusable += other.unusable;
}

Summary summary_of(std::span<const Sample> samples) {
  Summary summary;
  for (const Sample& sample : samples) summary.add(sample);
  return summary;
}

std::array<std::byte, kSummaryBytes> encode(const Summary& summary) {
  std::array<std::byte, kSummaryBytes> bytes{};
  std::size_t at = 0;
  const auto put = [&](auto value) {
    std::memcpy(bytes.data() + at, &value, sizeof value);
    at += sizeof value;
  };
  put(kVersion);
  put(summary.count);
  put(summary.unusable);
  for (const Sample* sample : {&summary.first, &summary.last, &summary.least, &summary.greatest}) {
    put(sample->time_ns);
    put(sample->value);
    put(static_cast<std::uint8_t>(sample->quality));
  }
  put(base::crc32c(std::span(bytes).first(at)));
  return bytes;
}

std::optional<Summary> decode_summary(std::span<const std::byte> bytes) {
  if (bytes.size() != kSummaryBytes) return std::nullopt;
  const auto content = bytes.first(kSummaryBytes - 4);
  if (base::ByteReader(bytes.last(4)).read<std::uint32_t>() != base::crc32c(content)) return std::nullopt;
  base::ByteReader in(content);
  if (in.read<std::uint8_t>() != kVersion) return std::nullopt;
  Summary summary;
  summary.count = in.read<std::uint64_t>();
  summary.unusable = in.read<std::uint64_t>();
  for (Sample* sample : {&summary.first, &summary.last, &summary.least, &summary.greatest})
    *sample = read_sample(in);
  const bool sound =
      summary.count > 0 && summary.unusable <= summary.count && summary.first.time_ns <= summary.last.time_ns;
  if (!sound) return std::nullopt;
  return summary;
}

}  // namespace stepwright::historian

#include "hmi_web/historian/block.h"

#include <cassert>
#include <cstring>
#include <limits>

#include "hmi_web/historian/internal/bits.h"
#include "hmi_web/historian/internal/values.h"
#include "runtime/base/byte_reader.h"
#include "runtime/base/crc32c.h"

namespace stepwright::historian {
namespace {

using internal::BitReader;
using internal::Bits;
using internal::BitWriter;
using internal::ValueCode;

constexpr std::uint8_t kVersion = 1;
constexpr std::size_t kHeaderBytes = 14;  // version, value code, time unit, rice, count, first time
constexpr std::size_t kSumBytes = 4;
constexpr unsigned kMostDigits = 9;  // the coarsest unit of time is 10^9 ns

template <typename T>
void append(Bits& out, T value) {
  const auto at = out.size();
  out.resize(at + sizeof(T));
  std::memcpy(out.data() + at, &value, sizeof(T));
}

std::uint64_t difference(std::int64_t later, std::int64_t earlier) {
  return static_cast<std::uint64_t>(later) - static_cast<std::uint64_t>(earlier);
}

// The coarsest power of ten of a nanosecond of which every distance is a multiple: scans keep to a grid.
unsigned unit_digits(std::span<const Sample> samples) {
  unsigned digits = kMostDigits;
  std::uint64_t unit = 1'000'000'000;
  for (std::size_t i = 1; i < samples.size() && digits > 0; ++i) {
    const std::uint64_t distance = difference(samples[i].time_ns, samples[i - 1].time_ns);
    while (distance % unit != 0) {
      unit /= 10;
      --digits;
    }
  }
  return digits;
}

std::uint64_t power_of_ten(unsigned digits) {
  std::uint64_t power = 1;
  while (digits-- > 0) power *= 10;
  return power;
}

struct Times {
  unsigned digits = 0;
  unsigned k = 0;
  std::vector<std::uint64_t> codes;  // of all but the first
};

Times code_times(std::span<const Sample> samples) {
  Times times;
  times.digits = unit_digits(samples);
  const std::uint64_t unit = power_of_ten(times.digits);
  internal::WidthCounts counts;
  std::uint64_t before = 0;
  for (std::size_t i = 1; i < samples.size(); ++i) {
    const std::uint64_t delta = difference(samples[i].time_ns, samples[i - 1].time_ns) / unit;
    times.codes.push_back(internal::zigzag(static_cast<std::int64_t>(delta - before)));
    if (i > 1) counts.add(times.codes.back());  // the first is a whole distance
    before = delta;
  }
  times.k = counts.best_rice();
  return times;
}

void write_qualities(std::span<const Sample> samples, BitWriter& out) {
  bool equal = true;
  for (const Sample& sample : samples) equal = equal && sample.quality == samples[0].quality;
  out.put(equal ? 0 : 1, 1);
  Quality before = samples[0].quality;
  out.put(static_cast<std::uint8_t>(before), 2);
  if (equal) return;
  for (const Sample& sample : samples.subspan(1)) {
    out.put(sample.quality == before ? 0 : 1, 1);
    if (sample.quality != before) out.put(static_cast<std::uint8_t>(sample.quality), 2);
    before = sample.quality;
  }
}

void read_qualities(BitReader& in, std::span<Sample> samples) {
  const bool differ = in.get(1) != 0;
  auto quality = static_cast<Quality>(in.get(2));
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (differ && i > 0 && in.get(1) != 0) quality = static_cast<Quality>(in.get(2));
    samples[i].quality = quality;
  }
}

// The shortest code of the values.
ValueCode code_values(std::span<const double> values, Bits& best) {
  if (const auto exponent = internal::decimal_exponent(values)) {
    BitWriter out(best);
    internal::write_scaled(values, *exponent, out);
    out.finish();
    return ValueCode::Scaled;
  }
  BitWriter out(best);
  internal::write_xor(values, out);
  out.finish();
  Bits other;
  BitWriter other_out(other);
  if (!internal::write_dictionary(values, other_out)) return ValueCode::Xor;
  other_out.finish();
  if (other.size() >= best.size()) return ValueCode::Xor;
  best.swap(other);
  return ValueCode::Dictionary;
}

bool read_values(ValueCode code, BitReader& in, std::span<double> values) {
  switch (code) {
    case ValueCode::Scaled:
      return internal::read_scaled(in, values);
    case ValueCode::Dictionary:
      return internal::read_dictionary(in, values);
    case ValueCode::Xor:
      return internal::read_xor(in, values);
  }
  return false;
}

// False for times that are not in order or run over the end of time.
bool read_times(BitReader& in, unsigned digits, unsigned k, std::int64_t first, std::span<Sample> samples) {
  const std::uint64_t unit = power_of_ten(digits);
  std::uint64_t delta = 0;
  std::int64_t time = first;
  samples[0].time_ns = first;
  for (Sample& sample : samples.subspan(1)) {
    delta += static_cast<std::uint64_t>(internal::unzigzag(in.get_rice(k)));
    const std::uint64_t left = difference(std::numeric_limits<std::int64_t>::max(), time);
    if (delta > left / unit) return false;
    time = static_cast<std::int64_t>(static_cast<std::uint64_t>(time) + delta * unit);
    sample.time_ns = time;
  }
  return in.ok();
}

}  // namespace

const char* to_string(Quality quality) {
  constexpr const char* kNames[] = {"good", "uncertain", "bad", "missing"};
  return kNames[static_cast<std::size_t>(quality)];
}

std::vector<std::byte> encode_block(std::span<const Sample> samples) {
  assert(!samples.empty() && samples.size() <= kMostInBlock);
  const Times times = code_times(samples);
  std::vector<double> values;
  values.reserve(samples.size());
  for (const Sample& sample : samples) values.push_back(sample.value);
  Bits value_bits;
  const ValueCode code = code_values(values, value_bits);

  Bits block;
  block.reserve(kHeaderBytes + kSumBytes + samples.size() + value_bits.size());
  append(block, kVersion);
  append(block, static_cast<std::uint8_t>(code));
  append(block, static_cast<std::uint8_t>(times.digits));
  append(block, static_cast<std::uint8_t>(times.k));
  append(block, static_cast<std::uint16_t>(samples.size()));
  append(block, samples[0].time_ns);
  BitWriter out(block);
  write_qualities(samples, out);
  for (const std::uint64_t time : times.codes) out.put_rice(time, times.k);
  out.finish();
  // The values begin at a byte, so that the length of their code could be chosen before.
  block.insert(block.end(), value_bits.begin(), value_bits.end());
  append(block, base::crc32c(block));
  return block;
}

bool decode_block(std::span<const std::byte> bytes, std::vector<Sample>& samples) {
  if (bytes.size() < kHeaderBytes + kSumBytes) return false;
  const auto content = bytes.first(bytes.size() - kSumBytes);
  if (base::ByteReader(bytes.last(kSumBytes)).read<std::uint32_t>() != base::crc32c(content)) return false;
  base::ByteReader header(content);
  const auto version = header.read<std::uint8_t>();
  const auto code = header.read<std::uint8_t>();
  const auto digits = header.read<std::uint8_t>();
  const auto k = header.read<std::uint8_t>();
  const std::size_t count = header.read<std::uint16_t>();
  const auto first = header.read<std::int64_t>();
  const bool known = version == kVersion && code < internal::kValueCodes && digits <= kMostDigits && k < 64;
  // A sample takes two bits at least, so that a small block cannot ask for much memory.
  if (!known || count == 0 || count > 8 * content.size()) return false;

  const std::size_t before = samples.size();
  samples.resize(before + count);
  const auto made = std::span(samples).subspan(before);
  std::vector<double> values(count);
  BitReader in(content.subspan(kHeaderBytes));
  read_qualities(in, made);
  bool sound = read_times(in, digits, k, first, made);
  in.align();
  sound = sound && read_values(static_cast<ValueCode>(code), in, values);
  if (!sound) {
    samples.resize(before);
    return false;
  }
  for (std::size_t i = 0; i < count; ++i) made[i].value = values[i];
  return true;
}

}  // namespace stepwright::historian

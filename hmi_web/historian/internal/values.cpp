#include "hmi_web/historian/internal/values.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "hmi_web/historian/sample.h"

// XOR: after Pelkonen et al., "Gorilla: A Fast, Scalable, In-Memory Time Series Database" (VLDB 2015),
// section 4.1.2, with six bits for the zeros in front.

namespace stepwright::historian::internal {
namespace {

constexpr std::array<double, 10> kPowers = {1, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9};
constexpr double kLargest = 9007199254740992.0;  // 2^53: every whole number up to it is a double

// The value times the power as a whole number, if that over the power is the value again.
bool scale(double value, double power, std::int64_t& scaled) {
  const double product = value * power;
  if (!(std::abs(product) < kLargest)) return false;  // NaN too
  scaled = std::llrint(product);
  return same_value(static_cast<double>(scaled) / power, value);
}

constexpr std::size_t kMostEntries = 256;
constexpr std::uint64_t kSign = std::uint64_t{1} << 63;

// Numbers in the order of the values they stand for, NaN and -0 included.
std::uint64_t ordered(double value) {
  const auto bits = std::bit_cast<std::uint64_t>(value);
  return (bits & kSign) != 0 ? ~bits : bits | kSign;
}
double value_of(std::uint64_t order) {
  return std::bit_cast<double>((order & kSign) != 0 ? order & ~kSign : ~order);
}

// The bits of a difference that are written: between its zeros in front and behind.
struct Window {
  unsigned leading = 64;
  unsigned width = 0;
  unsigned trailing() const { return 64 - leading - width; }
};

}  // namespace

std::optional<unsigned> decimal_exponent(std::span<const double> values) {
  unsigned exponent = 0;
  std::int64_t scaled = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (scale(values[i], kPowers[exponent], scaled)) continue;
    do {
      if (++exponent == kPowers.size()) return std::nullopt;
    } while (!scale(values[i], kPowers[exponent], scaled));
    // What was exact with a smaller power nearly always is with a greater one, but has to be seen.
    for (std::size_t before = 0; before < i; ++before)
      if (!scale(values[before], kPowers[exponent], scaled)) return std::nullopt;
  }
  return exponent;
}

void write_scaled(std::span<const double> values, unsigned exponent, BitWriter& out) {
  std::vector<std::uint64_t> deltas;
  deltas.reserve(values.size());
  WidthCounts counts;
  std::int64_t before = 0;
  for (const double value : values) {
    std::int64_t scaled = 0;
    scale(value, kPowers[exponent], scaled);
    deltas.push_back(zigzag(scaled - before));
    if (deltas.size() > 1) counts.add(deltas.back());
    before = scaled;
  }
  const unsigned k = counts.best_rice();
  out.put(exponent, 4);
  out.put(k, 6);
  for (const std::uint64_t delta : deltas) out.put_rice(delta, k);
}

bool read_scaled(BitReader& in, std::span<double> values) {
  const auto exponent = static_cast<std::size_t>(in.get(4));
  const auto k = static_cast<unsigned>(in.get(6));
  if (exponent >= kPowers.size()) return false;
  std::uint64_t scaled = 0;  // unsigned: a sum of damaged numbers wraps around
  for (double& value : values) {
    scaled += static_cast<std::uint64_t>(unzigzag(in.get_rice(k)));
    value = static_cast<double>(static_cast<std::int64_t>(scaled)) / kPowers[exponent];
  }
  return in.ok();
}

bool write_dictionary(std::span<const double> values, BitWriter& out) {
  std::vector<std::uint64_t> entries;
  entries.reserve(values.size());
  for (const double value : values) entries.push_back(ordered(value));
  std::vector<std::uint64_t> keys = entries;
  std::ranges::sort(entries);
  entries.erase(std::ranges::unique(entries).begin(), entries.end());
  if (entries.size() > kMostEntries) return false;
  WidthCounts counts;
  std::int64_t before = 0;
  for (std::uint64_t& key : keys) {
    const std::int64_t index = std::ranges::lower_bound(entries, key) - entries.begin();
    key = zigzag(index - before);
    counts.add(key);
    before = index;
  }
  const unsigned k = counts.best_rice();
  out.put(entries.size() - 1, 8);
  for (const std::uint64_t entry : entries) out.put(entry, 64);
  out.put(k, 6);
  for (const std::uint64_t key : keys) out.put_rice(key, k);
  return true;
}

bool read_dictionary(BitReader& in, std::span<double> values) {
  std::vector<double> entries(static_cast<std::size_t>(in.get(8)) + 1);
  for (double& entry : entries) entry = value_of(in.get(64));
  const auto k = static_cast<unsigned>(in.get(6));
  std::uint64_t index = 0;
  for (double& value : values) {
    index += static_cast<std::uint64_t>(unzigzag(in.get_rice(k)));
    if (index >= entries.size()) return false;
    value = entries[static_cast<std::size_t>(index)];
  }
  return in.ok();
}

void write_xor(std::span<const double> values, BitWriter& out) {
  std::uint64_t before = 0;
  Window window;
  for (const double value : values) {
    const auto bits = std::bit_cast<std::uint64_t>(value);
    const std::uint64_t difference = bits ^ before;
    before = bits;
    if (difference == 0) {
      out.put(0, 1);
      continue;
    }
    const auto leading = static_cast<unsigned>(std::countl_zero(difference));
    const auto trailing = static_cast<unsigned>(std::countr_zero(difference));
    const unsigned width = 64 - leading - trailing;
    const bool fits = window.width > 0 && leading >= window.leading && trailing >= window.trailing();
    if (fits && window.width < width + 12) {  // naming another window costs 12 bits
      out.put(2, 2);
    } else {
      window = {leading, width};
      out.put(3, 2);
      out.put(leading, 6);
      out.put(width - 1, 6);
    }
    out.put(difference >> window.trailing(), window.width);
  }
}

bool read_xor(BitReader& in, std::span<double> values) {
  std::uint64_t bits = 0;
  Window window;
  for (double& value : values) {
    if (in.get(1) != 0) {
      if (in.get(1) != 0) {
        window.leading = static_cast<unsigned>(in.get(6));
        window.width = static_cast<unsigned>(in.get(6)) + 1;
        if (window.leading + window.width > 64) return false;
      }
      if (window.width == 0) return false;
      bits ^= in.get(window.width) << window.trailing();
    }
    value = std::bit_cast<double>(bits);
  }
  return in.ok();
}

}  // namespace stepwright::historian::internal

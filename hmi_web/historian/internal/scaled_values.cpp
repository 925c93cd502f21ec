#include <array>
#include <cmath>

#include "hmi_web/historian/internal/values.h"
#include "hmi_web/historian/sample.h"

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

}  // namespace stepwright::historian::internal

#include <algorithm>
#include <bit>

#include "hmi_web/historian/internal/values.h"

namespace stepwright::historian::internal {
namespace {

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

}  // namespace

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

}  // namespace stepwright::historian::internal

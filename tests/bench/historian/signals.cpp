#include "tests/bench/historian/signals.h"

#include <array>
#include <cmath>
#include <cstddef>

namespace stepwright::bench {

const char* to_string(SignalKind kind) {
  constexpr std::array<const char*, kSignalKinds> kNames = {"counts", "scaled", "real", "rounded"};
  return kNames[static_cast<std::size_t>(kind)];
}

historian::Sample Signal::next() {
  time_ns_ += period_ns_;
  double before = counts_;
  // Always another value: repeats would not be stored at all.
  while (counts_ == before) counts_ += std::round(step_(random_));
  filtered_ += 0.1 * (counts_ - filtered_);
  switch (kind_) {
    case SignalKind::Counts:
      return {time_ns_, counts_};
    case SignalKind::Scaled:
      return {time_ns_, counts_ * 0.0071428571};
    case SignalKind::Real:
      return {time_ns_, static_cast<double>(static_cast<float>(filtered_))};
    case SignalKind::Rounded:
      return {time_ns_, std::round(counts_ * 7.1) / 100.0};
  }
  return {};
}

}  // namespace stepwright::bench

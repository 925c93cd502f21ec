#pragma once

// Signals of a plant, drawn by a seed: what a historian is measured with.
//
// Not thread-safe; one object per signal.

#include <cstdint>
#include <random>

#include "hmi_web/historian/sample.h"

namespace stepwright::bench {

enum class SignalKind : std::uint8_t {
  Counts,   // of a converter: a level that wanders by a count or two a second
  Scaled,   // the same through the factor of a sensor, as an LREAL
  Real,     // a filtered REAL: no two values are alike
  Rounded,  // a measured value with two decimals
};
inline constexpr int kSignalKinds = 4;
const char* to_string(SignalKind kind);

class Signal {
 public:
  Signal(SignalKind kind, std::int64_t period_ns, unsigned seed)
      : kind_(kind), period_ns_(period_ns), random_(seed) {}
  // A sample every period, on the grid of a scan of 10 ms.
  historian::Sample next();

 private:
  void step();
  SignalKind kind_;
  std::int64_t period_ns_;
  std::mt19937 random_;
  std::normal_distribution<double> step_{0.0, 1.0};
  std::int64_t time_ns_ = 0;
  double counts_ = 2000.0;
  double filtered_ = 2000.0;
  double value_ = -1.0;  // told last
};

}  // namespace stepwright::bench

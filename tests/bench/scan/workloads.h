#pragma once

// The three workloads of the scan benchmark, each as bytecode and as the C++ that a programmer would write by
// hand for the same job. Both give the same results, which the benchmark checks before it measures.

#include <array>
#include <cstdint>
#include <vector>

#include "runtime/bytecode/writer/container_model.h"

namespace stepwright::bench {

// A ladder of rungs over located bits: out := ((a AND NOT b) OR c) AND d.
struct Ladder {
  static constexpr std::uint32_t kInputs = 256;
  struct Rung {
    std::uint32_t a = 0, b = 0, c = 0, d = 0;  // an input, or kInputs + an earlier rung's number
  };
  std::vector<Rung> rungs;

  Ladder(std::uint32_t count, std::uint32_t seed);

  // Inputs are the bits of the first 32 bytes, coils one BOOL byte each behind them.
  writer::ContainerModel bytecode() const;
  // `image` as the bytecode's.
  void reference(std::uint8_t* image) const;
};

// FOR i := 1 TO 10000: x := x * 0.9999 + REAL(i); n := (n * 31 + i) MOD 65521.
struct Arithmetic {
  static constexpr std::int32_t kIterations = 10'000;
  std::int32_t i = 0;
  std::int32_t n = 0;
  float x = 0;

  static writer::ContainerModel bytecode();  // i, n, x at addresses 0, 4, 8
  void reference();
};

// 300 on-delay timers, called one after the other; all share the input at address 0.
struct Timers {
  static constexpr std::uint32_t kCount = 300;
  static constexpr std::uint32_t kSize = 18;
  static constexpr std::uint32_t kFirst = 1;  // address of the first timer
#pragma pack(push, 1)
  struct Timer {
    std::uint8_t in = 0;
    std::uint8_t q = 0;
    std::int64_t pt_ns = 0;
    std::int64_t start_ns = 0;
  };
  struct Image {
    std::uint8_t input = 0;
    std::array<Timer, kCount> timers;
  };
#pragma pack(pop)
  static_assert(sizeof(Timer) == kSize);

  static writer::ContainerModel bytecode();
  static void reference(Image& image, std::int64_t now_ns);
};

}  // namespace stepwright::bench

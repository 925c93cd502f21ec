#pragma once

// One way to run a workload: an engine or a baseline.

#include <cstdint>
#include <span>
#include <vector>

namespace stepwright::bench {

class Subject {
 public:
  virtual ~Subject() = default;
  virtual void set(std::span<const std::uint8_t> bools, std::span<const float> reals) = 0;
  virtual void scan(std::int64_t now_ns) = 0;
  virtual std::vector<double> results() = 0;
};

}  // namespace stepwright::bench

#pragma once

// Random charts whose conditions trap and have effects, and what sfc_semantics.md says about them: an
// evaluator that knows nothing of rungs or of the compiler.

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "tests/fuzz/st/random.h"

namespace stepwright::st_fuzz {

inline constexpr std::size_t kChartInputs = 3;    // BOOL in0 ..
inline constexpr std::size_t kChartNumbers = 3;   // DINT d0 .., which steps set
inline constexpr std::size_t kChartCounters = 4;  // DINT c0 .., which conditions count; the last is a global

struct ChartValues {
  std::array<bool, kChartInputs> inputs{};
  std::array<std::int64_t, kChartNumbers> numbers{};
  std::array<std::int64_t, kChartCounters> counters{};
  std::vector<bool> steps;  // at the beginning of the scan
};

// A BOOL expression.
struct ChartCondition {
  enum class Kind : std::uint8_t { True, Input, Step, Greater, Quotient, Count, Counted, Not, And, Or };
  Kind kind = Kind::True;
  std::size_t index = 0;  // of the input, step, number or counter
  std::int64_t literal = 0;
  std::vector<ChartCondition> children;

  std::string text() const;
  // Nothing: it divides by zero, and what comes behind is not evaluated.
  std::optional<bool> evaluate(ChartValues& values) const;
};

struct ChartTransition {
  std::vector<std::size_t> sources;
  std::vector<std::size_t> targets;
  int priority = 0;  // 0: none is written
  ChartCondition condition;
};

struct ConditionChart {
  struct Step {
    std::size_t number = 0;  // d<number> := d<number> * keeps + value; runs while the step is active
    bool keeps = false;
    std::int64_t value = 0;
  };
  std::vector<Step> steps;
  std::vector<ChartTransition> transitions;

  std::string text() const;
};

ConditionChart random_condition_chart(Random& random);

class ConditionChartRun {
 public:
  explicit ConditionChartRun(const ConditionChart& chart) : chart_(chart) {
    values_.steps.resize(chart.steps.size());
  }

  // False: the scan ends with a division by zero.
  bool scan(const std::array<bool, kChartInputs>& inputs);
  const ChartValues& values() const { return values_; }

 private:
  const ConditionChart& chart_;
  ChartValues values_;
  bool first_ = true;
};

}  // namespace stepwright::st_fuzz

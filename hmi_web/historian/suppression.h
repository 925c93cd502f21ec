#pragma once

// Suppression of samples of a tag that need not be kept.
//
//   Repeats       a value that is what the last kept one was: nothing is lost for whoever reads the tag as
//                 holding its value until the next sample. The default.
//   SwingingDoor  samples that a straight line between two kept ones passes within `deviation`
//                 (Bristol, "Swinging door trending", ISA 1990; with the slope of the kept line held to every
//                 sample that it replaces, so that the bound is exact)
//   None          every sample is kept
//
// A change of quality is kept always, and a sample at least every `longest_gap`, so that silence is told
// from a value that does not change.
//
//   Suppression filter({SuppressionKind::SwingingDoor, 0.5});
//   filter.offer(sample, [&](const Sample& kept) { ... });   // none, one or two
//
// Not thread-safe; one object per tag.

#include <cstdint>
#include <limits>
#include <optional>

#include "hmi_web/historian/sample.h"

namespace stepwright::historian {

enum class SuppressionKind : std::uint8_t { Repeats, SwingingDoor, None };

struct SuppressionSettings {
  SuppressionKind kind = SuppressionKind::Repeats;
  double deviation = 0.0;                         // SwingingDoor: in the unit of the tag, >= 0
  std::int64_t longest_gap_ns = 600'000'000'000;  // > 0
};

class Suppression {
 public:
  explicit Suppression(SuppressionSettings settings = {}) : settings_(settings) {}

  template <typename Keep>
  void offer(const Sample& sample, Keep&& keep) {
    const Kept kept = judge(sample);
    if (kept.held) keep(*kept.held);
    if (kept.sample) keep(sample);
  }

  // The newest sample, if it is not kept yet: the end of the line so far.
  const std::optional<Sample>& held() const { return held_; }
  // Begins anew behind a sample that is kept already.
  void resume(const Sample& kept);

 private:
  struct Kept {
    std::optional<Sample> held;
    bool sample = false;
  };
  Kept judge(const Sample& sample);
  Kept judge_line(const Sample& sample);
  bool fits_the_line(const Sample& sample);
  void narrow(const Sample& sample);

  SuppressionSettings settings_;
  std::optional<Sample> kept_;  // the last one that is kept
  std::optional<Sample> held_;  // SwingingDoor: behind it, not kept yet
  // Slopes of the lines from `kept_` that pass every sample up to `held_` within the deviation.
  double least_slope_ = -std::numeric_limits<double>::infinity();
  double greatest_slope_ = std::numeric_limits<double>::infinity();
};

}  // namespace stepwright::historian

#include "hmi_web/historian/suppression.h"

#include <algorithm>
#include <cmath>

namespace stepwright::historian {

void Suppression::resume(const Sample& kept) {
  kept_ = kept;
  held_.reset();
  least_slope_ = -std::numeric_limits<double>::infinity();
  greatest_slope_ = std::numeric_limits<double>::infinity();
}

Suppression::Kept Suppression::judge(const Sample& sample) {
  if (settings_.kind == SuppressionKind::None) return {std::nullopt, true};
  const bool ahead = kept_ && sample.time_ns >= kept_->time_ns;
  const bool comparable = ahead && sample.quality == kept_->quality;
  if (comparable && settings_.kind == SuppressionKind::SwingingDoor) return judge_line(sample);
  const bool recent =
      ahead && static_cast<std::uint64_t>(sample.time_ns) - static_cast<std::uint64_t>(kept_->time_ns) <
                   static_cast<std::uint64_t>(settings_.longest_gap_ns);
  if (comparable && recent && same_value(sample.value, kept_->value)) return {};
  Kept result{held_, true};
  // A sample that comes late changes nothing of what later ones are compared with.
  if (!kept_ || ahead) {
    resume(sample);
  } else {
    result.held.reset();
  }
  return result;
}

Suppression::Kept Suppression::judge_line(const Sample& sample) {
  const bool recent =
      static_cast<std::uint64_t>(sample.time_ns) - static_cast<std::uint64_t>(kept_->time_ns) <
      static_cast<std::uint64_t>(settings_.longest_gap_ns);
  const bool in_order = !held_ || sample.time_ns > held_->time_ns;
  if (recent && in_order && fits_the_line(sample)) {
    narrow(sample);
    held_ = sample;
    return {};
  }
  if (held_ && !in_order) return {std::nullopt, true};  // late: kept beside the line
  Kept result;
  if (!held_) {  // nothing lies between: the sample itself begins the next line
    result.sample = true;
    resume(sample);
    return result;
  }
  result.held = held_;
  resume(*held_);
  const bool still_recent =
      static_cast<std::uint64_t>(sample.time_ns) - static_cast<std::uint64_t>(kept_->time_ns) <
      static_cast<std::uint64_t>(settings_.longest_gap_ns);
  if (still_recent && fits_the_line(sample)) {
    narrow(sample);
    held_ = sample;
    return result;
  }
  result.sample = true;
  resume(sample);
  return result;
}

bool Suppression::fits_the_line(const Sample& sample) {
  if (!std::isfinite(sample.value) || !std::isfinite(kept_->value)) return false;
  if (sample.time_ns <= kept_->time_ns) return false;
  const double slope = (sample.value - kept_->value) / static_cast<double>(sample.time_ns - kept_->time_ns);
  return slope >= least_slope_ && slope <= greatest_slope_;
}

void Suppression::narrow(const Sample& sample) {
  const auto ns = static_cast<double>(sample.time_ns - kept_->time_ns);
  const double rise = sample.value - kept_->value;
  least_slope_ = std::max(least_slope_, (rise - settings_.deviation) / ns);
  greatest_slope_ = std::min(greatest_slope_, (rise + settings_.deviation) / ns);
}

}  // namespace stepwright::historian

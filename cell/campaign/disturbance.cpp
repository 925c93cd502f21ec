#include "cell/campaign/disturbance.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <iterator>

#include "plant_models/core/counter_random.h"
#include "plant_models/core/names.h"

namespace stepwright::campaign {
namespace {

constexpr std::uint64_t kStream = 1'207;  // of the faults; a plant's own streams are others

// Numbers of one run, one after the other.
class Draws {
 public:
  explicit Draws(std::uint64_t seed) : random_(seed, kStream) {}

  std::uint64_t below(std::uint64_t count) { return random_.bits(next_++) % count; }
  double between(double low, double high) {
    return low + (high - low) * 0.5 * (1.0 + random_.symmetric(next_++));
  }

 private:
  core::CounterRandom random_;
  std::uint64_t next_ = 0;
};

// Three digits are enough for people, and the same run whoever types them in again.
double rounded_to_digits(double value) {
  if (value == 0.0) return 0.0;
  const double power = std::pow(10.0, 2.0 - std::floor(std::log10(std::abs(value))));
  return std::round(value * power) / power;
}

double value_of(const core::FaultRange& range, Draws& draws) {
  if (!range.whole) {
    return std::clamp(rounded_to_digits(draws.between(range.min, range.max)), range.min, range.max);
  }
  // 0 of two values is often no fault at all.
  if (range.min == 0.0 && range.max == 1.0) return draws.below(4) == 0 ? 0.0 : 1.0;
  const auto values = static_cast<std::uint64_t>(range.max - range.min) + 1;
  return range.min + static_cast<double>(draws.below(values));
}

double tenths(double seconds) {
  return 0.1 * std::round(10.0 * seconds);
}

std::size_t faults_in_a_run(Draws& draws) {
  const std::uint64_t choice = draws.below(8);
  if (choice == 0) return 0;
  if (choice <= 4) return 1;
  return choice == 7 ? 3 : 2;
}

}  // namespace

std::vector<OfferedFault> offered_faults(const core::Plant& plant) {
  std::vector<OfferedFault> offered;
  const auto faults = plant.faults();
  for (std::size_t i = 0; i < faults.size(); ++i) {
    const core::FaultRange range = plant.fault_range(i);
    if (range.min < range.max) offered.push_back({faults[i].name, faults[i].unit, range});
  }
  return offered;
}

// The usual walk: behind a '*' that fits too little, it is tried with one character more.
bool fits(std::string_view pattern, std::string_view name) {
  std::size_t p = 0, n = 0, star = std::string_view::npos, tried = 0;
  const auto same = [](char a, char b) {
    return std::tolower(static_cast<unsigned char>(a)) == std::tolower(static_cast<unsigned char>(b));
  };
  while (n < name.size()) {
    if (p < pattern.size() && pattern[p] == '*') {
      star = p++;
      tried = n;
    } else if (p < pattern.size() && same(pattern[p], name[n])) {
      ++p;
      ++n;
    } else if (star != std::string_view::npos) {
      p = star + 1;
      n = ++tried;
    } else {
      return false;
    }
  }
  while (p < pattern.size() && pattern[p] == '*') ++p;
  return p == pattern.size();
}

result::Result<std::vector<OfferedFault>> chosen(const std::vector<OfferedFault>& offered,
                                                 const std::vector<std::string>& patterns) {
  if (patterns.empty()) return offered;
  std::vector<bool> wanted(offered.size(), false);
  for (const std::string& pattern : patterns) {
    bool any = false;
    for (std::size_t i = 0; i < offered.size(); ++i) {
      if (!fits(pattern, offered[i].name)) continue;
      wanted[i] = any = true;
    }
    if (!any) {
      return result::fail("C0311", {}, "the plant offers no fault '" + pattern + "'",
                          offered.empty() ? "it offers none" : core::known_names(offered, pattern));
    }
  }
  std::vector<OfferedFault> some;
  for (std::size_t i = 0; i < offered.size(); ++i)
    if (wanted[i]) some.push_back(offered[i]);
  return some;
}

const char* Disturbance::kind() const {
  return faults.empty() ? "none" : faults.size() == 1 ? "single" : "compound";
}

std::string Disturbance::words() const {
  std::string text;
  for (const DrawnFault& fault : faults) {
    fmt::format_to(std::back_inserter(text), "{}{} = {:g}{}{} from {:.1f} s", text.empty() ? "" : ", ",
                   fault.name, fault.value, fault.unit.empty() ? "" : " ", fault.unit, fault.at_s);
    if (fault.ends_s) fmt::format_to(std::back_inserter(text), " for {:.1f} s", *fault.ends_s - fault.at_s);
  }
  return text.empty() ? "undisturbed" : text;
}

std::vector<simulation::PlantFault> Disturbance::schedule() const {
  std::vector<simulation::PlantFault> schedule;
  for (const DrawnFault& fault : faults) {
    schedule.push_back({fault.at_s, fault.name, fault.value});
    if (fault.ends_s) schedule.push_back({*fault.ends_s, fault.name, 0.0, true});
  }
  return schedule;
}

Disturbance draw(std::uint64_t seed, const std::vector<OfferedFault>& offered, double horizon_s) {
  Disturbance disturbance;
  Draws draws(seed);
  const std::size_t count = std::min(faults_in_a_run(draws), offered.size());
  std::vector<OfferedFault> left = offered;
  for (std::size_t i = 0; i < count; ++i) {
    const auto which = static_cast<std::ptrdiff_t>(draws.below(left.size()));
    const OfferedFault fault = left[static_cast<std::size_t>(which)];
    left.erase(left.begin() + which);
    DrawnFault drawn{fault.name, fault.unit, value_of(fault.range, draws),
                     tenths(draws.between(0.0, 0.9 * horizon_s))};
    const bool stays = draws.below(2) == 0;
    const double lasts_s = tenths(draws.between(0.5, std::max(1.0, 0.5 * horizon_s)));
    if (!stays) drawn.ends_s = drawn.at_s + lasts_s;
    disturbance.faults.push_back(std::move(drawn));
  }
  std::ranges::stable_sort(disturbance.faults, {}, &DrawnFault::at_s);
  return disturbance;
}

}  // namespace stepwright::campaign

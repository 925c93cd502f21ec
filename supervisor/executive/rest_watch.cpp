#include "supervisor/executive/rest_watch.h"

#include <fmt/format.h>

#include <cmath>
#include <numeric>
#include <utility>

namespace stepwright::executive {
namespace {

// The mean of so many readings is a quarter as noisy as one.
constexpr std::size_t kReadings = 16;

}  // namespace

RestWatch::RestWatch(const translate::Binding& binding, translate::Tare tare, model::NamedState start)
    : binding_(binding), tare_(std::move(tare)), start_(std::move(start)) {}

std::optional<std::string> RestWatch::see(const std::map<std::string, double>& values, std::uint64_t scan) {
  if (seen_ == scan) return std::nullopt;
  seen_ = scan;
  if (auto fact = changed_fact(values)) return fact;
  return changed_level(values);
}

// A switch that bounces is seen once; one that has changed, twice.
std::optional<std::string> RestWatch::changed_fact(const std::map<std::string, double>& values) {
  std::string suspect;
  for (const translate::ObservedFact& fact : binding_.facts) {
    const auto value = values.find(fact.tag);
    if (value == values.end()) continue;
    const bool observed = (value->second != 0.0) != fact.inverted;
    if (observed == start_.facts.contains(fact.fact)) continue;
    suspect = fact.fact;
    if (suspect_ == suspect) {
      return fmt::format("'{}' is {} now", fact.label, observed ? "observed" : "not observed");
    }
  }
  suspect_ = std::move(suspect);
  return std::nullopt;
}

std::optional<std::string> RestWatch::changed_level(const std::map<std::string, double>& values) {
  for (const translate::Sensor& sensor : binding_.sensors) {
    const auto counts = values.find(sensor.tag);
    const auto level = start_.fluents.find(sensor.fluent);
    if (counts == values.end() || level == start_.fluents.end()) continue;
    std::deque<double>& readings = readings_[sensor.name];
    readings.push_back(counts->second);
    if (readings.size() > kReadings) readings.pop_front();
    if (readings.size() < kReadings) continue;
    const double mean = std::accumulate(readings.begin(), readings.end(), 0.0) / kReadings;
    const double now = sensor.calibration.value_at(mean - translate::tare_of(tare_, sensor));
    // As wide again as a guard: the start was a mean, too.
    if (std::abs(now - level->second) <= 2.0 * sensor.tolerance) continue;
    return fmt::format("{} is {:.2f} now, and was {:.2f}", sensor.label, now, level->second);
  }
  return std::nullopt;
}

}  // namespace stepwright::executive

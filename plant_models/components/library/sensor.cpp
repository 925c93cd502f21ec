// Sensors of one quantity: filter and delay, then bias, drift and noise. A card turns what they show into
// counts.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <vector>

#include "plant_models/components/library/fault_specs.h"
#include "plant_models/components/library/types.h"
#include "plant_models/core/sensor_error.h"

namespace stepwright::components::library {
namespace {

enum Port : std::size_t { kOf, kValue };
enum Fault : std::size_t { kDrifts, kFrozen, kOffset };

constexpr double kSample_s = 0.01;  // of a delay, up to a thousand samples

class Sensor final : public Component {
 public:
  Sensor(const Parameters& p, std::uint32_t what)
      : error_(sure(p, "bias"), sure(p, "drift"), sure(p, "noise"), p.seed,
               p["stream"] >= 0.0 ? static_cast<std::uint64_t>(p["stream"]) : 1000 + p.stream),
        what_(what),
        filter_s_(p["filter"]) {
    begins_with_measured_ = std::isnan(p["first"]);
    if (filter_s_ > 0.0) add_state({.start = begins_with_measured_ ? 0.0 : p["first"], .tolerance = 1e-7});
    if (p["delay"] <= 0.0) return;
    const double samples = std::clamp(std::round(p["delay"] / kSample_s), 1.0, 1'000.0);
    line_.assign(static_cast<std::size_t>(samples), 0.0);
    step_s_ = p["delay"] / samples;
    set_roots(1);
  }

  std::vector<FollowingStart> following_starts() const override {
    if (state_count() == 0 || !begins_with_measured_) return {};
    return {{.state = 0, .name = "filter", .reads = {.ports = {kOf}}}};
  }
  // Where nothing can be measured, 0: then the plant says itself what is wrong.
  double start_from(std::size_t, const Frame& f) const override {
    const double value = measured(f);
    return std::isfinite(value) ? value : 0.0;
  }
  void evaluate(std::uint32_t, const Frame& f) const override {
    across(f, kValue) = frozen() ? shown_ : reading(f);
    if (what_ != 0) through(f, kOf, kFlow) = through(f, kOf, kHeatFlow) = 0.0;
  }
  void derivative(const Frame& f) const override {
    if (filter_s_ > 0.0) dydt(f, 0) = (measured(f) - y(f, 0)) / filter_s_;
  }
  // What comes in at a sample comes out a delay later.
  void roots(const Frame& f, double* g) const override {
    g[0] = f.t_s - step_s_ * static_cast<double>(ticks_ + 1);
  }
  Event handle(const Frame& f, const int*, double*) override {
    line_[ticks_ % line_.size()] = filtered(f);
    ++ticks_;
    return Event::Changed;
  }
  // Before the start it was as it is then.
  bool settle(const Frame& f) override {
    if (line_.empty() || filled_) return false;
    std::ranges::fill(line_, filtered(f));
    filled_ = true;
    return true;
  }
  void fault_changed(std::size_t fault, double value, const Frame& f) override {
    if (fault == kDrifts) since_ns_ = f.time_ns;
    if (fault == kFrozen && value >= 0.5) shown_ = across(f, kValue);
  }

 private:
  static double sure(const Parameters& p, const char* name) { return p.uncertainty ? p[name] : 0.0; }
  bool frozen() const { return fault(kFrozen) >= 0.5; }
  double measured(const Frame& f) const { return across(f, kOf, what_ == 0 ? 0 : kPressure); }
  double filtered(const Frame& f) const { return filter_s_ > 0.0 ? y(f, 0) : measured(f); }
  double reading(const Frame& f) const {
    double value = line_.empty() ? filtered(f) : line_[ticks_ % line_.size()];
    value += fault(kOffset);
    if (!f.sampling) return value;
    const std::chrono::nanoseconds time(f.time_ns);
    value += error_.offset(time) + error_.noise(time);
    return value + fault(kDrifts) * 1e-9 * static_cast<double>(f.time_ns - since_ns_);
  }

  core::SensorError error_;
  std::uint32_t what_;  // 0: a signal; else: a pressure
  double filter_s_;
  bool begins_with_measured_ = false;  // the filter
  std::vector<double> line_;           // of the delay: the oldest sample is the next one to be written over
  double step_s_ = 0.0;                // between two samples
  std::size_t ticks_ = 0;
  bool filled_ = false;
  std::int64_t since_ns_ = 0;
  double shown_ = 0.0;
};

// `shown`: the unit in which people read what it shows. `usual`: the size of an error that happens; in a
// minute, of one that grows.
ComponentType sensor(const char* name, const char* meaning, const char* unit, const char* shown,
                     bool of_liquid, double usual) {
  const std::string of = unit;
  const auto size = [&](const char* parameter, const char* what) {
    return ParameterSpec{
        .name = parameter, .unit = of, .fallback = "0 " + of, .low = 0.0, .high = 1e9, .meaning = what};
  };
  ComponentType type = {
      .name = name,
      .meaning = meaning,
      .parameters = {size("bias", "a constant error, even over +- this; another one for each seed"),
                     size("drift", "wanders within +- this, an hour from one random value to the next"),
                     size("noise", "standard deviation of what is new at each reading"),
                     {.name = "filter",
                      .unit = "s",
                      .fallback = "0 s",
                      .low = 0.0,
                      .high = 1e4,
                      .meaning = "time constant; 0: it shows what is there"},
                     {.name = "delay",
                      .unit = "s",
                      .fallback = "0 s",
                      .low = 0.0,
                      .high = 3600.0,
                      .meaning = "until it shows what was there, in steps of 10 ms or a thousandth of it"},
                     {.name = "first",
                      .unit = of,
                      .fallback = "what it measures",
                      .meaning = "what a filter shows at the start"},
                     {.name = "stream",
                      .unit = "",
                      .fallback = "-1",
                      .low = -1.0,
                      .high = 1e6,
                      .meaning = "number of its random values; -1: its own by its place in the file"}},
      .ports = {{.name = "of", .unit = of, .reads = 0, .meaning = "what it measures"},
                {.name = "value",
                 .role = Role::Node,
                 .unit = shown,
                 .open = Open::Fine,
                 .meaning = "what it shows"}},
      .faults = {{.name = "drift",
                  .unit = of + "/s",
                  .low = -1e6,
                  .high = 1e6,
                  .rest = 0.0,
                  .meaning = "what it shows walks away at this rate",
                  .usual = usual / 60.0},
                 flag_fault("frozen", "1: it goes on showing its present value"),
                 {.name = "offset",
                  .unit = of,
                  .low = -1e9,
                  .high = 1e9,
                  .rest = 0.0,
                  .meaning = "it shows so much more",
                  .usual = usual}},
      .make = [of_liquid](const Parameters& p) { return std::make_unique<Sensor>(p, of_liquid ? 1 : 0); }};
  if (of_liquid)
    type.ports[0] = {.name = "of", .kind = PortKind::Fluid, .reads = 0, .meaning = "where it measures"};
  return type;
}

}  // namespace

ComponentType level_sensor_type() {
  return sensor("level_sensor", "shows the level of a tank", "percent", "percent", false, 20.0);
}
ComponentType temperature_sensor_type() {
  return sensor("temperature_sensor", "shows a temperature", "K", "degC", false, 20.0);
}
ComponentType flow_sensor_type() {
  return sensor("flow_sensor", "shows a flow", "l/s", "l/s", false, 1.0);
}
ComponentType pressure_sensor_type() {
  return sensor("pressure_sensor", "shows the pressure of a liquid above that of the room", "bar", "bar",
                true, 0.5);
}

}  // namespace stepwright::components::library

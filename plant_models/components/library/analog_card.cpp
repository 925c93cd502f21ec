// What turns a figure into the counts of an analogue channel, and back.

#include <algorithm>

#include "plant_models/components/library/fault_specs.h"
#include "plant_models/components/library/types.h"

namespace stepwright::components::library {
namespace {

enum Fault : std::size_t { kBroken, kDrifts, kFrozen };

// counts = counts_low + (value - low) * (counts_high - counts_low) / (high - low).
struct Scale {
  double low, high, counts_low, counts_high;

  explicit Scale(const Parameters& p)
      : low(p["low"]), high(p["high"]), counts_low(p["counts_low"]), counts_high(p["counts_high"]) {}
  double slope() const { return (counts_high - counts_low) / (high - low); }
};

class AnalogInput final : public Component {
 public:
  explicit AnalogInput(const Parameters& p) : scale_(p), broken_(p["broken_wire"]) {}
  void evaluate(std::uint32_t, const Frame& f) const override {
    double counts = scale_.counts_low + (across(f, 0) - scale_.low) * scale_.slope();
    if (f.sampling) counts += fault(kDrifts) * 1e-9 * static_cast<double>(f.time_ns - since_ns_);
    if (fault(kFrozen) >= 0.5) counts = shown_;
    if (fault(kBroken) >= 0.5) counts = broken_;
    across(f, 1) = std::clamp(counts, -32768.0, 32767.0);
  }
  void fault_changed(std::size_t fault, double value, const Frame& f) override {
    if (fault == kDrifts) since_ns_ = f.time_ns;
    if (fault == kFrozen && value >= 0.5) shown_ = across(f, 1);
  }

 private:
  Scale scale_;
  double broken_;
  std::int64_t since_ns_ = 0;
  double shown_ = 0.0;
};

class AnalogOutput final : public Component {
 public:
  explicit AnalogOutput(const Parameters& p) : scale_(p) {}
  void evaluate(std::uint32_t, const Frame& f) const override {
    const double counts = fault(kBroken) >= 0.5 ? scale_.counts_low : across(f, 0);
    const double value = scale_.low + (counts - scale_.counts_low) / scale_.slope();
    across(f, 1) = std::clamp(value, std::min(scale_.low, scale_.high), std::max(scale_.low, scale_.high));
  }

 private:
  Scale scale_;
};

std::vector<ParameterSpec> scale_of(const char* port) {
  return {
      {.name = "low", .unit = "any", .fallback = "", .meaning = "the figure at counts_low", .like = port},
      {.name = "high", .unit = "any", .fallback = "", .meaning = "the figure at counts_high", .like = port},
      {.name = "counts_low",
       .unit = "",
       .fallback = "0",
       .low = -32768.0,
       .high = 32767.0,
       .meaning = "counts at `low`"},
      {.name = "counts_high",
       .unit = "",
       .fallback = "27648",
       .low = -32768.0,
       .high = 32767.0,
       .meaning = "counts at `high`"}};
}

std::pair<std::string, std::string> wrong_scale(const Parameters& p) {
  if (p["low"] == p["high"]) return {"'low' and 'high' are the same", "a range has two ends"};
  if (p["counts_low"] == p["counts_high"])
    return {"'counts_low' and 'counts_high' are the same", "a range has two ends"};
  return {};
}

}  // namespace

ComponentType analog_input_type() {
  ComponentType type = {
      .name = "analog_input",
      .meaning = "a channel of an analogue input card: a figure as counts",
      .parameters = scale_of("of"),
      .ports = {{.name = "of", .unit = "any", .reads = 0, .meaning = "a sensor, or any other output"},
                {.name = "counts",
                 .role = Role::Node,
                 .unit = "",
                 .open = Open::Fine,
                 .meaning = "what a terminal shows"}},
      .faults = {flag_fault("broken_wire", "1: it shows the counts of a broken wire"),
                 {.name = "drift",
                  .unit = "1/s",
                  .low = -1000.0,
                  .high = 1000.0,
                  .rest = 0.0,
                  .meaning = "its counts walk away at this rate",
                  .usual = 100.0},
                 flag_fault("frozen", "1: it goes on showing its present counts")},
      .wrong = wrong_scale,
      .make = [](const Parameters& p) { return std::make_unique<AnalogInput>(p); }};
  type.parameters.push_back({.name = "broken_wire",
                             .unit = "",
                             .fallback = "32767",
                             .low = -32768.0,
                             .high = 32767.0,
                             .meaning = "counts while the wire is broken"});
  return type;
}

ComponentType analog_output_type() {
  return {.name = "analog_output",
          .meaning = "a channel of an analogue output card: counts as a figure",
          .parameters = scale_of("value"),
          .ports = {{.name = "counts", .unit = "", .reads = 0, .meaning = "a terminal of the program"},
                    {.name = "value",
                     .role = Role::Node,
                     .unit = "any",
                     .open = Open::Fine,
                     .meaning = "in the unit of `low` and `high`"}},
          .faults = {flag_fault("broken_wire", "1: it gives `low`")},
          .wrong = wrong_scale,
          .make = [](const Parameters& p) { return std::make_unique<AnalogOutput>(p); }};
}

}  // namespace stepwright::components::library

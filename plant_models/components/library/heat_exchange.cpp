// Heat that flows because of a difference of temperature: W = UA (T1 - T2).

#include <algorithm>

#include "plant_models/components/library/types.h"

namespace stepwright::components::library {
namespace {

class Cooler final : public Component {
 public:
  explicit Cooler(const Parameters& p) : conductance_(p["conductance"]), coolant_k_(p["coolant"]) {}
  void evaluate(std::uint32_t, const Frame& f) const override {
    const double share = across(f, kOn) >= 0.5 ? across(f, kShare) : 0.0;
    const double given = conductance_ * share * (1.0 - fault(0)) * across(f, kHeat, kContact);
    const double power = given * (across(f, kHeat) - coolant_k_);
    through(f, kHeat) = -power;
    across(f, kPower) = power;
  }

 private:
  enum Port : std::size_t { kHeat, kOn, kShare, kPower };
  double conductance_, coolant_k_;
};

class HeatExchanger final : public Component {
 public:
  explicit HeatExchanger(const Parameters& p) : conductance_(p["conductance"]) {}
  void evaluate(std::uint32_t, const Frame& f) const override {
    const double touched = std::min(across(f, kHot, kContact), across(f, kCold, kContact));
    const double power = conductance_ * (1.0 - fault(0)) * touched * (across(f, kHot) - across(f, kCold));
    through(f, kHot) = -power;
    through(f, kCold) = power;
    across(f, kPower) = power;
  }

 private:
  enum Port : std::size_t { kHot, kCold, kPower };
  double conductance_;
};

const FaultSpec kFouled = {.name = "fouled",
                           .unit = "percent",
                           .low = 0.0,
                           .high = 100.0,
                           .rest = 0.0,
                           .meaning = "by this much less heat goes through it"};
const ParameterSpec kConductance = {.name = "conductance",
                                    .unit = "W/K",
                                    .fallback = "",
                                    .low = 0.0,
                                    .high = 1e9,
                                    .meaning = "heat per difference of temperature (UA)"};
const PortSpec kPowerOut = {
    .name = "power", .role = Role::Node, .unit = "kW", .open = Open::Fine, .meaning = "that goes through it"};

}  // namespace

ComponentType cooler_type() {
  return {.name = "cooler",
          .meaning = "takes heat from a tank into a coolant of constant temperature",
          .parameters = {kConductance,
                         {.name = "coolant",
                          .unit = "K",
                          .fallback = "15 degC",
                          .low = 1.0,
                          .high = 5e3,
                          .meaning = "its temperature"}},
          .ports = {{.name = "heat", .kind = PortKind::Heat, .reads = 0, .meaning = "what it cools"},
                    {.name = "command",
                     .kind = PortKind::Logic,
                     .reads = 0,
                     .open = Open::Constant,
                     .constant = 1.0,
                     .meaning = "on"},
                    {.name = "share",
                     .unit = "percent",
                     .reads = 0,
                     .open = Open::Constant,
                     .constant = 1.0,
                     .meaning = "of its conductance"},
                    kPowerOut},
          .faults = {kFouled},
          .make = [](const Parameters& p) { return std::make_unique<Cooler>(p); }};
}

ComponentType heat_exchanger_type() {
  return {.name = "heat_exchanger",
          .meaning = "a wall between two liquids: heat goes from the warmer to the colder one",
          .parameters = {kConductance},
          .ports = {{.name = "hot", .kind = PortKind::Heat, .reads = 0, .meaning = "one side"},
                    {.name = "cold", .kind = PortKind::Heat, .reads = 0, .meaning = "the other side"},
                    kPowerOut},
          .faults = {kFouled},
          .make = [](const Parameters& p) { return std::make_unique<HeatExchanger>(p); }};
}

}  // namespace stepwright::components::library

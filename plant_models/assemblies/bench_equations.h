#pragma once

// The differential equations of the tank bench, as plant_models/doc/bench.md derives them. Pure functions
// of parameters, modes and state, SI units. Between two changes of the modes the equations are smooth
// except for the kinks of the pumps' check valves, which the error control of the solver handles.
//
// Invariant: the derivatives of all volumes, sump included, sum up to zero.

#include <array>
#include <cstddef>
#include <limits>
#include <span>

#include "plant_models/assemblies/bench_names.h"
#include "plant_models/assemblies/bench_parameters.h"
#include "plant_models/ode/ode_system.h"

namespace stepwright::assemblies {

// Places of the state vector.
inline constexpr std::size_t kPosition = 0;   // m, a1 at -1, f1 at 0, a2 at +1
inline constexpr std::size_t kSpeed = 1;      // m/s
inline constexpr std::size_t kVolume = 2;     // m3, one per Tank
inline constexpr std::size_t kSump = 6;       // m3, everything spilt or leaked
inline constexpr std::size_t kPumpSpeed = 7;  // 1 = nominal, one per Pump
inline constexpr std::size_t kDrawn = 11;     // m3 delivered to a client, one per client
inline constexpr std::size_t kStateSize = 13;

// Places of the root functions.
inline constexpr std::size_t kPlaceRoot = 0;  // one per place: its switch changes
inline constexpr std::size_t kStandstillRoot = 3;
inline constexpr std::size_t kEndStopRoot = 4;
inline constexpr std::size_t kSuctionRoot = 5;   // one per tank: the intake begins to suck air
inline constexpr std::size_t kOverflowRoot = 9;  // one per tank but the supplier
inline constexpr std::size_t kDrawRoot = 12;     // one per client: an extra draw is complete
inline constexpr std::size_t kRoots = 14;

// Inputs of the equations that are constant between two events.
struct BenchModes {
  std::array<bool, kPumps> pump_on{};
  std::array<double, kPumps> pump_strength = {1.0, 1.0, 1.0, 1.0};  // 1 = healthy
  std::array<double, kTanks> leak_m3_s{};
  int drive = 0;      // -1 left, 0 braked, +1 right
  int direction = 0;  // of motion; 0 = held by friction, brake or end stop
  Place place = Place::F1;
  // kDrawn at which an extra draw ends; infinity = none.
  std::array<double, kClients> draw_until_m3 = {std::numeric_limits<double>::infinity(),
                                                std::numeric_limits<double>::infinity()};
};

// m3/s, never negative.
struct BenchFlows {
  std::array<double, kPumps> pump{};
  std::array<double, kTanks> overflow{};  // to f1; f1 itself has none
  std::array<double, kTanks> leak{};      // to the sump
};

// The same figures in SI units, as the equations want them.
class BenchEquations final : public ode::OdeSystem {
 public:
  explicit BenchEquations(const BenchParameters& parameters);

  BenchModes modes;

  std::size_t state_size() const override { return kStateSize; }
  std::size_t root_count() const override { return kRoots; }
  void derivative(double t, std::span<const double> y, std::span<double> dydt) const override;
  void roots(double t, std::span<const double> y, std::span<double> g) const override;

  BenchFlows flows(std::span<const double> y) const;

  double capacity_m3(Tank tank) const { return capacity_[index(tank)]; }
  double percent(Tank tank, std::span<const double> y) const;

  // The place whose switch is closed at position x, by the inner width.
  Place place_at(double x) const;

  // Which way the vehicle moves on from its present state: dry friction holds it or lets it go.
  int direction_from(double x, double speed) const;

  double end_stop_m() const { return track_.end_stop_m; }

 private:
  double acceleration(std::span<const double> y, double loading_m3_s) const;

  std::array<double, kTanks> capacity_{};  // m3
  std::array<double, kTanks> head_{};      // m of liquid per m3
  std::array<double, kTanks> suction_{};   // m3
  std::array<PumpParameters, kPumps> pumps_;
  VehicleParameters vehicle_;
  TrackParameters track_;
  double density_;  // kg/m3
  double overflow_rate_;
};

}  // namespace stepwright::assemblies

#pragma once

// Description of a kind of component, for who reads a plant's file, connects its ports, lists it and
// documents it. Plain data; a catalogue is a list of them.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "plant_models/components/component.h"
#include "plant_models/components/unit.h"
#include "runtime/ground/result/result.h"

namespace stepwright::settings {
class TomlTable;
}

namespace stepwright::components {

enum class ParameterKind : std::uint8_t { Quantity, Choice };

struct ParameterSpec {
  std::string name{};
  std::string unit{};      // what a figure of it can be converted to; "any": that of the port `like`
  std::string fallback{};  // "0.3 m"; empty: it has to be given; other words: NaN, which the component knows
  double low = -std::numeric_limits<double>::infinity();  // SI
  double high = std::numeric_limits<double>::infinity();
  std::string meaning{};
  std::vector<std::string> choices{};  // of words; then it has no unit
  std::string like{};                  // name of a signal port whose unit it has to have
};

enum class Open : std::uint8_t {
  Wrong,     // it has to be connected
  Floor,     // what flows out of it is on the floor
  Constant,  // it has its default
  Fine,      // nothing flows
};

// What a port or fault needs of its component: a choice of a parameter. Without a name it needs nothing.
struct NeededChoice {
  std::string parameter{};
  std::string choice{};
};

inline constexpr std::uint32_t kAtDerivative = 255;

struct PortSpec {
  std::string name{};
  PortKind kind = PortKind::Signal;
  Role role = Role::Branch;
  std::string unit{};                   // of a signal; "any": whatever it is connected to
  std::uint32_t stage = 0;              // which sets what the component sets here
  std::uint32_t reads = kAtDerivative;  // the first one that reads what it is given here
  Open open = Open::Wrong;
  double constant = 0.0;  // SI, of Open::Constant
  std::string meaning{};
  std::string same_as{};  // an output of unit "any": the input whose unit it has
  NeededChoice needs{};
};

struct FaultSpec {
  std::string name{};
  std::string unit{};
  double low = 0.0;  // in `unit`
  double high = 1.0;
  double rest = std::numeric_limits<double>::quiet_NaN();  // SI; NaN: no value is like the fault
  std::string meaning{};
  bool whole = false;  // nothing between `low` and `high` has a meaning
  // A campaign tries no larger ones, in `unit`; such as the range is wide.
  double usual = std::numeric_limits<double>::infinity();
  NeededChoice needs{};
};

// The figures of one component, checked and in SI.
class Parameters {
 public:
  double operator[](std::string_view name) const { return figures.find(name)->second; }
  const std::string& word(std::string_view name) const { return words.find(name)->second; }
  bool is(std::string_view name, std::string_view choice) const { return word(name) == choice; }
  bool has(const NeededChoice& needed) const {
    return needed.parameter.empty() || is(needed.parameter, needed.choice);
  }

  std::map<std::string, double, std::less<>> figures;
  std::map<std::string, std::string, std::less<>> words;
  // Of the whole plant.
  double density_kg_m3 = 1000.0;
  double heat_capacity_j_kg_k = 4186.0;
  double gravity_m_s2 = 9.80665;
  double room_k = 293.15;
  std::uint64_t seed = 1;
  std::uint64_t stream = 0;  // of random numbers, another one for each sensor
  bool uncertainty = true;

  double weight() const { return density_kg_m3 * gravity_m_s2; }  // N/m3
};

// What assemblies put in the place of "$name".
using Replaced = std::map<std::string, std::string, std::less<>>;
struct ModelOptions;

// Where a component stands whose type is in a file of its own.
struct TypePlace {
  std::string name;              // of the component
  std::filesystem::path folder;  // of the plant's file
  double step_s = 0.01;          // between two exchanges
  const Replaced& replaced;
  const ModelOptions& options;
};

struct ComponentType {
  std::string name{};
  std::string meaning{};
  std::vector<ParameterSpec> parameters{};
  std::vector<PortSpec> ports{};
  std::vector<FaultSpec> faults{};
  std::uint32_t stages = 1;
  // What only several parameters together can have wrong, as text and hint; empty: nothing.
  std::function<std::pair<std::string, std::string>(const Parameters&)> wrong{};
  std::function<std::unique_ptr<Component>(const Parameters&)> make{};
  // Of a type whose ports stand in a file that the component names: the type of that one component. Nothing
  // if it is wrong, which is reported to the table.
  std::function<std::optional<ComponentType>(const settings::TomlTable&, const TypePlace&)> of_file{};
};

using Catalogue = std::span<const ComponentType>;

}  // namespace stepwright::components

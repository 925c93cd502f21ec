#pragma once

// modelDescription.xml of a Functional Mock-up Unit, FMI 2.0 and 3.0 (https://fmi-standard.org/docs): what a
// co-simulation needs of it. Any input gives a description or located diagnostics (C0332). Arrays are given
// as their elements (array_variable.h).
//
// Thread-safe: pure.

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/ground/result/result.h"

namespace stepwright::fmu {

enum class FmiVersion : std::uint8_t { V2, V3 };

enum class VariableType : std::uint8_t {
  Real,  // FMI 2
  Integer,
  Enumeration,
  Boolean,
  Float64,  // FMI 3
  Float32,
  Int8,
  UInt8,
  Int16,
  UInt16,
  Int32,
  UInt32,
  Int64,
  UInt64,
  Other,  // strings, binaries, clocks: no numbers
};

// <Unit>: SI = factor * figure + offset.
struct UnitDefinition {
  static constexpr std::array<const char*, 5> kBases = {"m", "kg", "s", "K", "A"};
  std::string name;
  double factor = 1.0;
  double offset = 0.0;
  std::array<int, kBases.size()> exponents{};  // of the bases
  bool other = false;                          // it has mol or cd as well
};

struct ModelVariable {
  std::string name;
  std::uint32_t reference = 0;  // its value reference
  VariableType type = VariableType::Real;
  std::string causality = "local";
  std::string variability;
  std::string description;  // a word of it for people
  std::string unit;         // its own, or that of its declared type
  double start = 0.0;
  std::uint32_t element = 0;   // FMI 3: its place in an array,
  std::uint32_t elements = 0;  // which has so many; 0: it is no element of an array
  std::uint32_t line = 0;
};

struct ModelDescription {
  FmiVersion version = FmiVersion::V2;
  std::string name;
  std::string token;       // FMI 2: guid; FMI 3: instantiationToken
  std::string identifier;  // of the co-simulation: name of its library
  bool needs_tool = false;
  bool variable_steps = true;        // canHandleVariableCommunicationStepSize
  std::optional<double> fixed_step;  // FMI 3: fixedInternalStepSize, s
  std::vector<ModelVariable> variables;
  std::vector<UnitDefinition> units;  // those with a <BaseUnit>

  const ModelVariable* find(std::string_view variable) const;
  const UnitDefinition* find_unit(std::string_view unit) const;
};

// `name` is that of the file, for diagnostics.
[[nodiscard]] result::Result<ModelDescription> parse_description(std::string_view xml,
                                                                 const std::string& name);

}  // namespace stepwright::fmu

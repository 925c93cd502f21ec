#pragma once

// A plant of components, put together: where every value is, and in which order they are worked out. Made by
// assemble(), run by ModelEquations.
//
// Thread rule: plain data; what runs it says its own.
// Invariants: a step of the order reads only what steps before it, states, terminals and constants have
// set; a loop without a state between its parts is one step, solved as a whole.

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "plant_models/components/component.h"
#include "plant_models/components/model_text.h"
#include "plant_models/core/port.h"

namespace stepwright::components {

// v[to] = the sum of v[from] over `from`: what flows into a node.
struct Gathering {
  std::uint32_t to = 0;
  std::vector<std::uint32_t> from;
};

enum class StepKind : std::uint8_t { Evaluate, Gather, Solve };

struct Step {
  StepKind kind = StepKind::Evaluate;
  std::uint32_t index = 0;  // of the component, gathering or loop
  std::uint32_t stage = 0;
};

// Values that depend on each other: `unknowns` are right when all `residuals` are zero.
struct Loop {
  std::vector<Step> steps;
  std::vector<std::uint32_t> unknowns;    // places in v
  std::vector<std::uint32_t> residuals;   // likewise
  std::vector<double> typical;            // size of each unknown
  std::vector<double> typical_residual;   // of the flows that add up to a residual
  std::vector<double> start;              // of the unknowns, at the beginning
  std::vector<std::int32_t> pressure_of;  // of a temperature that liquid carries: the unknown that is the
                                          // pressure of its junction; -1 of every other unknown
  std::string names;                      // of its components
};

inline constexpr std::uint32_t kAllLiquid = 0xFFFFFFFF;  // instead of a slot

struct ModelTruth {
  std::uint32_t slot = 0;  // or kAllLiquid
  double factor = 1.0;     // shown = (SI - offset) / factor
  double offset = 0.0;
};

struct ModelTerminal {
  std::uint32_t slot = 0;
  std::string address;
  result::Location where;
};

struct ModelFault {
  std::uint32_t component = 0;
  std::uint32_t fault = 0;
  double factor = 1.0;  // of its unit
  double low = 0.0;     // in its unit
  double high = 1.0;
  double rest = 0.0;   // SI; NaN: none
  double usual = 1.0;  // in its unit: a campaign tries no larger ones
  bool whole = false;  // whole numbers only
};

// Two components that are joined, the one that something comes from first.
struct ModelLink {
  std::uint32_t from = 0;
  std::uint32_t to = 0;
  PortKind kind = PortKind::Signal;
};

struct Model {
  ModelText text;
  std::vector<std::unique_ptr<Component>> components;
  std::vector<std::string> names;  // of the components; junctions have none
  std::vector<const ComponentType*> types;
  std::vector<std::uint32_t> first_state;  // of each component
  std::vector<std::uint32_t> first_root;
  std::vector<std::uint32_t> with_states;  // components
  std::vector<std::uint32_t> with_roots;
  std::vector<ProcessPart*> processes;  // components that are, in their order
  std::size_t states = 0;
  std::size_t roots = 0;
  std::vector<double> values;  // as they are before anything is worked out: constants
  std::vector<Step> order;
  std::vector<Step> shown;    // the part of it that the program's inputs come from,
  std::vector<Step> watched;  // and the part that root functions look at
  std::vector<Gathering> gatherings;
  std::vector<Loop> loops;
  std::vector<ModelLink> links;  // for who draws it

  std::vector<core::Port> actuators;
  std::vector<core::Port> sensors;
  std::vector<ModelTerminal> actuator_at;
  std::vector<ModelTerminal> sensor_at;
  std::vector<core::Quantity> truths;
  std::vector<ModelTruth> truth_at;
  std::vector<core::Quantity> faults;
  std::vector<ModelFault> fault_at;

  std::vector<double> start() const;
  std::vector<double> tolerances() const;
};

// What may help whoever names a fault that the plant does not have: the choice of a parameter that gives it,
// or names that are near.
std::string fault_hint(const Model& model, const std::string& name);

// Connects the parts and puts their equations into order. Fails with everything that is wrong: C0341 (units
// of two ports), C0343 (what a port is connected to does not exist), C0344 (open port), C0345 (a component
// without any connection), C0346 (circular without a state), C0347 (ports that cannot be joined), C0348
// (terminal), C0304 (addresses of terminals that overlap).
[[nodiscard]] result::Result<std::unique_ptr<Model>> assemble(ModelText text);

}  // namespace stepwright::components

#pragma once

// Conditions of transitions are evaluated only while their transition is enabled. A condition that only reads
// variables, compares and combines them can neither trap nor change anything: it stands in series with the
// contacts of its steps, where nobody can tell the difference. Every other one (a call, a division, an index,
// a network with blocks) runs under the power of these contacts. Internal to this folder; one thread.

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "ladder/graphic/condition.h"
#include "ladder/graphic/ladder_program.h"
#include "ladder/lowering/sfc_lowering_context.h"

namespace stepwright::lowering {

// True for names, literals, comparisons and AND, OR, XOR, NOT. It may answer false for a text that is as
// harmless: that costs a jump.
bool only_reads(std::string_view text);
bool only_reads(const graphic::Condition& condition);
// True for contacts, and coils of the ladder's own wires, and nothing else.
bool only_reads(const graphic::LadderProgram& ladder);

// The rungs of conditions that are guarded. Transitions come in the order in which they are tested.
class ConditionGuard {
 public:
  explicit ConditionGuard(SfcLoweringContext& context);

  // Whether the condition may not stand in series with the contacts of the steps.
  bool guards(std::size_t transition) const;
  // Before the rung of a transition: the network that it shares with others, if it is the first of them.
  void run_shared_network(std::size_t transition);
  // The rungs of a guarded transition: its bit is reset, and takes the value of the condition where `enabled`
  // has power. `way` says which transition it is: "A -> B".
  void evaluate(std::size_t transition, graphic::Condition enabled, const std::string& way);

 private:
  const ConditionNetwork* network_of(std::size_t transition) const;
  void sense_edges(graphic::Condition& condition, const std::string& fires);

  SfcLoweringContext& context_;
  std::vector<std::size_t> networks_;  // by transition: index into the chart's condition networks
  std::vector<bool> has_run_;          // by network
};

}  // namespace stepwright::lowering

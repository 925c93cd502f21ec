#pragma once

// The chart of a drawn SFC body: divergences and convergences become transitions with several sources and
// targets, jumps lead to their steps, alternative branches keep their order from left to right.
//
// Networks of LD and FBD beside the chart run in every scan before the transitions are tested, what is drawn
// as the condition of transitions while one of them is enabled (sfc_semantics.md, "Drawn conditions"):
// `networks`. Actions and transitions in ST keep their text, those drawn as LD or FBD become ST.

#include <optional>

#include "ladder/graphic/project.h"
#include "ladder/lowering/condition_network.h"
#include "ladder/lowering/diagram_scope.h"

namespace stepwright::lowering {

struct DrawnChart {
  graphic::SfcChart chart;
  ChartNetworks networks;
  std::vector<graphic::Wire> edges;  // states of edge contacts in actions
};

// Reports E0803 (the drawing makes no
// chart) and E0804 (macro steps, instruction lists) to the scope.
DrawnChart diagram_to_chart(const graphic::DrawnBody& body, DiagramScope& scope);

// The same chart as a reader sees it: conditions and actions as they were drawn, without the wires that their
// evaluation needs (shown_conditions.h, shown_text.h). It is not to be compiled. The scope gives no marks.
graphic::SfcChart shown_chart(const graphic::DrawnBody& body, DiagramScope& scope);

}  // namespace stepwright::lowering

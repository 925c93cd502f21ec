#pragma once

// Drawings of a sequential function chart with the symbols of IEC 61131-3, 6.7: a double box for an initial
// step, a bar with its condition for a transition, a double line for simultaneous and a single line for
// alternative branches, action blocks with their qualifier, an arrow with the name of a step for a jump back.
// The layout is layered and takes any chart, also one whose simultaneous branches do not nest.
// Pure functions of their input: the same chart gives the same bytes.
//
//   Result<std::string> svg = draw_sfc_svg(chart);    // for a browser or a report
//   Result<std::string> text = draw_sfc_text(chart);  // for a terminal, UTF-8 with box characters
//
// The SVG scales (viewBox) and can be lit while it runs: every step is a group
// `<g class="sw-step" data-step="NAME">`, every transition `<g class="sw-transition"
// data-transition="NAME">`; a viewer adds the class `sw-active` (running) or `sw-done` (finished) to a step's
// group. All styles are in classes with the prefix `sw-`, so that the SVG can stand inside a page.

#include <string>

#include "ladder/graphic/sfc_chart.h"
#include "runtime/ground/result/result.h"

namespace stepwright::graphic {

// Fails with the errors of `check(chart)`; warnings do not matter.
[[nodiscard]] result::Result<std::string> draw_sfc_svg(const SfcChart& chart);
[[nodiscard]] result::Result<std::string> draw_sfc_text(const SfcChart& chart);

}  // namespace stepwright::graphic
